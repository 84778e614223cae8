#pragma once

#include <vector>

/// Milliseconds of the parallel Euclidean distance transform of a square picture, medians.
struct PropagationTimes {
    int size = 0, passes = 0;
    double processor = 0;
    double device = 0;    ///< with copying there and back; 0 where there is no device
    double reference = 0; ///< of base/distance_transform.h, which is exact and needs no passes
};

/// One marked pixel in a corner, so that every pass changes something.
/// @param on_device  needs a gpu::Context
PropagationTimes time_propagation(int size, int passes, int runs, bool on_device);
