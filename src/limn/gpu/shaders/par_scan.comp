// One work-group: sums over the blocks, and what comes next: the other list, or, where nothing is split any more, the mesh is finished.
#include "limn/gpu/shaders/par.glsl"
#include "limn/gpu/shaders/scan_list.glsl"

layout(local_size_x = 256) in;

void finish()
{
    finished = 1u;
    for (uint k = 0u; k <= FILL; ++k)
        arguments[k] = NO_GROUPS;
    arguments[PIECES_COUNT] = groups_for(count);
}

void main()
{
    uint sum = scan_blocks_of(count);
    if (gl_LocalInvocationIndex != 0u)
        return;
    total = sum;
    if (total > capacity) {
        needed = total;
        for (uint k = 0u; k <= FILL; ++k)
            arguments[k] = NO_GROUPS;
        return;
    }
    steps[min(step_number, 63u)] = uvec4(step_passes, step_marks, total, step_tested);
    step_number += 1u;
    step_passes = 0u;
    step_marks = 0u;
    step_tested = 0u;
    if (total == count) {
        finish();
        return;
    }
    arguments[FILL] = groups_for(count);
    arguments[TEST] = groups_for(total);
    arguments[MARK] = groups_for(total);
    side = 1u - side;
    before = count;
    count = total;
}
