// The face that pattern_surface.frag saw at a pixel.
#include "limn/formulas/shading.glsl"

layout(std430, binding = 2) readonly buffer Faces { vec4 faces[]; }; // unit normal, or zero; w: object

vec4 face_at(const vec4 facing) { return faces[floatBitsToUint(facing.w) - 0x800000u]; }

/// Its normal; towards the eye where it has no area.
vec3 outside_of(const vec4 face, const vec3 to_eye)
{
    return dot(face.xyz, face.xyz) == 0.0f ? to_eye : face.xyz;
}
