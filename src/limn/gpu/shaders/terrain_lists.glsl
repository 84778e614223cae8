// Triangles of a terrain in two lists, of which a pass reads one and writes the other, and the state that passes leave for each other
// (terrain_lists.h). A triangle is uvec4(apex, a, b, bits) of lattice points x | y << 16.
#include "limn/gpu/shaders/lattice_triangle.glsl"

const uint BLOCK = 256u; // threads of a work-group
struct Arguments {       // of an indirect dispatch
    uint x;
    uint y;
    uint z;
    uint unused;
};
layout(std430, binding = 0) buffer State {
    uint side;          // of the current list
    uint count;         // of its triangles
    uint before;        // of those in the other list that it was made of
    uint capacity;
    uint total;         // of what a pass would make
    uint needed;        // more than the capacity: there was no room for so many
    uint finished;
    uint passes;
    uint marks;         // of this pass
    uint step_passes;
    uint step_marks;
    uint step_tested;
    uint step_number;
    uint pieces;
    uint pieces_needed; // as `needed`
    uint pieces_capacity;
    Arguments arguments[12];
    uvec4 steps[64];    // passes, marks, triangles, tested
};
layout(std430, binding = 1) buffer FirstList { uvec4 first_list[]; };
layout(std430, binding = 2) buffer SecondList { uvec4 second_list[]; };
layout(std430, binding = 3) buffer Sums { uint sums[]; }; // per block of the list

uvec4 entry_of(const uint list, const uint i) { return list == 0u ? first_list[i] : second_list[i]; }
void set_entry_of(const uint list, const uint i, const uvec4 entry)
{
    if (list == 0u)
        first_list[i] = entry;
    else
        second_list[i] = entry;
}
uvec4 entry(const uint i) { return entry_of(side, i); }

Arguments groups_for(const uint threads) { return Arguments((threads + BLOCK - 1u) / BLOCK, 1u, 1u, 0u); }
const Arguments NO_GROUPS = Arguments(0u, 0u, 0u, 0u);
