// One thread: the state back to the beginning of a view, whose leaves are those of the last one.
#include "limn/gpu/shaders/leaves.glsl"

layout(local_size_x = 1) in;

void main()
{
    needed = 0u;
    pieces_needed = 0u;
    finished = 0u;
    passes = 0u;
    marks = 0u;
    step_marks = 0u;
    step_tested = 0u;
    for (uint k = 0u; k < 12u; ++k)
        arguments[k] = NO_GROUPS;
    arguments[COUNT] = groups_for(count);
}
