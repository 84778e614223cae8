// Cloth with holes. Macro: WOVEN.
#include "limn/gpu/shaders/pattern_numbers.glsl"
#include "limn/formulas/thread.glsl"

vec4 pattern_at(const PatternNumbers n, const PatternPoint p, const int kernel, const float width, const Illumination lit)
{
    ThreadPattern c = ThreadPattern(n.own[0].x, n.own[0].y, n.own[1].xyz, n.own[0].z, n.own[0].w, n.own[1].w, n.own[2].w, WOVEN);
    return thread_around(c, n.own[2].xyz, p, kernel, width, lit);
}

vec4 marked(const PatternNumbers n, const vec4 light, const vec3 normal, const vec3 outside, const vec3 to_eye);
#include "limn/gpu/shaders/pattern_seen.glsl"

vec4 marked(const PatternNumbers n, const vec4 light, const vec3 normal, const vec3 outside, const vec3 to_eye)
{
    return vec4(shown_light(light.xyz), light.w);
}
