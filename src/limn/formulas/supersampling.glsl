// Where the samples of a pixel lie on the surface: the pipeline turned round (the procedural structures specification, 2.10).
#pragma once

// The direction from the eye (at the origin) through a place of the window, as the seed computes it: window coordinates, normalised device
// coordinates, clip coordinates, eye space.
FORMULA vec3 window_direction(const mat4 inverse_projection, const vec3 window, const float clip_w, const vec2 size)
{
    vec3 device = vec3(2.0f * window.x / size.x - 1.0f, 2.0f * window.y / size.y - 1.0f, 2.0f * window.z - 1.0f);
    vec4 clip = vec4(device * clip_w, clip_w);
    vec4 eye = inverse_projection * clip;
    return normalize(vec3(eye.x, eye.y, eye.z));
}

// Where a direction from the origin meets the plane through `at`; `at` itself where it does not.
FORMULA vec3 meet_plane(const vec3 direction, const vec3 at, const vec3 normal)
{
    float slope = dot(direction, normal);
    if (abs(slope) < 1e-4f)
        return at;
    float t = dot(at, normal) / slope;
    return t <= 0.0f ? at : direction * t;
}

// Distance along a unit direction from the origin to the near or far side of a sphere; negative where it misses.
FORMULA float meet_sphere(const vec3 direction, const vec3 centre, const float radius, const bool far_side)
{
    float b = dot(centre, direction);
    vec3 off = centre - direction * b; // from the nearest point of the line: no digits cancel
    float inside = radius * radius - dot(off, off);
    if (inside < 0.0f)
        return -1.0f;
    return far_side ? b + sqrt(inside) : b - sqrt(inside);
}
