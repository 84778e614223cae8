// One thread a triangle: adds the marks of earlier passes to its edges, and says whether its hypotenuse has to be marked.
#include "limn/gpu/shaders/par.glsl"

layout(local_size_x = 256) in;
layout(std430, binding = 4) readonly buffer EdgeErrorMap { uint marked[]; }; // a bit for each lattice point
uniform ivec2 points;
shared uint group_marks;

bool is_marked(const ivec2 a, const ivec2 b)
{
    ivec2 p = middle_of(a, b);
    uint i = uint(p.y) * uint(points.x) + uint(p.x);
    return edge_can_split(a, b) && (marked[i / 32u] >> (i % 32u) & 1u) != 0u;
}

uint marked_edges(const Triangle t)
{
    return (is_marked(t.apex, t.a) ? FIRST_LEG : 0u) | (is_marked(t.b, t.apex) ? SECOND_LEG : 0u) | (is_marked(t.a, t.b) ? HYPOTENUSE : 0u);
}

void main()
{
    if (gl_LocalInvocationIndex == 0u)
        group_marks = 0u;
    barrier();
    uint i = gl_GlobalInvocationID.x;
    if (i < count) {
        uvec4 e = entry(i);
        uint edges = (e.w & 7u) | marked_edges(triangle_of(e));
        if (edges != 0u && edges < HYPOTENUSE) {
            edges |= MARKS;
            atomicAdd(group_marks, 1u);
        }
        if (edges != e.w)
            set_entry_of(side, i, uvec4(e.xyz, edges));
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u && group_marks > 0u)
        atomicAdd(marks, group_marks);
}
