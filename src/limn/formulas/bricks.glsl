// Bricks in mortar: a solid texture in x, y, z, with bevelled edges (the procedural structures specification, 2.5 and 2.6). Rows are along x
// and follow each other in y; every other row is shifted by half a brick.
#pragma once
#include "limn/formulas/brdf.glsl"
#include "limn/formulas/pattern_point.glsl"
#include "limn/formulas/periodic_blur.glsl"
#include "limn/formulas/pulse.glsl"

struct BrickPattern {
    vec3 cell;      // width, height and length of a brick with its mortar
    float joint;    // thickness of the mortar
    int axes;       // 2: a wall in x and y; 3: solid
    vec3 bump;      // height of a brick over its mortar, by the side of a cell; (1,1,1) is the seed's, 0 is flat
    vec3 brick;     // colours, linear
    vec3 mortar;
    float variety;  // how much bricks differ, in [0,1]
    int bond;       // 1: every other row is shifted in z too, so that all sides show the bond; 0: in x alone, as the seed has it
};

// Half the mortar as a part of the cell, on each axis.
FORMULA vec3 mortar_part(const BrickPattern b)
{
    return vec3(0.5f * b.joint, 0.5f * b.joint, 0.5f * b.joint) / b.cell;
}

// The cell that a point is in, with the shift of its row.
FORMULA vec3 brick_place(const BrickPattern b, const vec3 p)
{
    vec3 at = p / b.cell;
    float shift = 0.5f * step(0.5f, fract(0.5f * at.y));
    at.x = at.x + shift;
    at.z = b.bond != 0 ? at.z + shift : at.z;
    return at;
}

// 1 in a brick and 0 in mortar.
FORMULA float brick_mask(const BrickPattern b, const vec3 p)
{
    vec3 at = fract(brick_place(b, p));
    vec3 m = mortar_part(b);
    float inside = pulse(m.x, at.x) * pulse(m.y, at.y);
    return b.axes == 3 ? inside * pulse(m.z, at.z) : inside;
}

// Height over the mortar along one axis: a ramp at both ends of the cell. x is the phase.
FORMULA float bevel(const float m, const float x)
{
    return smoothstep(0.0f, m, x) - smoothstep(1.0f - m, 1.0f, x);
}

// Its slope.
FORMULA float bevel_slope(const float m, const float x)
{
    float q = clamp(min(x, 1.0f - x) / m, 0.0f, 1.0f);
    float rise = 6.0f * q * (1.0f - q) / m;
    return x < 0.5f ? rise : -rise;
}

// The seed's: a difference over 2 delta.
FORMULA float bevel_difference(const float m, const float x, const float delta)
{
    return (bevel(m, x + delta) - bevel(m, x - delta)) / (2.0f * delta);
}

// A normal bent by the gradient of a height over the surface; what points along the normal does not bend it.
FORMULA vec3 bumped(const vec3 n, const vec3 gradient)
{
    return normalize(n - (gradient - n * dot(gradient, n)));
}

// The gradient of the height at a phase, by the slopes and heights along the axes.
FORMULA vec3 bump_gradient(const BrickPattern b, const vec3 slope, const vec3 height)
{
    vec3 product = vec3(height.y * height.z, height.x * height.z, height.x * height.y);
    return slope * product * b.bump;
}

// Height and slope along each axis at a point; axes that the wall does not have are flat.
FORMULA vec3 brick_gradient(const BrickPattern b, const vec3 p)
{
    vec3 at = fract(brick_place(b, p));
    vec3 m = mortar_part(b);
    bool solid = b.axes == 3;
    vec3 height = vec3(bevel(m.x, at.x), bevel(m.y, at.y), solid ? bevel(m.z, at.z) : 1.0f);
    vec3 slope = vec3(bevel_slope(m.x, at.x), bevel_slope(m.y, at.y), solid ? bevel_slope(m.z, at.z) : 0.0f);
    return bump_gradient(b, slope, height);
}

// One brick's colour, by its place.
FORMULA vec3 brick_colour(const BrickPattern b, const vec3 place, const float fade)
{
    int index = int(floor(place.x)) + 7919 * int(floor(place.y)) + (b.axes == 3 ? 104729 * int(floor(place.z)) : 0);
    return b.brick * (1.0f + b.variety * fade * (number_of(index) - 0.5f));
}

// Radiance of a point without any filter.
FORMULA vec3 brick_at(const BrickPattern b, const Finish f, const vec3 p, const vec3 n, const vec3 to_eye, const Illumination lit)
{
    Finish own = f;
    own.colour = brick_mask(b, p) > 0.5f ? brick_colour(b, brick_place(b, p), 1.0f) : b.mortar;
    vec3 t = abs(n.y) < 0.9f ? vec3(0.0f, 1.0f, 0.0f) : vec3(1.0f, 0.0f, 0.0f);
    vec3 bent = bumped(n, brick_gradient(b, p));
    return reflected(own, bent, normalize(cross(t, bent)), to_eye, 0.0f, lit);
}
