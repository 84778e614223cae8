// The quantities themselves, and the ink of lines decided here (M7).
#include "limn/formulas/shader_lines.glsl"

in float nv;
in float kr;
in float dwkr;
in vec3 normal;
in float eye_depth;
flat in uint object;
uniform float pixels_per_unit; // at depth 1; at any depth in orthographic views
uniform int orthographic;
uniform float contour_width;   // px, all of it on the surface's side
uniform float suggestive_width;
uniform float least_strength;  // of sin^2 D kr for a suggestive contour, units of the model
uniform int naive;             // 1: the thresholds of old, on the quantities alone, for comparison
layout(location = 0) out vec4 quantities; // n.v, kr, D kr, ink
layout(location = 1) out vec4 shape;      // normal, depth
layout(location = 2) out uint id;

void main()
{
    float per_unit = orthographic != 0 ? pixels_per_unit : pixels_per_unit / eye_depth;
    float ink = shader_ink(nv, kr, dwkr, per_unit, contour_width, suggestive_width, least_strength);
    if (naive != 0)
        ink = abs(nv) < 0.1f * contour_width ? 1.0f : 0.0f;
    quantities = vec4(nv, kr, dwkr, ink);
    shape = vec4(normalize(normal), eye_depth);
    id = object;
}
