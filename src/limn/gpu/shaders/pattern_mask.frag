// Hides all that follows in the pixels that take no samples: nothing is nearer.
layout(std430, binding = 7) readonly buffer Mask { uint mask[]; };
uniform int tile_width;

void main()
{
    if (mask[int(gl_FragCoord.y) * tile_width + int(gl_FragCoord.x)] != 0u)
        discard;
    gl_FragDepth = 0.0f;
}
