// The runs of depth of each texel of an object's maps, as the seed keeps them.
layout(std430, binding = 0) readonly buffer Firsts { uint firsts[]; }; // texels + 1: where lists begin
layout(std430, binding = 1) readonly buffer Runs { uvec2 runs[]; };    // a depth's bits, and the rank of its last map

uint last_of_run(const uint i) { return runs[i].y; }
#include "limn/formulas/segment_search.glsl"

// A depth source.
float stored_depth(const uint texel, const uint rank)
{
    return uintBitsToFloat(runs[run_of_rank(firsts[texel], firsts[texel + 1u], rank)].x);
}
