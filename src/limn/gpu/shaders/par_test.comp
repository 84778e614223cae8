// One thread a triangle: tests the edges of new ones.
#include "limn/formulas/terrain_error.glsl"
#include "limn/gpu/shaders/par.glsl"
#include "limn/gpu/shaders/terrain_seen.glsl"

layout(local_size_x = 256) in;
uniform uint on_screen;   // 1: `tolerance` is in pixels, 0: metres
uniform float tolerance;
shared uint group_tested;

bool is_too_far_off(const ivec2 a, const ivec2 b)
{
    ivec2 p = middle_of(a, b);
    float at_a = height_at(a);
    float at_b = height_at(b);
    float at_p = height_at(p);
    int known = int(has_data(at_a)) + int(has_data(at_b)) + int(has_data(at_p));
    if (known < 3)
        return known > 0;
    float off = height_off_chord(at_a, at_p, at_b);
    if (on_screen == 0u)
        return abs(off) > tolerance;
    ErrorCamera camera = ErrorCamera(view.right, view.above, view.forward, view.scale, view.near_depth, view.is_parallel);
    vec3 place = from_eye(2 * p, 0.5f * ((at_a - eye_height) + (at_b - eye_height)));
    return max(height_error_exact(camera, place, off), height_error_any_way(camera, place, off)) > tolerance;
}

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
