// The colour of one point of a lit surface.
#include "limn/gpu/shaders/lit_tone.glsl"
#include "limn/formulas/normal_map.glsl"

struct Colours {
    vec4 dark;
    vec4 light;
};
struct Part {          // of a normal map
    vec4 x_layer;      // rotated x axis; layer of the texture
    vec4 y;
    vec4 z;
};
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 2) readonly buffer Faces { uint corners[]; };
layout(std430, binding = 3) readonly buffer Objects { Colours colours[]; };
layout(std430, binding = 6) readonly buffer Parts { Part parts[]; };
layout(binding = 1) uniform sampler2DArray maps;
uniform int mapped;       // 1: normals are in maps
uniform vec3 eye;         // position, or the direction towards it
uniform int orthographic;
uniform int shading;      // Shading: 1 flat, 3 gouraud, 4 normals

in vec3 position;
in vec3 normal;
flat in uint object;
in vec2 uv;
in vec2 vertex_tones;
layout(location = 0) out vec4 colour;

vec3 face_normal(const vec3 to_eye)
{
    uint first = 3u * uint(gl_PrimitiveID);
    vec3 a = positions[corners[first]].xyz;
    vec3 n = cross(positions[corners[first + 1u]].xyz - a, positions[corners[first + 2u]].xyz - a);
    return dot(n, n) > 0.0f ? normalize(n) : to_eye;
}

vec3 texel(const ivec2 p, const int layer)
{
    return texelFetch(maps, ivec3(clamp(p, ivec2(0), textureSize(maps, 0).xy - 1), layer), 0).xyz;
}

vec3 normal_in_map()
{
    Part part = parts[object];
    int layer = int(part.x_layer.w + 0.5f);
    vec2 place = map_place(uv, float(textureSize(maps, 0).x));
    ivec2 p = ivec2(floor(place));
    vec3 n = map_normal(texel(p, layer), texel(p + ivec2(1, 0), layer), texel(p + ivec2(0, 1), layer), texel(p + ivec2(1, 1), layer), place - floor(place));
    return mat3(part.x_layer.xyz, part.y.xyz, part.z.xyz) * n;
}

vec3 surface_normal(const vec3 to_eye)
{
    if (shading == 1 || dot(normal, normal) == 0.0f)
        return face_normal(to_eye);
    return mapped != 0 ? normal_in_map() : normalize(normal);
}

float tone_seen(const vec3 n, const vec3 to_eye)
{
    if (shading != 3 || dot(normal, normal) == 0.0f)
        return tone_at(position, n, to_eye);
    return dot(face_normal(to_eye), to_eye) > 0.0f ? vertex_tones.x : vertex_tones.y;
}

void main()
{
    vec3 to_eye = orthographic != 0 ? eye : normalize(eye - position);
    vec3 n = surface_normal(to_eye);
    Colours c = colours[object];
    colour = shading == 4 ? vec4(normal_colour(n), 1.0f) : mix(c.dark, c.light, tone_seen(n, to_eye));
}
