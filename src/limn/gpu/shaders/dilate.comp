// Gives each pixel the colour of the one its vector leads to; alpha stays.
layout(local_size_x = 16, local_size_y = 16) in;
layout(std430, binding = 0) readonly buffer Held { uint held[]; };
layout(std430, binding = 1) readonly buffer Picture { vec4 picture[]; };
layout(std430, binding = 2) writeonly buffer Dilated { vec4 dilated[]; };
uniform ivec2 size;

uint vector_at(const ivec2 p) { return held[p.y * size.x + p.x]; }

#include "limn/formulas/vector_propagation.glsl"

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at.x >= size.x || at.y >= size.y)
        return;
    int i = at.y * size.x + at.x;
    uint v = vector_at(at);
    ivec2 from = v == no_vector() ? at : at + unpacked_vector(v);
    dilated[i] = vec4(vec3(picture[from.y * size.x + from.x]), picture[i].w);
}
