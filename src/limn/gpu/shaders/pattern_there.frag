// Opens the pixels where a surface is seen to what is drawn at the furthest depth, for GL_GREATER.
layout(binding = 3) uniform sampler2D places; // w: 0 where nothing is seen

void main()
{
    if (texelFetch(places, ivec2(gl_FragCoord.xy), 0).w == 0.0f)
        discard;
    gl_FragDepth = 0.0f;
}
