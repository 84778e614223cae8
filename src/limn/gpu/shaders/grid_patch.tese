// Patch k covers cell k of a square of `side` x `side` cells, which together cover the picture.
layout(quads, equal_spacing, ccw) in;
uniform float side;
void main()
{
    float patch_number = gl_in[0].gl_Position.x;
    vec2 cell = vec2(mod(patch_number, side), floor(patch_number / side));
    gl_Position = vec4((cell + gl_TessCoord.xy) / side * 2.0f - 1.0f, 0.0f, 1.0f);
}
