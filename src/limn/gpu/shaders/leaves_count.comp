// One thread a leaf: is it split, or merged as far up as the view allows? In the first pass all are asked, later only what the pass before made.
#include "limn/gpu/shaders/leaves.glsl"
#include "limn/gpu/shaders/terrain_eye.glsl"
#include "limn/gpu/shaders/group_sum.glsl"

layout(local_size_x = 256) in;
layout(std430, binding = 4) readonly buffer Bounds { vec4 bounds[]; }; // per lattice point error, low, high
uniform float reaches[32]; // cells, by levels above the finest points
uniform float tolerance;   // pixels
shared uint group_splits;
shared uint group_changes;

/// As ViewTest (terrain_view.h). Boxes and bounds grow with their level by more than rounding can take from them, so that those of a triangle are
/// never less than those of its parts, and never less than exact ones.
bool is_split(const Triangle t)
{
    const float slack = 2e-5f;
    if (!edge_can_split(t.a, t.b))
        return false;
    vec4 known = bounds[point_index(middle_of(t.a, t.b))];
    if (known.x == 0.0f || !(known.y <= known.z))
        return false;
    ivec2 along = abs(t.a - t.b);
    int level = 2 * findMSB(uint(max(along.x, along.y) / 2)) + (along.x == along.y ? 1 : 0);
    float grown = float(level + 1);
    vec3 reach = vec3(reaches[level] * spacing, 0.5f * (known.z - known.y)) + grown * margin;
    vec3 middle = from_eye(t.a + t.b, 0.5f * ((known.y - eye_height) + (known.z - eye_height)));
    if (cull != 0u && !box_may_be_seen(view, across, middle, reach, 0.0f))
        return false;
    return height_error_bound(view, middle, reach, known.x, slack * grown) > tolerance;
}

Triangle parent_of(const Triangle t, const bool is_right)
{
    if (is_right)
        return Triangle(t.b, 2 * t.apex - t.a, t.a);
    return Triangle(t.a, t.b, 2 * t.apex - t.b);
}

/// @return the leaf as it is after the pass. It is asked for in one place, so that all threads that ask for a triangle do the same sums.
uvec4 decide(const uvec4 leaf)
{
    uint path = leaf.w & PATH;
    Triangle asked = triangle_of(leaf);
    uvec4 stays = uvec4(leaf.xyz, path | SPLITS);
    for (uint climbed = 0u; !is_split(asked); ++climbed) {
        bool is_first = (path & ((1u << climbed) - 1u)) == 0u;
        uint own = path >> climbed;
        stays = entry_for(asked, own | (is_first ? STAYS : GOES));
        if (own <= 1u || passes > 0u)
            break;
        asked = parent_of(asked, (own & 1u) != 0u);
    }
    return stays;
}

void main()
{
    if (gl_LocalInvocationIndex == 0u) {
        group_splits = 0u;
        group_changes = 0u;
    }
    barrier();
    uint i = gl_GlobalInvocationID.x;
    uvec4 leaf = i < count ? entry(i) : uvec4(0u, 0u, 0u, GOES);
    bool asks = i < count && (passes == 0u || (leaf.w & ~PATH) == TO_TEST);
    uint path = leaf.w & PATH;
    for (int turns = asks ? 1 : 0; turns > 0; --turns) // none where nothing is asked: software renderers run both sides of an `if`
        leaf = decide(leaf);
    if (asks) {
        set_entry_of(side, i, leaf);
        if ((leaf.w & ~PATH) == SPLITS)
            atomicAdd(group_splits, 1u);
        if ((leaf.w & ~PATH) != STAYS || (leaf.w & PATH) != path)
            atomicAdd(group_changes, 1u);
    }
    uint all = 0u;
    sum_before(number_made_of(leaf.w), all);
    if (gl_LocalInvocationIndex != 0u)
        return;
    sums[gl_WorkGroupID.x] = all;
    if (group_changes > 0u) {
        atomicAdd(marks, group_splits);
        atomicAdd(step_marks, group_changes);
    }
}
