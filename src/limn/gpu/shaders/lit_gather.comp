// Adds one picture of samples to the sums.
layout(local_size_x = 16, local_size_y = 16) in;
layout(binding = 0) uniform sampler2D samples;
layout(std430, binding = 4) buffer Sums { vec4 sums[]; };
uniform ivec2 size;

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at.x < size.x && at.y < size.y)
        sums[at.y * size.x + at.x] += texelFetch(samples, at, 0);
}
