// How lit pictures shade a point: the tone between a dark and a light colour.
#include "limn/formulas/shading.glsl"

uniform vec3 light;         // place of a lamp, or the unit direction towards a distant light
uniform int light_kind;     // 0: headlight, 1: distant, 2: lamp
uniform float toon_limit;
uniform float toon_levels;  // 0: no toon shading

float tone_at(const vec3 position, const vec3 normal, const vec3 to_eye)
{
    vec3 to_light = to_eye;
    if (light_kind == 1)
        to_light = light;
    else if (light_kind == 2 && light != position)
        to_light = normalize(light - position);
    return surface_tone(normal, to_eye, to_light, toon_limit, toon_levels);
}
