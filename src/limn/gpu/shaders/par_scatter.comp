// One thread a triangle: writes its mark into the edge error map, where the next pass reads it.
#include "limn/gpu/shaders/par.glsl"

layout(local_size_x = 256) in;
layout(std430, binding = 4) buffer EdgeErrorMap { uint marked[]; };
uniform ivec2 points;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= count)
        return;
    uvec4 e = entry(i);
    if ((e.w & MARKS) == 0u)
        return;
    ivec2 p = middle_of(unpack_point(e.y), unpack_point(e.z));
    uint bit = uint(p.y) * uint(points.x) + uint(p.x);
    atomicOr(marked[bit / 32u], 1u << (bit % 32u));
}
