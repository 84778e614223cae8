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

/// Bits: the legs, then the hypotenuse. Asked for in one place, so that both triangles of an edge do the same sums.
uint split_edges(const Triangle t)
{
    ivec2 from[3] = ivec2[3](t.apex, t.b, t.a);
    ivec2 to[3] = ivec2[3](t.a, t.apex, t.b);
    uint edges = 0u;
    for (int k = 0; k < 3; ++k)
        edges |= is_split(from[k], to[k]) ? 1u << k : 0u;
    return edges;
}

Triangle input_triangle() { return Triangle(unpack_point(point[0]), unpack_point(point[1]), unpack_point(point[2])); }
