#pragma once

#include "benchmark.h"

/// The studies of coherent shadow maps: sizes and errors of the seed's codec and of bricks, orders, resolutions, grids of directions and their
/// orientation, other compressors, and the time of look-ups beside rays (the coherent shadow map specification, section 7).
BenchResult bench_shadow(const BenchRequest& request, Console& console);
