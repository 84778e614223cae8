// The triangles that a triangle is split into: the templates of the thesis, as bisections.
#include "limn/gpu/shaders/par_feedback.glsl"

layout(triangle_strip, max_vertices = 12) out;
layout(xfb_buffer = 0, xfb_offset = 0, xfb_stride = 4) flat out uint corner;

void emit(const Triangle t)
{
    corner = pack_point(t.apex);
    EmitVertex();
    corner = pack_point(t.a);
    EmitVertex();
    corner = pack_point(t.b);
    EmitVertex();
    EndPrimitive();
}

void emit_half(const Triangle t, const bool splits)
{
    if (splits) {
        emit(left_of(t));
        emit(right_of(t));
    } else {
        emit(t);
    }
}

void main()
{
    Triangle t = input_triangle();
    uint edges = split_edges(t);
    if (edges == 0u) {
        emit(t);
        return;
    }
    emit_half(left_of(t), (edges & 1u) != 0u);
    emit_half(right_of(t), (edges & 2u) != 0u);
}
