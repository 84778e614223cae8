// One thread: the number of work-groups that write what was found, and commands that draw it, six vertices for each segment, one command
// for each kind.
layout(local_size_x = 1) in;
struct Command {
    uint count;
    uint instances;
    uint first;
    uint base_instance;
};
layout(std430, binding = 6) readonly buffer Sums { uvec4 sums[]; };
layout(std430, binding = 7) writeonly buffer Commands { Command commands[3]; uvec4 groups; };
uniform uint total; // where the sum of all is
uniform uint capacity;

void main()
{
    uvec4 number = sums[total];
    uint first = 0u;
    for (uint kind = 0u; kind < 3u; ++kind) {
        uint held = min(number[kind], capacity - min(first, capacity));
        commands[kind] = Command(6u * held, 1u, 6u * first, 0u);
        first += number[kind];
    }
    uint needed = (min(first, capacity) + 255u) / 256u;
    groups = uvec4(min(needed, 32768u), (needed + 32767u) / 32768u, 1u, 0u);
}
