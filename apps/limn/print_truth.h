#pragma once

#include "limn/base/image.h"
#include "limn/camera/camera.h"
#include "limn/pattern/pattern_shader.h"
#include "stepped_print.h"

/// How the truth is found.
struct TruthOptions {
    limn::formulas::Finish finish;
    limn::PatternLight light;           ///< far away
    limn::vec3 background = limn::vec3(1); ///< linear
    float kernel_width = 0.5f;          ///< of a pixel's Gauss kernel
    int side = 12;                      ///< so many samples a pixel, squared
};

/// A picture of real steps, RGB, encoded: rays from the eye under the kernel of a pixel; at what they meet one ray to the light, somewhere on its disc, one to sky
/// and floor, and one along the mirrored line of sight for their reflection. Multi-threaded; the same for any number of threads.
limn::Image trace_print(const SteppedPrint& print, const limn::Camera& camera, const TruthOptions& options);
