// One thread a vertex: what a view makes of it.
#include "limn/gpu/shaders/extraction.glsl"

layout(local_size_x = 256) in;
uniform uint vertex_count;
layout(std430, binding = 1) readonly buffer Normals { vec4 normals[]; };
layout(std430, binding = 4) readonly buffer Directions { vec4 e1_k1[]; };
layout(std430, binding = 5) readonly buffer SecondDirections { vec4 e2_k2[]; };
layout(std430, binding = 6) readonly buffer Derivatives { vec4 derivatives[]; }; // P Q S T

void main()
{
    uint i = group_number() * BLOCK + gl_LocalInvocationIndex;
    if (i >= vertex_count)
        return;
    vec3 v = to_eye(positions[i].xyz);
    vec3 n = normals[i].xyz;
    if ((wanted & 6u) == 0u) {
        values[i] = vec4(dot(n, v), 0.0f, 0.0f, 0.0f);
        return;
    }
    float k1 = e1_k1[i].w;
    float k2 = e2_k2[i].w;
    RadialTerms r = radial_terms(v, n, e1_k1[i].xyz, e2_k2[i].xyz, k1, k2);
    SuggestiveCorner corner = suggestive_corner(r, i, k1, k2, derivatives[i], limits[0], orthographic != 0);
    SuggestiveCorner highlight = suggestive_corner(r, i, k1, k2, derivatives[i], limits[1], orthographic != 0);
    values[i] = vec4(r.nv, corner.kr, corner.strength, highlight.strength);
    if (limits[0].speed_limit > 0.0f)
        speeds[i] = vec2(corner.turn, corner.gradient);
    else if (limits[1].speed_limit > 0.0f)
        speeds[i] = vec2(highlight.turn, highlight.gradient);
}
