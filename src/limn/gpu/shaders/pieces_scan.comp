// One work-group: sums over the blocks, and the command that draws the pieces.
#include "limn/gpu/shaders/terrain_lists.glsl"
#include "limn/gpu/shaders/scan_list.glsl"

layout(local_size_x = 256) in;
layout(std430, binding = 7) writeonly buffer Command { uvec4 command; }; // vertices, instances, first, base instance
const uint PIECES_FILL = 11u;

void main()
{
    uint sum = scan_blocks_of(count);
    if (gl_LocalInvocationIndex != 0u)
        return;
    if (sum > pieces_capacity) {
        pieces_needed = sum;
        return;
    }
    pieces = sum;
    command = uvec4(3u * sum, 1u, 0u, 0u);
    arguments[PIECES_FILL] = groups_for(count);
}
