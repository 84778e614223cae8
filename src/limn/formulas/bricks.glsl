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
    at.x = at.x + 0.5f * step(0.5f, fract(0.5f * at.y));
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
FORMULA vec3 brick_at(const BrickPattern b, const Finish f, const vec3 p, const vec3 n, const vec3 to_eye, const Lighting lit)
{
    Finish own = f;
    own.colour = brick_mask(b, p) > 0.5f ? brick_colour(b, brick_place(b, p), 1.0f) : b.mortar;
    vec3 t = abs(n.y) < 0.9f ? vec3(0.0f, 1.0f, 0.0f) : vec3(1.0f, 0.0f, 0.0f);
    vec3 bent = bumped(n, brick_gradient(b, p));
    return reflected(own, bent, normalize(cross(t, bent)), to_eye, 0.0f, lit);
}

// One axis of the cell under a kernel: plateau and the ramp before and after it.
struct BrickAxis {
    float weight[3]; // of ramp up, plateau, ramp down
    float middle[3]; // phase of the ramp from its outer end, on average, in [0,1]
    float spread[3];
};

// Of a cell of `size` periods of x that starts where x is whole; m is the ramp as a part of the cell.
FORMULA BrickAxis brick_axis(const float x, const float m, const float size, const Blur blur)
{
    float ramp = m * size;
    const vec2 ends[4] = { blurred_saw(x, blur), blurred_saw(x - ramp, blur), blurred_saw(x - size + ramp, blur), blurred_saw(x - size, blur) };
    BrickAxis axis;
    for (int k = 0; k < 3; ++k) {
        Stretch s = stretch_under(ends[k], ends[k + 1], k == 1 ? size - 2.0f * ramp : ramp, blur);
        axis.weight[k] = s.weight;
        axis.middle[k] = clamp(0.5f + (k == 0 ? s.middle : -s.middle) / ramp, 0.0f, 1.0f);
        axis.spread[k] = s.spread / ramp;
    }
    return axis;
}

// Height at a place of a ramp.
FORMULA float ramp_height(const float q)
{
    return q * q * (3.0f - 2.0f * q);
}

// Radiance of the states that cells have, weighted with the shares of a kernel that lies along the axes.
FORMULA vec3 brick_states(const BrickPattern b, const Finish f, const PatternPoint p, const BrickAxis u, const BrickAxis v, const BrickAxis w, const vec3 colour, const Lighting lit)
{
    vec3 m = mortar_part(b);
    vec3 t = normalize(cross(abs(p.normal.y) < 0.9f ? vec3(0.0f, 1.0f, 0.0f) : vec3(1.0f, 0.0f, 0.0f), p.normal));
    Finish own = f;
    vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    for (int k = 0; k < (b.axes == 3 ? 27 : 9); ++k) {
        int i = k % 3;
        int j = (k / 3) % 3;
        int l = b.axes == 3 ? k / 9 : 1;
        float weight = u.weight[i] * v.weight[j] * (b.axes == 3 ? w.weight[l] : 1.0f);
        if (weight < 1e-4f)
            continue;
        bool flat_there = i == 1 && j == 1 && l == 1;
        own.colour = flat_there ? colour : b.mortar;
        if (flat_there || b.bump == vec3(0.0f, 0.0f, 0.0f)) {
            sum = sum + weight * reflected(own, p.normal, t, p.to_eye, 0.0f, lit);
            continue;
        }
        // Three places on a ramp as Gauss's rule has them; where ramps cross one is enough.
        bool crossing = (i == 1 ? 0 : 1) + (j == 1 ? 0 : 1) + (l == 1 ? 0 : 1) > 1;
        for (int node = crossing ? 0 : -1; node <= (crossing ? 0 : 1); ++node) {
            float off = 1.3416408f * float(node);
            float part = crossing ? 1.0f : (node == 0 ? 4.0f / 9.0f : 5.0f / 18.0f);
            vec3 q = clamp(vec3(u.middle[i] + off * u.spread[i], v.middle[j] + off * v.spread[j], w.middle[l] + off * w.spread[l]), vec3(0.0f, 0.0f, 0.0f), vec3(1.0f, 1.0f, 1.0f));
            vec3 height = vec3(i == 1 ? 1.0f : ramp_height(q.x), j == 1 ? 1.0f : ramp_height(q.y), l == 1 ? 1.0f : ramp_height(q.z));
            vec3 rise = 6.0f * q * (vec3(1.0f, 1.0f, 1.0f) - q) / m;
            vec3 slope = vec3(i == 1 ? 0.0f : (i == 0 ? rise.x : -rise.x), j == 1 ? 0.0f : (j == 0 ? rise.y : -rise.y), l == 1 ? 0.0f : (l == 0 ? rise.z : -rise.z));
            sum = sum + (weight * part) * reflected(own, bumped(p.normal, bump_gradient(b, slope, height)), t, p.to_eye, 0.0f, lit);
        }
    }
    return sum;
}

// Radiance of a pixel through a kernel so wide: every state of the surface is shaded once and weighted with its share of the kernel.
FORMULA vec3 bricks_through(const BrickPattern b, const Finish f, const PatternPoint p, const int kernel, const float width, const Lighting lit)
{
    if (kernel == KERNEL_NONE)
        return brick_at(b, f, p.position, p.normal, p.to_eye, lit);
    vec3 m = mortar_part(b);
    vec3 at = p.position / b.cell;
    Blur along_x = blur_along(kernel, width, change_per_pixel(p, vec3(1.0f / b.cell.x, 0.0f, 0.0f)));
    Blur along_y = blur_along(kernel, width, change_per_pixel(p, vec3(0.0f, 1.0f / b.cell.y, 0.0f)));
    Blur along_z = blur_along(kernel, width, change_per_pixel(p, vec3(0.0f, 0.0f, 1.0f / b.cell.z)));
    Blur rows = along_y; // counted in pairs of rows
    rows.a = 0.5f * rows.a;
    rows.b = 0.5f * rows.b;
    BrickAxis w = brick_axis(at.z, m.z, 1.0f, along_z);
    float wide = sqrt(max(blur_variance(along_x), max(blur_variance(along_y), b.axes == 3 ? blur_variance(along_z) : 0.0f)));
    vec3 colour = brick_colour(b, brick_place(b, p.position), clamp(1.5f - 4.0f * wide, 0.0f, 1.0f));
    float shifted = blurred_pulse(0.5f * at.y, 0.5f, 0.5f, rows); // share of odd rows
    vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    if (shifted < 0.9999f)
        sum = brick_states(b, f, p, brick_axis(at.x, m.x, 1.0f, along_x), brick_axis(0.5f * at.y, m.y, 0.5f, rows), w, colour, lit);
    if (shifted > 0.0001f)
        sum = sum + brick_states(b, f, p, brick_axis(at.x + 0.5f, m.x, 1.0f, along_x), brick_axis(0.5f * at.y - 0.5f, m.y, 0.5f, rows), w, colour, lit);
    return sum;
}
