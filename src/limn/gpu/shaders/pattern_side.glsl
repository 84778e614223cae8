// What pattern_surface.frag saw at a pixel.
#include "limn/formulas/pattern_eye.glsl"
#include "limn/formulas/shading.glsl"

layout(binding = 4) uniform sampler2D faces; // row by row: unit normal, or zero; w: object

struct SeenSide {
    float depth;
    vec3 normal; // unit; zero where the surface has none
    vec4 face;
};

// Of what is written there where something is seen: w is 0 where nothing is.
SeenSide side_of(const vec4 seen)
{
    uint bits = floatBitsToUint(seen.w) - 0x800000u;
    uint face = bits >> 1u;
    float z = sqrt(max(1.0f - seen.y * seen.y - seen.z * seen.z, 0.0f));
    vec3 n = seen.y > 1.5f ? vec3(0.0f) : vec3(seen.y, seen.z, (bits & 1u) != 0u ? -z : z);
    return SeenSide(seen.x, n, texelFetch(faces, ivec2(face % uint(TABLE_WIDTH), face / uint(TABLE_WIDTH)), 0));
}

/// The normal of its face; towards the eye where that has no area.
vec3 outside_of(const vec4 face, const vec3 to_eye)
{
    return dot(face.xyz, face.xyz) == 0.0f ? to_eye : face.xyz;
}
