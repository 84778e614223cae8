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

const float AMBIENT_TILT = 0.4f; // the mean of a direction's share of the sky, of those around a normal straight up, less that around a level one

// Mean radiance of sky and floor over the hemisphere of a normal, weighted with the cosine.
FORMULA vec3 ambient_around(const Illumination lit, const vec3 n)
{
    return lit.below + (lit.above - lit.below) * (0.5f + AMBIENT_TILT * dot(n, lit.up));
}

// The integral from 0 of sqrt(1 - s^2), for s in [-1,1]: a polynomial that is 0.002 off at most.
FORMULA float half_disc(const float s)
{
    float s2 = s * s;
    return s * (0.98914392f + s2 * (-0.10669593f - 0.09704982f * s2));
}

// ambient_around, where only the directions between two planes through one line in the surface are open: a groove's. `aside` is unit, at right angles to the line and to
// n; sines of the angles from n towards it, the lower first. Open all around: -1 and 1.
FORMULA vec3 ambient_between(const Illumination lit, const vec3 n, const vec3 aside, const vec2 sines)
{
    float share = max(0.5f * (sines.y - sines.x), 0.0f);
    vec3 mean = n * (half_disc(sines.y) - half_disc(sines.x)) + aside * (0.5f * (sines.y * sines.y - sines.x * sines.x)); // of directions, times 3 pi / 4
    float above = 0.5f * share + (2.0f / 3.14159265359f) * AMBIENT_TILT * dot(mean, lit.up);
    return lit.below * (share - above) + lit.above * above;
}
