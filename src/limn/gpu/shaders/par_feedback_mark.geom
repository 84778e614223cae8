// A point for each triangle that has a leg to split and not yet its hypotenuse: its middle.
#include "limn/gpu/shaders/par_feedback.glsl"

layout(points, max_vertices = 1) out;
layout(xfb_buffer = 0, xfb_offset = 0, xfb_stride = 4) flat out uint mark;

void main()
{
    Triangle t = input_triangle();
    uint edges = split_edges(t);
    if (edges == 0u || edges >= 4u)
        return;
    mark = pack_point(middle_of(t.a, t.b));
    EmitVertex();
    EndPrimitive();
}
