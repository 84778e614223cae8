// One thread a triangle: tests the edges of new ones.
#include "limn/gpu/shaders/par.glsl"
#include "limn/gpu/shaders/terrain_seen.glsl"
#include "limn/gpu/shaders/par_error.glsl"

layout(local_size_x = 256) in;
shared uint group_tested;

/// The tests are in loops of no turns where there is nothing to test: software renderers run both sides of an `if`.
uint tested_edges(const Triangle t, const bool fresh, out bool tested)
{
    bool seen = fresh;
    for (int turns = fresh && cull != 0u ? 1 : 0; turns > 0; --turns)
        seen = triangle_seen(t);
    tested = seen;
    ivec2 from[3] = ivec2[3](t.apex, t.b, t.a);
    ivec2 to[3] = ivec2[3](t.a, t.apex, t.b);
    uint edges = 0u;
    for (int k = seen ? 0 : 3; k < 3; ++k)
        if (edge_can_split(from[k], to[k]) && (cull == 0u || edge_seen(from[k], to[k])) && is_too_far_off(from[k], to[k]))
            edges |= 1u << k;
    return edges;
}

void main()
{
    if (gl_LocalInvocationIndex == 0u)
        group_tested = 0u;
    barrier();
    uint i = gl_GlobalInvocationID.x;
    if (i < count) {
        uvec4 e = entry(i);
        bool tested;
        e.w = tested_edges(triangle_of(e), (e.w & FRESH) != 0u, tested);
        set_entry_of(side, i, e);
        if (tested)
            atomicAdd(group_tested, 1u);
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u && group_tested > 0u)
        atomicAdd(step_tested, group_tested);
}
