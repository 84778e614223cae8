#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "limn/base/image.h"
#include "limn/camera/camera.h"
#include "limn/pattern/pattern_shader.h"
#include "limn/raycast/ray_scene.h"
#include "limn/scene/print_scene.h"
#include "stepped_print.h"

/// Where a ray meets a print.
struct PrintHit {
    limn::vec3 place;  ///< in the frame of the body
    limn::vec3 face;   ///< unit, of the surface that rays meet, towards the eye
    limn::vec3 normal; ///< unit, for shading
    limn::vec3 along;  ///< unit, in the surface: of the bead
};

/// A print as rays find it.
struct PrintBody {
    std::function<std::optional<PrintHit>(const limn::Camera::Ray& ray, const limn::vec3& up)>
        first;                                       ///< a ray of the world, and the print direction
    std::function<bool(const limn::Ray& ray)> hides; ///< a ray of the body's frame
    float off;                                       ///< of the surface, where rays to light begin
};

/// Steps as triangles, whose frame is the world.
PrintBody body_of(SteppedPrint steps);
/// Beads as G-code has them; `print` has to outlive it.
PrintBody body_of(const limn::SeenPrint& print);

/// How the truth is found.
struct TruthOptions {
    limn::formulas::Finish finish;
    limn::PatternLight light;              ///< far away
    limn::vec3 background = limn::vec3(1); ///< linear
    float kernel_width = 0.5f;             ///< of a pixel's Gauss kernel
    int side = 12;                         ///< so many samples a pixel, squared
};

/// A picture and which of its pixels are filled by what it shows: 1 for each.
struct TracedPrint {
    limn::Image picture;
    std::vector<std::uint8_t> filled;
};

/// A picture of a real print, RGB, encoded: rays from the eye under the kernel of a pixel; at what they meet one ray to the light, somewhere on its disc, one to sky
/// and floor, and one along the mirrored line of sight for their reflection. Multi-threaded; the same for any number of threads.
TracedPrint trace_print(const PrintBody& print, const limn::Camera& camera, const TruthOptions& options);
