// One thread: after a pass that marked something comes one more, else the triangles are split.
#include "limn/gpu/shaders/par.glsl"

layout(local_size_x = 1) in;

void main()
{
    if (finished != 0u || needed > capacity)
        return;
    bool more = marks > 0u;
    passes += 1u;
    step_passes += 1u;
    step_marks += marks;
    marks = 0u;
    arguments[TEST] = NO_GROUPS;
    arguments[SCATTER] = more ? groups_for(count) : NO_GROUPS;
    arguments[COUNT] = more ? NO_GROUPS : groups_for(count);
    arguments[SCAN] = more ? NO_GROUPS : Arguments(1u, 1u, 1u, 0u);
    arguments[FILL] = NO_GROUPS;
}
