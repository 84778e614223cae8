// Counts its runs.
layout(std430, binding = 0) buffer Count { uint runs; };
layout(location = 0) out vec4 colour;
void main()
{
    atomicAdd(runs, 1u);
    colour = vec4(1.0f);
}
