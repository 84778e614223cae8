// One work-group: sums over the blocks, and what comes next. Where a pass has changed nothing, or has split nothing, it was the last one.
#include "limn/gpu/shaders/leaves.glsl"
#include "limn/gpu/shaders/scan_list.glsl"

layout(local_size_x = 256) in;

void main()
{
    bool is_over = finished != 0u || needed > 0u;
    uint sum = is_over ? 0u : scan_blocks_of(count);
    if (gl_LocalInvocationIndex != 0u)
        return;
    arguments[FILL] = NO_GROUPS;
    if (is_over)
        return;
    total = sum;
    if (total > capacity) {
        needed = total;
        arguments[COUNT] = NO_GROUPS;
        return;
    }
    passes += 1u;
    if (step_marks > step_tested) { // more changes than before this pass
        arguments[FILL] = groups_for(count);
        side = 1u - side;
        before = count;
        count = total;
    }
    bool more = marks > 0u;
    step_tested = step_marks;
    marks = 0u;
    finished = more ? 0u : 1u;
    arguments[COUNT] = more ? groups_for(count) : NO_GROUPS;
    arguments[PIECES_COUNT] = more ? NO_GROUPS : groups_for(count);
}
