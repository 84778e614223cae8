// Marks the pixels on outlines and folds: those that take several samples.
#include "limn/formulas/pattern_picture.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(binding = 0) uniform sampler2D places; // w: size of a pixel there, 0 where nothing is seen
layout(binding = 1) uniform sampler2D sides;
layout(std430, binding = 7) writeonly buffer Mask { uint mask[]; };
uniform ivec2 size;

SeenPlace place_at(const ivec2 p)
{
    vec4 place = texelFetch(places, p, 0);
    return SeenPlace(place.xyz, texelFetch(sides, p, 0).xyz, place.w);
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
