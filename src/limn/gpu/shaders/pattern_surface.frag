// Where surfaces that are made of patterns are seen. Little is done here: patterns are computed afterwards, once for each pixel, however small the triangles are.
// Macro: BEHIND (1: the side that is next behind `before` is looked for).
layout(binding = 0) uniform sampler2D before; // places of the side before
uniform vec3 eye;         // its place; of parallel views, one on the line of sight through the picture's middle
uniform vec3 forward;     // unit
uniform int orthographic;
uniform float pixel_size; // at depth 1; at any depth in parallel views

in vec3 position;
in vec3 normal;
layout(location = 0) out vec4 seen_place;  // w: size of a pixel there
layout(location = 1) out vec4 seen_facing; // the normal as it is between the corners; w: bits of the face's number

void main()
{
    float depth = dot(position - eye, forward);
#if BEHIND
    vec4 last = texelFetch(before, ivec2(gl_FragCoord.xy), 0);
    if (last.w == 0.0f || depth <= dot(last.xyz - eye, forward) + 1e-5f)
        discard;
#endif
    seen_place = vec4(position, orthographic != 0 ? pixel_size : pixel_size * depth);
    seen_facing = vec4(normal, uintBitsToFloat(uint(gl_PrimitiveID) + 0x800000u)); // no denormal numbers
}
