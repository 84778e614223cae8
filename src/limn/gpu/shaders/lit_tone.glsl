// How lit pictures shade a point: the tone between a dark and a light colour.
#include "limn/formulas/shading.glsl"

uniform vec3 light;         // place of a lamp, or the unit direction towards a distant light
uniform int light_kind;     // 0: headlight, 1: distant, 2: lamp
uniform float toon_limit;
uniform float toon_levels;  // 0: no toon shading

vec3 light_from(const vec3 position, const vec3 to_eye)
{
    if (light_kind == 2 && light != position)
        return normalize(light - position);
    return light_kind == 1 ? light : to_eye;
}

float tone_at(const vec3 position, const vec3 normal, const vec3 to_eye)
{
    return surface_tone(normal, to_eye, light_from(position, to_eye), toon_limit, toon_levels);
}
