// Where surfaces that are made of patterns are seen. Little is done here: patterns are computed afterwards, once for each pixel, however small the triangles are.
// One small picture holds what they need: depth, two coordinates of the normal, and the face's number with the third's sign (pattern_side.glsl reads it).
// Macro: BEHIND (1: the side that is next behind `before` is looked for).
layout(binding = 0) uniform sampler2D before; // the side before

in float depth;
in vec3 normal; // as it is between the corners
layout(location = 0) out vec4 seen_side;

void main()
{
#if BEHIND
    vec4 last = texelFetch(before, ivec2(gl_FragCoord.xy), 0);
    if (last.w == 0.0f || depth <= last.x + 1e-5f)
        discard;
#endif
    float size = dot(normal, normal);
    vec3 n = normal * inversesqrt(size);
    uint face = 2u * uint(gl_PrimitiveID) + (n.z < 0.0f ? 1u : 0u);
    seen_side = vec4(depth, size > 0.0f ? n.xy : vec2(2.0f), uintBitsToFloat(face + 0x800000u)); // no denormal numbers
}
