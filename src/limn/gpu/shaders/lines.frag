// Ink of a line in a pixel. It is seen where the point of the line nearest to the pixel is: the surface next to a contour rises towards the
// eye, and would hide half of the width of its own line.
#include "limn/formulas/shader_lines.glsl"

layout(binding = 0) uniform sampler2D depths; // of the surface
uniform float width;   // px
uniform vec4 channel;

flat in vec3 begin;
flat in vec3 end;
flat in vec2 ink;
layout(location = 0) out vec4 colour;

/// A line is hidden where the surface is nearer at its pixel and at those to both sides: contours run through faces, and may lie a pixel
/// inside of the outline that the faces have in the picture.
/// @param across  unit vector in the picture, square to the line
bool is_seen(const vec3 place, const vec2 across)
{
    ivec2 last = textureSize(depths, 0) - 1;
    float farthest = 0.0f;
    for (int k = -1; k <= 1; ++k)
        farthest = max(farthest, texelFetch(depths, clamp(ivec2(floor(place.xy + float(k) * across)), ivec2(0), last), 0).x);
    return place.z <= farthest;
}

void main()
{
    vec2 along = end.xy - begin.xy;
    float square = dot(along, along);
    float s = square > 0.0f ? clamp(dot(gl_FragCoord.xy - begin.xy, along) / square, 0.0f, 1.0f) : 0.0f;
    vec3 place = mix(begin, end, s);
    float cover = line_cover(distance(gl_FragCoord.xy, place.xy), 0.5f * width);
    vec2 across = square > 0.0f ? vec2(-along.y, along.x) / sqrt(square) : vec2(0.0f);
    if (cover <= 0.0f || !is_seen(place, across))
        discard;
    colour = channel * (cover * mix(ink.x, ink.y, s));
}
