#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "limn/pattern/ground_shadow.h"
#include "limn/pattern/pattern_shader.h"

namespace limn {

using PatternShader = std::variant<LayerShader, BrickShader, ThreadShader>;

/// One pattern with all of its numbers.
struct PaintedPattern {
    std::vector<PatternShader> lit; ///< by one light each, which add up; not empty
    PatternFrame frame;             ///< its own, from that of the scene
};

/// The plane under everything.
struct PaintedGround {
    GroundPlane plane;
    GroundShadow shadow;
    vec3 colour; ///< linear, where it is lit
};

/// A picture of patterns with all that is decided before its first pixel; in the frame of the scene. Processor and devices paint it alike.
struct PatternPaint {
    std::vector<PaintedPattern> patterns;  ///< one for all parts of the scene, or one for each
    int kernel = formulas::KERNEL_NONE;    ///< of a pixel, where the pattern is filtered
    float width = 1;                       ///< of the kernel, pixels
    std::vector<vec2> samples;             ///< of the pattern in a pixel, instead; empty: it is filtered
    bool see_through = false;              ///< what is behind a side shows through it
    bool flat = false;                     ///< faces are shaded by their own normals
    float overhang = 2;                    ///< sine of the angle from upright beyond which faces are marked; above 1: none is
    bool cusps = false;                    ///< shows them instead of the print
    float mm_per_length = 1, layer_mm = 1; ///< of the frame's unit; of the thickest layer
    vec3 background = vec3(1);             ///< linear
    std::optional<PaintedGround> ground;
    int edge_samples = 16; ///< of a pixel on an outline or fold, 1: none is different
};

/// Marks of overhangs: their colour, linear, and how much of it is laid over the print.
inline const vec3 overhang_colour = vec3(0.75f, 0.04f, 0.03f);
inline constexpr float overhang_cover = 0.6f;

} // namespace limn
