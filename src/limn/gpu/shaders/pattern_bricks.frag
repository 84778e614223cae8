// Bricks in mortar. Macros: BRICK_AXES, BRICK_BOND, FINISH_MODEL.
#include "limn/gpu/shaders/pattern_numbers.glsl"
#include "limn/formulas/brick_filter.glsl"

vec4 pattern_at(const PatternNumbers n, const PatternPoint p, const int kernel, const float width, const Illumination lit)
{
    BrickPattern b = BrickPattern(n.own[0].xyz, n.own[0].w, BRICK_AXES, n.own[1].xyz, n.own[2].xyz, n.own[3].xyz, n.own[1].w, BRICK_BOND);
    return vec4(bricks_through(b, finish_of(FINISH_MODEL, n.own[4], n.own[5]), p, kernel, width, lit), 1.0f);
}

vec4 marked(const PatternNumbers n, const vec4 light, const vec3 normal, const vec3 outside, const vec3 to_eye);
#include "limn/gpu/shaders/pattern_seen.glsl"

vec4 marked(const PatternNumbers n, const vec4 light, const vec3 normal, const vec3 outside, const vec3 to_eye)
{
    return vec4(shown_light(light.xyz), light.w);
}
