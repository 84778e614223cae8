// What the geometry shaders of PAR share (par_feedback.h).
#include "limn/gpu/shaders/lattice_triangle.glsl"
#include "limn/gpu/shaders/terrain_eye.glsl"

layout(triangles) in; // apex, a, b
flat in uint point[];
layout(binding = 0) uniform sampler2D heights;
layout(binding = 1) uniform usampler2D edge_error_map; // 1 at the lattice point in the middle of a marked edge

float height_at(const ivec2 p) { return texelFetch(heights, min(p, samples - 1), 0).x; }
#include "limn/gpu/shaders/par_error.glsl"

bool is_split(const ivec2 a, const ivec2 b)
{
    return edge_can_split(a, b) && (texelFetch(edge_error_map, middle_of(a, b), 0).x != 0u || is_too_far_off(a, b));
}

/// Bits: the legs, then the hypotenuse.
uint split_edges(const Triangle t) { return (is_split(t.apex, t.a) ? 1u : 0u) | (is_split(t.b, t.apex) ? 2u : 0u) | (is_split(t.a, t.b) ? 4u : 0u); }
Triangle input_triangle() { return Triangle(unpack_point(point[0]), unpack_point(point[1]), unpack_point(point[2])); }
