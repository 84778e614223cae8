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
