// Light that falls on a point (the procedural structures specification, 2.2).
#pragma once

// What arrives at a point: from one light, and from all around by a sky above and a floor below.
struct Illumination {
    vec3 to_light; // unit
    vec3 light;    // irradiance on a surface that faces it
    float radius;  // of the light as seen from here, radians
    vec3 up;
    vec3 above;    // radiance from straight up and straight down
    vec3 below;
};

// Part of the irradiance that is left on a tilted surface.
FORMULA float facing(const vec3 n, const vec3 to_light)
{
    return max(dot(n, to_light), 0.0f);
}

// Of a point light at a distance d: 1 / (a + b d + c d^2); (0, 0, 1) is the inverse square.
FORMULA float point_falloff(const float d, const vec3 abc)
{
    return 1.0f / max(abc.x + d * (abc.y + d * abc.z), 1e-12f);
}

// A point light seen from a place.
FORMULA Illumination lit_by_point(const Illumination around, const vec3 place, const vec3 intensity, const vec3 abc, const vec3 at)
{
    Illumination lit = around;
    vec3 way = place - at;
    float d = max(length(way), 1e-6f);
    lit.to_light = way / d;
    lit.light = intensity * point_falloff(d, abc);
    return lit;
}

// Radiance of sky and floor from a direction.
FORMULA vec3 radiance_around(const Illumination lit, const vec3 direction)
{
    float t = clamp(0.5f + 0.5f * dot(direction, lit.up), 0.0f, 1.0f);
    return lit.below + (lit.above - lit.below) * (t * t * (3.0f - 2.0f * t));
}

// Mean radiance of sky and floor over the hemisphere of a normal, weighted with the cosine.
FORMULA vec3 ambient_around(const Illumination lit, const vec3 n)
{
    return lit.below + (lit.above - lit.below) * (0.5f + 0.5f * dot(n, lit.up));
}
