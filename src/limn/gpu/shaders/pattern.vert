// Vertices for pictures of patterns.
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Normals { vec4 normals[]; };
uniform mat4 to_clip;
uniform vec3 eye;     // its place; of parallel views, one on the line of sight through the picture's middle
uniform vec3 forward; // unit

out float depth;
out vec3 normal;

void main()
{
    vec3 position = positions[gl_VertexID].xyz;
    depth = dot(position - eye, forward);
    normal = normals[gl_VertexID].xyz;
    gl_Position = to_clip * vec4(position, 1.0f);
}
