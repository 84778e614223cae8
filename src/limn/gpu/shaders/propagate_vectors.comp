// One pass of the parallel distance transform: one thread a pixel.
layout(local_size_x = 16, local_size_y = 16) in;
layout(std430, binding = 0) readonly buffer Held { uint held[]; };
layout(std430, binding = 1) writeonly buffer Next { uint next[]; };
layout(std430, binding = 2) writeonly buffer Changed { uint changed[]; }; // one for each pass of a batch
uniform ivec2 size;
uniform int stride; // 1: eight neighbours, 2: four
uniform int pass;   // within its batch

uint vector_at(const ivec2 p)
{
    if (p.x < 0 || p.y < 0 || p.x >= size.x || p.y >= size.y)
        return 0xFFFFFFFFu;
    return held[p.y * size.x + p.x];
}

#include "limn/formulas/vector_propagation.glsl"

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at.x >= size.x || at.y >= size.y)
        return;
    int i = at.y * size.x + at.x;
    uint nearest = nearest_vector(at, stride);
    next[i] = nearest;
    if (nearest != held[i])
        changed[pass] = 1u; // every thread that writes writes the same
}
