// What is behind surfaces that are made of patterns: the background, and the ground that fades into it. Macro: GROUND (1: there is one).
#include "limn/formulas/pattern_eye.glsl"
#include "limn/formulas/pattern_picture.glsl"
#include "limn/formulas/shading.glsl"

layout(binding = 5) uniform sampler2D ground_values;
uniform vec3 eye;          // its place; of parallel views, one on the line of sight through the picture's middle
uniform vec3 forward;      // unit
uniform vec3 right;        // per pixel, at depth 1 (at any depth in parallel views)
uniform vec3 down;
uniform int orthographic;
uniform vec2 corner;       // as in pattern_seen.glsl
uniform vec2 middle;
uniform vec3 background;   // colours, linear
uniform vec3 ground_colour;
uniform vec3 ground_up;
uniform vec3 ground_middle;
uniform float ground_radius;
uniform vec3 grid_right;
uniform vec3 grid_ahead;
uniform float grid_reach;
uniform int grid_side;
layout(location = 0) out vec4 colour;

float ground_value(const ivec2 p)
{
    return texelFetch(ground_values, p, 0).x;
}
#include "limn/formulas/ground_light.glsl"

void main()
{
    colour = vec4(background, 1.0f);
#if GROUND
    PatternEye seen_by = PatternEye(eye, forward, right, down, middle, orthographic);
    vec2 pixel = corner + vec2(gl_FragCoord.x, -gl_FragCoord.y);
    vec3 direction = normalize(pattern_sight(seen_by, pixel));
    vec2 off = pixel - middle;
    vec3 origin = orthographic != 0 ? eye + right * off.x + down * off.y : eye;
    float falls = -dot(direction, ground_up);
    float height = dot(origin - ground_middle, ground_up);
    if (!(falls > 0.0f && height > 0.0f))
        return;
    vec3 place = origin + direction * (height / falls);
    float cover = ground_cover(distance(place, ground_middle) / ground_radius);
    GroundGrid grid = GroundGrid(ground_middle, grid_right, grid_ahead, grid_reach, grid_side);
    if (cover > 0.0f)
        colour = vec4(mix(background, ground_colour * ground_light(grid, place), cover), 1.0f);
#endif
}
