// Marks the pixels on outlines and folds: those that take several samples.
#include "limn/formulas/pattern_picture.glsl"
#include "limn/gpu/shaders/pattern_side.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(binding = 0) uniform sampler2D places; // w: size of a pixel there, 0 where nothing is seen
layout(binding = 1) uniform sampler2D facings;
layout(std430, binding = 7) writeonly buffer Mask { uint mask[]; };
uniform ivec2 size;
uniform vec3 eye;
uniform vec3 forward;
uniform int orthographic;

SeenPlace place_at(const ivec2 p)
{
    vec4 place = texelFetch(places, p, 0);
    if (place.w == 0.0f)
        return SeenPlace(place.xyz, vec3(0.0f), 0.0f);
    vec3 to_eye = orthographic != 0 ? -forward : normalize(eye - place.xyz);
    return SeenPlace(place.xyz, seen_normal(outside_of(face_at(texelFetch(facings, p, 0)), to_eye), to_eye), place.w);
}

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at.x >= size.x || at.y >= size.y)
        return;
    SeenPlace own = place_at(at);
    bool edge = false;
    for (int y = max(at.y - 1, 0); y <= min(at.y + 1, size.y - 1); ++y)
        for (int x = max(at.x - 1, 0); x <= min(at.x + 1, size.x - 1); ++x)
            edge = edge || is_outline(own, place_at(ivec2(x, y)));
    mask[at.y * size.x + at.x] = edge ? 1u : 0u;
}
