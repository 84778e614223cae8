// Gives the pixels that take no samples a depth: 0 hides all that follows there, 1 makes them those where nothing is seen.
layout(std430, binding = 7) readonly buffer Mask { uint mask[]; };
uniform int tile_width;
uniform float depth;

void main()
{
    if (mask[int(gl_FragCoord.y) * tile_width + int(gl_FragCoord.x)] != 0u)
        discard;
    gl_FragDepth = depth;
}
