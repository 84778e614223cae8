// The smallest and the largest depth that is seen, as numbers whose order is that of the floats.
layout(local_size_x = 16, local_size_y = 16) in;
layout(binding = 0) uniform sampler2D shape;
layout(binding = 2) uniform usampler2D ids;
layout(std430, binding = 6) buffer Range { uint least; uint most; };
uniform ivec2 size;
shared uint group_least;
shared uint group_most;

void main()
{
    if (gl_LocalInvocationIndex == 0u) {
        group_least = 0xffffffffu;
        group_most = 0u;
    }
    barrier();
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at.x < size.x && at.y < size.y && texelFetch(ids, at, 0).x != 0u) {
        uint bits = floatBitsToUint(texelFetch(shape, at, 0).w);
        uint key = (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
        atomicMin(group_least, key);
        atomicMax(group_most, key);
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        atomicMin(least, group_least);
        atomicMax(most, group_most);
    }
}
