// An object as one map after the other sees it, each in its own tile of a picture.
layout(std430, binding = 0) readonly buffer Positions { float positions[]; }; // in unit space, three numbers each
struct Frame {
    vec4 right;
    vec4 up;
    vec4 towards;
};
layout(std430, binding = 1) readonly buffer Frames { Frame frames[]; };
uniform ivec2 tiles; // of the picture

void main()
{
    vec3 p = vec3(positions[3 * gl_VertexID], positions[3 * gl_VertexID + 1], positions[3 * gl_VertexID + 2]);
    Frame frame = frames[gl_InstanceID];
    vec2 tile = vec2(float(gl_InstanceID % tiles.x), float(gl_InstanceID / tiles.x));
    vec2 place = (tile + 0.5f + 0.5f * vec2(dot(p, frame.right.xyz), dot(p, frame.up.xyz))) / vec2(tiles);
    gl_Position = vec4(2.0f * place - 1.0f, 0.5f - 0.5f * dot(p, frame.towards.xyz), 1.0f); // from 0 to 1 in depth
}
