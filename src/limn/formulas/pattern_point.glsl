// The point of a surface that a pixel shows, as patterns see it, in the pattern's own frame.
#pragma once

struct PatternPoint {
    vec3 position;
    vec3 normal;   // unit, of the side that is seen; for shading
    vec3 to_eye;   // unit
    vec3 right;    // how far the surface moves for a pixel to the right
    vec3 down;     // and for one down
};

// How far one goes on a plane when the line of sight moves sideways by `side` at its depth. `sight` is the line, of any length.
FORMULA vec3 step_on_plane(const vec3 side, const vec3 sight, const vec3 plane_normal)
{
    float facing_eye = dot(sight, plane_normal);
    float least = 1e-4f * length(sight);
    if (abs(facing_eye) < least)
        facing_eye = facing_eye < 0.0f ? -least : least;
    return side - sight * (dot(side, plane_normal) / facing_eye);
}

// How much a coordinate changes for a pixel to the right and down.
FORMULA vec2 change_per_pixel(const PatternPoint p, const vec3 gradient)
{
    return vec2(dot(p.right, gradient), dot(p.down, gradient));
}

// A number in [0,1) for a whole number, the same on every machine.
FORMULA float number_of(const int index)
{
    uint h = uint(index) * 747796405u + 2891336453u;
    h = ((h >> ((h >> 28u) + 4u)) ^ h) * 277803737u;
    h = (h >> 22u) ^ h;
    return float(h >> 8u) / 16777216.0f;
}
