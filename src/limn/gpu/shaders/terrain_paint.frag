#include "limn/formulas/terrain_colour.glsl"
#include "limn/gpu/shaders/tile_normals.glsl"

in float height;
in vec2 ground;
uniform vec2 spacing;     // metres between samples
uniform ivec2 middle_cell; // where the middle is, in samples: a whole number
uniform vec2 middle_rest;  // and the rest
uniform float pixels_between_normals;
uniform vec3 to_sun;
uniform vec4 plain; // w: 1 where the ground has one colour
uniform int marked; // triangles from here on are marked
layout(location = 0) out vec4 colour;

void main()
{
    vec2 samples = middle_rest + vec2(ground.x, -ground.y) / spacing; // rows run south
    vec2 whole = floor(samples);
    float footprint = pixels_between_normals * max(length(dFdx(samples)), length(dFdy(samples)));
    vec3 normal = tile_normal(max(middle_cell + ivec2(whole), ivec2(0)), samples - whole, footprint);
    vec3 tone = plain.w > 0.5f ? plain.rgb : terrain_tint(height);
    vec4 mark = gl_PrimitiveID >= marked ? unmet_mark() : vec4(0.0f);
    colour = vec4(terrain_light(normal, to_sun) * mix(tone, mark.rgb, mark.a), 1.0f);
}
