// Shading of one point for pictures behind line drawings. One text for C++ and GLSL.
// Directions are unit vectors that point away from the surface. Values are in [0,1]: 0 dark, 1 fully lit.
#pragma once

// The normal of the side that is seen: the back of an open surface is shaded like its front.
FORMULA vec3 seen_normal(const vec3 n, const vec3 to_eye)
{
    return dot(n, to_eye) < 0.0f ? -n : n;
}

// Lambert's law, never below 0.
FORMULA float diffuse(const vec3 n, const vec3 to_light)
{
    return max(dot(n, to_light), 0.0f);
}

// Toon shading: 0 below `limit`; from there to 1 the remaining `levels` - 1 tones in equal steps of the diffuse value.
// levels >= 2, whole; 0 < limit < 1.
FORMULA float toon_tone(const float lit, const float limit, const float levels)
{
    if (lit < limit)
        return 0.0f;
    float brighter = levels - 1.0f;
    float tone = floor((lit - limit) / (1.0f - limit) * brighter) + 1.0f;
    return min(tone, brighter) / brighter;
}

// Tone of the side of a surface that the normal points out of: Lambert's law, in even steps where `levels` is not 0.
FORMULA float side_tone(const vec3 n, const vec3 to_light, const float limit, const float levels)
{
    float lit = min(1.0f, diffuse(n, to_light));
    return levels > 0.0f ? toon_tone(lit, limit, levels) : lit;
}

// Tone of the side that is seen.
FORMULA float surface_tone(const vec3 n, const vec3 to_eye, const vec3 to_light, const float limit, const float levels)
{
    return side_tone(seen_normal(n, to_eye), to_light, limit, levels);
}

// A step between two colours that the eye sees: an edge that needs anti-aliasing.
FORMULA bool is_step(const vec3 a, const vec3 b)
{
    vec3 d = abs(a - b);
    return max(d.x, max(d.y, d.z)) > 1.0f / 48.0f;
}

// How much of the ground is there at a distance from its middle in radii of the objects: it is whole under them and fades far out, so that
// it has no edge.
FORMULA float ground_cover(const float radii)
{
    float t = clamp((4.0f - radii) / 2.5f, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}
