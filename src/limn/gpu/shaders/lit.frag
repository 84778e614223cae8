// The colour of one point of a lit surface.
#include "limn/gpu/shaders/lit_tone.glsl"

struct Colours {
    vec4 dark;
    vec4 light;
};
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 2) readonly buffer Faces { uint corners[]; };
layout(std430, binding = 3) readonly buffer Objects { Colours colours[]; };
uniform vec3 eye;         // position, or the direction towards it
uniform int orthographic;
uniform int flat_shading; // 1: the normals of the triangles

in vec3 position;
in vec3 normal;
flat in uint object;
layout(location = 0) out vec4 colour;

vec3 face_normal(const vec3 to_eye)
{
    uint first = 3u * uint(gl_PrimitiveID);
    vec3 a = positions[corners[first]].xyz;
    vec3 n = cross(positions[corners[first + 1u]].xyz - a, positions[corners[first + 2u]].xyz - a);
    return dot(n, n) > 0.0f ? normalize(n) : to_eye;
}

void main()
{
    vec3 to_eye = orthographic != 0 ? eye : normalize(eye - position);
    vec3 n = flat_shading != 0 || dot(normal, normal) == 0.0f ? face_normal(to_eye) : normalize(normal);
    Colours c = colours[object];
    colour = mix(c.dark, c.light, tone_at(position, n, to_eye));
}
