// The finished picture: the mean of the samples of a pixel on an edge, else what is at its centre. Linear.
layout(local_size_x = 16, local_size_y = 16) in;
layout(binding = 0) uniform sampler2D centres;
layout(std430, binding = 4) buffer Sums { vec4 sums[]; }; // in: sums of samples, out: the picture
layout(std430, binding = 7) readonly buffer Mask { uint mask[]; };
uniform ivec2 size;
uniform float count; // of samples; 1: there is none but the centre

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at.x >= size.x || at.y >= size.y)
        return;
    int i = at.y * size.x + at.x;
    sums[i] = count > 1.0f && mask[i] != 0u ? sums[i] / count : texelFetch(centres, at, 0);
}
