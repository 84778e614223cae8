#pragma once

// The formulas of this room, compiled as C++. The same files are included by shaders; their dialect is a subset of both
// languages (no swizzles, float literals only, out-parameters through macros).

#include "limn/base/vec.h"

#define FORMULA inline
#define OUT(T) T&
#define INOUT(T) T&
#define OUT_ARRAY(T, name, n) T (&name)[n]
#define REAL double // where a formula has to be exact on this side
#define REAL2 dvec2
#define REAL3 dvec3

namespace limn::formulas {
using namespace glm; // the formulas use GLSL's names unqualified
using glm::cos; // and mean these, whatever else of the name there is in limn
using glm::exp;
using glm::sin;
#include "limn/formulas/apparent_ridge.glsl"
#include "limn/formulas/bead_profile.glsl"
#include "limn/formulas/brdf.glsl"
#include "limn/formulas/brick_filter.glsl"
#include "limn/formulas/bricks.glsl"
#include "limn/formulas/crease_outline.glsl"
#include "limn/formulas/direction_grid.glsl"
#include "limn/formulas/edge_zero.glsl"
#include "limn/formulas/hermite_edge.glsl"
#include "limn/formulas/irradiance.glsl"
#include "limn/formulas/lcg.glsl"
#include "limn/formulas/map_rank.glsl"
#include "limn/formulas/normal_map.glsl"
#include "limn/formulas/pattern_eye.glsl"
#include "limn/formulas/pattern_picture.glsl"
#include "limn/formulas/pattern_point.glsl"
#include "limn/formulas/periodic_blur.glsl"
#include "limn/formulas/print_layers.glsl"
#include "limn/formulas/pulse.glsl"
#include "limn/formulas/radial_curvature.glsl"
#include "limn/formulas/shader_lines.glsl"
#include "limn/formulas/shading.glsl"
#include "limn/formulas/shadow_lookup.glsl"
#include "limn/formulas/sobel.glsl"
#include "limn/formulas/suggestive_line.glsl"
#include "limn/formulas/supersampling.glsl"
#include "limn/formulas/terrain_bound.glsl"
#include "limn/formulas/terrain_colour.glsl"
#include "limn/formulas/terrain_error.glsl"
#include "limn/formulas/texture_lines.glsl"
#include "limn/formulas/thread.glsl"
} // namespace limn::formulas

#undef FORMULA
#undef OUT
#undef INOUT
#undef OUT_ARRAY
#undef REAL
#undef REAL2
#undef REAL3
