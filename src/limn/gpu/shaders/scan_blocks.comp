// One level of a prefix sum (block_scan.h): each group of 256 numbers becomes the sums of those before in the group, and the sum of the
// group goes to the next level.
layout(local_size_x = 256) in;
layout(std430, binding = 6) buffer Sums { uvec4 sums[]; };
uniform uint first; // of this level
uniform uint count;
uniform uint next;  // first of the next level
shared uvec4 prefix[256];

void main()
{
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint lane = gl_LocalInvocationIndex;
    uint i = group * 256u + lane;
    if (group * 256u >= count)
        return; // the whole group
    uvec4 own = i < count ? sums[first + i] : uvec4(0u);
    prefix[lane] = own;
    barrier();
    for (uint reach = 1u; reach < 256u; reach *= 2u) {
        uvec4 before = lane >= reach ? prefix[lane - reach] : uvec4(0u);
        barrier();
        prefix[lane] += before;
        barrier();
    }
    if (i < count)
        sums[first + i] = prefix[lane] - own;
    if (lane == 255u)
        sums[next + group] = prefix[255];
}
