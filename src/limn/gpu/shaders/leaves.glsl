// The leaves of a view, in the order of the hierarchy, and what becomes of them in a pass (terrain_leaves.h). Bits of a triangle: its path from the root
// triangle, 1 and then a bit for each bisection, and in the two highest what a pass has found.
#include "limn/gpu/shaders/terrain_lists.glsl"

const uint PATH = 0x3fffffffu;
const uint TO_TEST = 0u << 30;
const uint STAYS = 1u << 30;  // as it is now, after the merges that were due
const uint SPLITS = 2u << 30;
const uint GOES = 3u << 30;   // it is merged into the one before it

// Places in `arguments`.
const uint COUNT = 0u;
const uint FILL = 1u;
const uint PIECES_COUNT = 9u; // as in terrain_pieces.glsl

uint number_made_of(const uint bits)
{
    uint found = bits & ~PATH;
    return found == STAYS ? 1u : (found == SPLITS ? 2u : 0u);
}
