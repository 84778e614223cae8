// What is behind the first surface.
layout(binding = 0) uniform sampler2D first;
uniform float same_surface; // so near to each other two surfaces are one

void main()
{
    if (gl_FragCoord.z <= texelFetch(first, ivec2(gl_FragCoord.xy), 0).r + same_surface)
        discard;
}
