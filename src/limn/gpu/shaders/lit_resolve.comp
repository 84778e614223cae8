// The finished picture: the centre of a pixel where it looks like the eight around it, else the mean of its samples.
#include "limn/formulas/shading.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(binding = 0) uniform sampler2D centres;
layout(std430, binding = 4) buffer Sums { vec4 sums[]; }; // in: sums of samples, out: the picture
uniform ivec2 size;
uniform float count; // of samples

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at.x >= size.x || at.y >= size.y)
        return;
    vec4 centre = texelFetch(centres, at, 0);
    bool even = true;
    for (int y = max(at.y - 1, 0); y <= min(at.y + 1, size.y - 1); ++y)
        for (int x = max(at.x - 1, 0); x <= min(at.x + 1, size.x - 1); ++x)
            even = even && !is_step(texelFetch(centres, ivec2(x, y), 0).xyz, centre.xyz);
    int i = at.y * size.x + at.x;
    sums[i] = even ? centre : sums[i] / count;
}
