// What is behind every object: the background, and the ground that fades into it.
#include "limn/gpu/shaders/lit_tone.glsl"

uniform vec3 eye;          // its place; of orthographic views, one on the line of sight through the picture's middle
uniform vec3 forward;      // unit
uniform vec3 right;        // per pixel, at depth 1 (at any depth in orthographic views)
uniform vec3 below;
uniform vec2 from_middle;  // px from the picture's middle to the tile's lower left corner, y down
uniform int orthographic;
uniform vec3 background;
uniform int ground;        // 1: there is one
uniform vec3 ground_up;
uniform vec3 ground_middle;
uniform float ground_radius;
uniform vec3 ground_dark;
uniform vec3 ground_light;
layout(location = 0) out vec4 colour;

void main()
{
    colour = vec4(background, 1.0f);
    if (ground == 0)
        return;
    vec2 offset = from_middle + vec2(gl_FragCoord.x, -gl_FragCoord.y);
    vec3 side = right * offset.x + below * offset.y;
    vec3 origin = orthographic != 0 ? eye + side : eye;
    vec3 direction = orthographic != 0 ? forward : normalize(forward + side);
    float falls = -dot(direction, ground_up);
    float height = dot(origin - ground_middle, ground_up);
    if (!(falls > 0.0f && height > 0.0f))
        return;
    vec3 position = origin + height / falls * direction;
    vec3 seen = mix(ground_dark, ground_light, tone_at(position, ground_up, -direction));
    colour = vec4(mix(background, seen, ground_cover(distance(position, ground_middle) / ground_radius)), 1.0f);
}
