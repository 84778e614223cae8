// Layers of a print. Macros: LAYER_MODEL, LAYER_TABLE (1: some layers have heights of their own), FINISH_MODEL, CUSPS (1: the heights of cusps are shown instead).
#include "limn/gpu/shaders/pattern_numbers.glsl"
#include "limn/formulas/print_layers.glsl"

layout(binding = 1) uniform sampler2D tops; // of the layers of all patterns, row by row
#if CUSPS
layout(std430, binding = 6) readonly buffer Palette { vec4 palette[]; }; // from none to the highest; linear
#endif
uniform float overhang;      // sine of the angle from which overhangs are marked; above 1: none is
uniform vec4 mark;           // their colour, and how much of it
uniform float mm_per_length;
uniform float layer_mm;      // height of the thickest layer
int first_top = 0;

float layer_top(const int k)
{
    int i = first_top + k;
    return texelFetch(tops, ivec2(i % TABLE_WIDTH, i / TABLE_WIDTH), 0).x;
}
#include "limn/formulas/layer_table.glsl"

LayerPattern layers_of(const PatternNumbers n)
{
    return LayerPattern(LAYER_MODEL, n.own[0].xyz, n.own[0].w, n.own[1].x, n.own[1].y, n.own[1].z, n.own[2].xyz, n.own[1].w);
}

LayerPlace place_of(const PatternNumbers n, const vec3 position, const vec2 change, const float width)
{
    first_top = int(n.own[3].w);
    return layer_place(LayerRow(n.own[3].x, n.own[3].y, LAYER_TABLE != 0 ? int(n.own[3].z) : 0), dot(position, n.own[0].xyz), change, width);
}

vec4 pattern_at(const PatternNumbers n, const PatternPoint p, const int kernel, const float width, const Illumination lit)
{
    LayerPattern s = layers_of(n);
    LayerPlace place = place_of(n, p.position, change_per_pixel(p, s.up), width);
    return vec4(layers_through(s, finish_of(FINISH_MODEL, n.own[4], n.own[5]), p, place, kernel, width, lit), 1.0f);
}

vec4 marked(const PatternNumbers n, const vec4 light, const vec3 normal, const vec3 outside, const vec3 to_eye);
#include "limn/gpu/shaders/pattern_seen.glsl"

// The frame of prints is that of the scene.
vec4 marked(const PatternNumbers n, const vec4 light, const vec3 normal, const vec3 outside, const vec3 to_eye)
{
    vec3 shown = shown_light(light.xyz);
    float along = dot(outside, n.own[0].xyz);
#if CUSPS
    float height = place_of(n, position, vec2(0.0f), 1.0f).height * mm_per_length;
    float at = clamp(cusp_height(height, along) / layer_mm, 0.0f, 1.0f) * float(palette.length() - 1);
    int k = min(int(at), palette.length() - 2);
    shown = mix(palette[k].xyz, palette[k + 1].xyz, at - float(k)) * cusp_light(normal, to_eye);
#endif
    return vec4(overhang <= 1.0f && -along > overhang ? mix(shown, mark.xyz, mark.w) : shown, 1.0f);
}
