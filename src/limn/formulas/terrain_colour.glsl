// Colours of a terrain's picture, encoded (sRGB). One text for C++ and GLSL.
#pragma once

// A colour for a height from 0 (lowest) to 1, as hand-made relief maps have them: green lowlands, brown slopes, white summits.
FORMULA vec3 terrain_tint(const float height)
{
    const vec3 ramp[6] = {vec3(0.47f, 0.62f, 0.42f), vec3(0.72f, 0.77f, 0.53f), vec3(0.89f, 0.84f, 0.62f),
                          vec3(0.80f, 0.67f, 0.48f), vec3(0.70f, 0.60f, 0.53f), vec3(0.97f, 0.96f, 0.95f)};
    float place = clamp(height, 0.0f, 1.0f) * 5.0f;
    int below = min(int(place), 4);
    return mix(ramp[below], ramp[below + 1], place - float(below));
}

// What a colour is multiplied by, in the light of the sky and of the sun: flat ground stays as bright as its colour. n and to_sun are unit vectors, z up.
FORMULA float terrain_light(const vec3 n, const vec3 to_sun)
{
    float sky = 0.35f;
    float lit = max(dot(n, to_sun), 0.0f) / max(to_sun.z, 0.2f);
    return min(sky + (1.0f - sky) * lit, 1.12f);
}

// Where a mesh may break its bound: a colour, and how much of it lies over the ground's own.
FORMULA vec4 unmet_mark()
{
    return vec4(0.85f, 0.1f, 0.35f, 0.55f);
}
