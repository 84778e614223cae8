// The quantities themselves, and the ink of lines decided here (M7, M6). Methods are those of limn::ShaderMethod, in its order.
#include "limn/formulas/shader_lines.glsl"
#include "limn/formulas/texture_lines.glsl"

in float nv;
in float kr;
in float dwkr;
in float strength;
in vec3 normal;
in float eye_depth;
flat in uint object;
uniform int method;
uniform float pixels_per_unit; // at depth 1; at any depth in orthographic views
uniform int orthographic;
uniform float contour_width;   // px, all of it on the surface's side
uniform float suggestive_width;
uniform float least_strength;  // of sin^2 D kr for a suggestive contour, units of the model
uniform int naive;             // 1: the thresholds of old, on the quantities alone, for comparison
uniform int suggestive;
uniform float feature_size;
uniform float suggestive_limit;
layout(binding = 0) uniform sampler2D contour_bar;
layout(binding = 1) uniform sampler2D suggestive_bar;
layout(location = 0) out vec4 quantities; // n.v, kr, D kr, ink
layout(location = 1) out vec4 shape;      // normal, depth
layout(location = 2) out uint id;

float width_ink()
{
    if (naive != 0)
        return abs(nv) < 0.1f * contour_width ? 1.0f : 0.0f;
    float per_unit = orthographic != 0 ? pixels_per_unit : pixels_per_unit / eye_depth;
    return shader_ink(nv, kr, dwkr, per_unit, contour_width, suggestive_width, least_strength);
}

float look_up(sampler2D bar, vec2 place)
{
    return textureLod(bar, place, texture_level(dFdx(place), dFdy(place), float(textureSize(bar, 0).x))).x;
}

float texture_ink()
{
    float contour = look_up(contour_bar, contour_place(nv));
    float other = look_up(suggestive_bar, suggestive_place(kr, strength, feature_size, suggestive_limit));
    return suggestive != 0 && nv > 0.0f ? max(contour, other) : contour;
}

void main()
{
    float ink = method == 1 ? width_ink() : method == 2 ? texture_ink() : 0.0f;
    quantities = vec4(nv, kr, dwkr, ink);
    shape = vec4(normalize(normal), eye_depth);
    id = object;
}
