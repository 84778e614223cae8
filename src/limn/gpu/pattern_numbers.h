#pragma once

#include <string>
#include <vector>

#include "limn/camera/camera.h"
#include "limn/pattern/pattern_paint.h"

namespace limn::gpu {

/// The numbers of a pattern as pattern_numbers.glsl has them.
struct PatternNumbers {
    vec4 turn_x, turn_y, turn_z, shift, eye, forward, right, down;
    vec4 to_light, light, up, above, below, lamp, intensity, falloff;
    vec4 own[6];
};

/// Texels in a row of a table in a texture; even.
inline constexpr int table_width = 4096;

/// Patterns ready for the device.
struct PackedPatterns {
    std::vector<PatternNumbers> numbers; ///< of each pattern
    std::vector<float> tops;             ///< of the layers of all of them
};

/// @param centre, scale  of the scene's frame
PackedPatterns packed_patterns(const PatternPaint& paint, const Camera& camera, const dvec3& centre, double scale);

/// The shader that draws such patterns, and the macros that it is made with.
struct PatternProgramText {
    std::string file, macros;
};
PatternProgramText program_text(const PatternPaint& paint);

} // namespace limn::gpu
