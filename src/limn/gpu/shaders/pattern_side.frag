// One side of see-through surfaces, to be laid under those before it.
layout(binding = 0) uniform sampler2D side_colour;
layout(location = 0) out vec4 colour;

void main()
{
    colour = texelFetch(side_colour, ivec2(gl_FragCoord.xy), 0);
}
