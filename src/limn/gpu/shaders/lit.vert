// Vertices for lit pictures: those of the model, or where they have texture coordinates the corners of its faces.
#include "limn/gpu/shaders/lit_tone.glsl"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; }; // w: index of the object
layout(std430, binding = 1) readonly buffer Normals { vec4 normals[]; };
layout(std430, binding = 2) readonly buffer Faces { uint corners[]; };
layout(std430, binding = 5) readonly buffer Uvs { vec2 uvs[]; };
uniform mat4 to_clip;
uniform int mapped;       // 1: corners
uniform vec3 eye;         // position, or the direction towards it
uniform int orthographic;

out vec3 position;
out vec3 normal;
flat out uint object;
out vec2 uv;
out vec2 vertex_tones; // of the surface's outer side and its inner one

void main()
{
    uint vertex = mapped != 0 ? corners[gl_VertexID] : uint(gl_VertexID);
    vec4 p = positions[vertex];
    position = p.xyz;
    normal = normals[vertex].xyz;
    object = uint(p.w + 0.5f);
    uv = mapped != 0 ? uvs[gl_VertexID] : vec2(0.0f);
    vec3 to_light = light_from(position, orthographic != 0 ? eye : normalize(eye - position));
    vertex_tones = vec2(side_tone(normal, to_light, toon_limit, toon_levels), side_tone(-normal, to_light, toon_limit, toon_levels));
    gl_Position = to_clip * vec4(p.xyz, 1.0f);
}
