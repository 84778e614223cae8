// Vertices for pictures of patterns.
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; }; 
layout(std430, binding = 1) readonly buffer Normals { vec4 normals[]; };
uniform mat4 to_clip;

out vec3 position;
out vec3 normal;

void main()
{
    vec4 p = positions[gl_VertexID];
    position = p.xyz;
    normal = normals[gl_VertexID].xyz;
    gl_Position = to_clip * vec4(p.xyz, 1.0f);
}
