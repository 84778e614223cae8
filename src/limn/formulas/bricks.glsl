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

// One axis of the cell under a kernel: the ramp up, the plateau, and the ramp down.
struct BrickAxis {
    float weight[3];
    float middle[3]; // place on the ramp from its outer end, on average, in [0,1]
    float spread;    // of places on a ramp
};

// From the blurred saws at the cell's start, at the plateau's ends, and at the cell's end. The cell takes `size` periods; m is the ramp as a part
// of it.
FORMULA BrickAxis brick_axis(const vec2 start, const vec2 high, const vec2 low, const vec2 end, const float m, const float size, const Blur blur)
{
    float ramp = m * size;
    Stretch up = stretch_under(start, high, ramp, blur);
    Stretch flat_part = stretch_under(high, low, size - 2.0f * ramp, blur);
    Stretch down = stretch_under(low, end, ramp, blur);
    BrickAxis axis;
    axis.weight[0] = up.weight;
    axis.weight[1] = flat_part.weight;
    axis.weight[2] = down.weight;
    axis.middle[0] = clamp(0.5f + up.middle / ramp, 0.0f, 1.0f);
    axis.middle[1] = 0.5f;
    axis.middle[2] = clamp(0.5f - down.middle / ramp, 0.0f, 1.0f);
    axis.spread = max(up.spread, down.spread) / ramp;
    return axis;
}

// Of cells that start where x is whole; with the turns of x and m, which are not looked at where the kernel has no fade.
FORMULA BrickAxis brick_axis_at(const float x, const vec2 turn, const float m, const vec2 ramp_turn, const Blur blur)
{
    vec2 start = blurred_saw_turned(x, turn, blur);
    vec2 high = blurred_saw_turned(x - m, turn_difference(turn, ramp_turn), blur);
    vec2 low = blurred_saw_turned(x + m, turn_sum(turn, ramp_turn), blur);
    return brick_axis(start, high, low, start, m, 1.0f, blur);
}

// Along a side whose every other row may be shifted by half a cell.
struct BrickRows {
    BrickAxis straight;
    BrickAxis shifted;
};

// `rows` is 0 where no row is shifted.
FORMULA BrickRows brick_rows(const float x, const float m, const float rows, const Blur blur)
{
    vec2 turn = vec2(0.0f, 0.0f);
    vec2 ramp_turn = turn;
    if (blur.fade > 0.0f) {
        turn = turn_of(x);
        ramp_turn = turn_of(m);
    }
    BrickRows r;
    r.straight = brick_axis_at(x, turn, m, ramp_turn, blur);
    r.shifted = r.straight;
    if (rows > 1e-4f && blur_variance(blur) < 0.8f) // else it does not show
        r.shifted = brick_axis_at(x + 0.5f, -turn, m, ramp_turn, blur);
    return r;
}

// Height at a place of a ramp, and its slope along the cell, by the side of the cell that it is on.
FORMULA float ramp_height(const float q, const int side)
{
    return side == 1 ? 1.0f : q * q * (3.0f - 2.0f * q);
}

FORMULA float ramp_slope(const float q, const float m, const int side)
{
    float rise = 6.0f * q * (1.0f - q) / m;
    return side == 1 ? 0.0f : (side == 0 ? rise : -rise);
}

// Radiance of mortar at places q of the ramps on three axes.
FORMULA vec3 ramp_radiance(const BrickPattern b, const Finish mortar, const PatternPoint p, const vec3 t, const int i, const int j, const int l, const vec3 q, const Illumination lit)
{
    vec3 m = mortar_part(b);
    vec3 height = vec3(ramp_height(q.x, i), ramp_height(q.y, j), ramp_height(q.z, l));
    vec3 slope = vec3(ramp_slope(q.x, m.x, i), ramp_slope(q.y, m.y, j), ramp_slope(q.z, m.z, l));
    return reflected(mortar, bumped(p.normal, bump_gradient(b, slope, height)), t, p.to_eye, 0.0f, lit);
}

// The same over a kernel that sees a stretch of one ramp: places as Gauss's rule has them. Both ends of a whole ramp are alike.
FORMULA vec3 ramp_mean(const BrickPattern b, const Finish mortar, const PatternPoint p, const vec3 t, const int i, const int j, const int l, const vec3 q, const float spread, const Illumination lit)
{
    vec3 centre = ramp_radiance(b, mortar, p, t, i, j, l, q, lit);
    if (spread < 0.06f)
        return centre;
    vec3 way = 1.3416408f * spread * vec3(i == 1 ? 0.0f : 1.0f, j == 1 ? 0.0f : 1.0f, l == 1 ? 0.0f : 1.0f);
    vec3 none_of_it = vec3(0.0f, 0.0f, 0.0f);
    vec3 all_of_it = vec3(1.0f, 1.0f, 1.0f);
    vec3 outer = ramp_radiance(b, mortar, p, t, i, j, l, clamp(q - way, none_of_it, all_of_it), lit);
    vec3 inner = outer;
    if (spread < 0.28f)
        inner = ramp_radiance(b, mortar, p, t, i, j, l, clamp(q + way, none_of_it, all_of_it), lit);
    return centre * (4.0f / 9.0f) + (outer + inner) * (2.5f / 9.0f);
}

// Matte mortar needs no more of a normal than its cosine to the light and to the sky. Here n and e are those (x: light, y: sky) of the surface and of
// the axis along it, square is that axis's own, and slope is that of the ramp.
FORMULA vec2 slope_light(const float slope, const vec2 n, const vec2 e, const float square)
{
    vec2 d = (n - e * slope) * inversesqrt(1.0f + slope * slope * square);
    return vec2(max(d.x, 0.0f), d.y);
}

// The same over a stretch of a ramp whose slope is `steep` q (1 - q).
FORMULA vec2 ramp_light(const float steep, const float q, const float spread, const vec2 n, const vec2 e, const float square)
{
    vec2 centre = slope_light(steep * q * (1.0f - q), n, e, square);
    if (spread < 0.06f)
        return centre;
    float low = clamp(q - 1.3416408f * spread, 0.0f, 1.0f);
    vec2 outer = slope_light(steep * low * (1.0f - low), n, e, square);
    vec2 inner = outer;
    if (spread < 0.28f) {
        float high = clamp(q + 1.3416408f * spread, 0.0f, 1.0f);
        inner = slope_light(steep * high * (1.0f - high), n, e, square);
    }
    return centre * (4.0f / 9.0f) + (outer + inner) * (2.5f / 9.0f);
}

// The shares of a pixel's kernel on the axes of a wall. Rows that are shifted (odd) and rows that are not have shares of their own.
struct BrickShares {
    BrickRows across;
    BrickAxis even;
    BrickAxis odd;
    BrickRows deep;
    float wide; // the kernel's standard deviation, in cells
};

FORMULA BrickShares brick_shares(const BrickPattern b, const PatternPoint p, const int kernel, const float width)
{
    vec3 m = mortar_part(b);
    vec3 at = p.position / b.cell;
    Blur along_x = blur_along(kernel, width, vec2(p.right.x, p.down.x) / b.cell.x);
    Blur pairs = blur_along(kernel, width, vec2(p.right.y, p.down.y) * (0.5f / b.cell.y)); // of rows
    float y = 0.5f * at.y;
    float ramp = 0.5f * m.y;
    vec2 turn = vec2(0.0f, 0.0f);
    vec2 ramp_turn = turn;
    if (pairs.fade > 0.0f) {
        turn = turn_of(y);
        ramp_turn = turn_of(ramp);
    }
    vec2 even_start = blurred_saw_turned(y, turn, pairs);
    vec2 odd_start = blurred_saw_turned(y - 0.5f, -turn, pairs);
    vec2 after = turn_difference(turn, ramp_turn);
    vec2 before = turn_sum(turn, ramp_turn);
    BrickShares s;
    s.even = brick_axis(even_start, blurred_saw_turned(y - ramp, after, pairs), blurred_saw_turned(y - 0.5f + ramp, -before, pairs), odd_start, m.y, 0.5f, pairs);
    s.odd = brick_axis(odd_start, blurred_saw_turned(y - 0.5f - ramp, -after, pairs), blurred_saw_turned(y + ramp, before, pairs), even_start, m.y, 0.5f, pairs);
    float odd_rows = 0.5f + even_start.x - odd_start.x;
    s.across = brick_rows(at.x, m.x, odd_rows, along_x);
    s.deep = s.across; // of a wall: not looked at
    float variance = max(blur_variance(along_x), 4.0f * blur_variance(pairs));
    if (b.axes == 3) {
        Blur along_z = blur_along(kernel, width, vec2(p.right.z, p.down.z) / b.cell.z);
        s.deep = brick_rows(at.z, m.z, b.bond != 0 ? odd_rows : 0.0f, along_z);
        variance = max(variance, blur_variance(along_z));
    }
    s.wide = sqrt(variance);
    return s;
}

// Radiance of a pixel through a kernel so wide: every state of the surface is shaded and weighted with its share of the kernel.
FORMULA vec3 bricks_through(const BrickPattern b, const Finish f, const PatternPoint p, const int kernel, const float width, const Illumination lit)
{
    if (kernel == KERNEL_NONE)
        return brick_at(b, f, p.position, p.normal, p.to_eye, lit);
    vec3 m = mortar_part(b);
    BrickShares s = brick_shares(b, p, kernel, width);
    bool matte = f.model == FINISH_MATTE;
    bool even_surface = b.bump == vec3(0.0f, 0.0f, 0.0f);
    vec2 n_light = vec2(dot(p.normal, lit.to_light), dot(p.normal, lit.up));
    vec3 to_light = lit.to_light - p.normal * n_light.x; // along the surface
    vec3 to_sky = lit.up - p.normal * n_light.y;
    vec3 t = normalize(cross(abs(p.normal.y) < 0.9f ? vec3(0.0f, 1.0f, 0.0f) : vec3(1.0f, 0.0f, 0.0f), p.normal));
    Finish mortar = f;
    mortar.colour = b.mortar;
    vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    vec3 lights = vec3(0.0f, 0.0f, 0.0f); // of matte mortar: the light's cosine, the sky's, and their weight
    float bricks = 0.0f;
    // One loop over the states: nested ones take software renderers minutes to compile.
    int last = b.axes == 3 ? 27 : 18;
    for (int state = b.axes == 3 ? 0 : 9; state < last; ++state) {
        int l = state / 9;
        int j = (state - 9 * l) / 3;
        int i = state - 9 * l - 3 * j;
        float even_depth = b.axes == 3 ? s.deep.straight.weight[l] : 1.0f;
        float odd_depth = b.axes == 3 ? s.deep.shifted.weight[l] : 1.0f;
        float on_even = s.across.straight.weight[i] * s.even.weight[j] * even_depth;
        float on_odd = s.across.shifted.weight[i] * s.odd.weight[j] * odd_depth;
        float weight = on_even + on_odd;
        int ramps = (i == 1 ? 0 : 1) + (j == 1 ? 0 : 1) + (l == 1 ? 0 : 1);
        if (ramps == 0) {
            bricks = bricks + weight;
            continue;
        }
        if (weight < 2e-3f || even_surface) {
            if (matte)
                lights = lights + vec3(max(n_light.x, 0.0f), n_light.y, 1.0f) * weight;
            else if (weight > 1e-5f)
                sum = sum + weight * reflected(mortar, p.normal, t, p.to_eye, 0.0f, lit);
            continue;
        }
        float part = on_even / weight;
        vec3 q = vec3(mix(s.across.shifted.middle[i], s.across.straight.middle[i], part), mix(s.odd.middle[j], s.even.middle[j], part),
                      mix(s.deep.shifted.middle[l], s.deep.straight.middle[l], part));
        float spread = i != 1 ? s.across.straight.spread : (j != 1 ? s.even.spread : s.deep.straight.spread);
        if (!matte) {
            sum = sum + weight * (ramps > 1 ? ramp_radiance(b, mortar, p, t, i, j, l, q, lit) : ramp_mean(b, mortar, p, t, i, j, l, q, spread, lit));
        } else if (ramps == 1) {
            int axis = i != 1 ? 0 : (j != 1 ? 1 : 2);
            int side = axis == 0 ? i : (axis == 1 ? j : l);
            float steep = (side == 0 ? 6.0f : -6.0f) * b.bump[axis] / m[axis];
            vec2 light = ramp_light(steep, q[axis], spread, n_light, vec2(to_light[axis], to_sky[axis]), 1.0f - p.normal[axis] * p.normal[axis]);
            lights = lights + vec3(light.x, light.y, 1.0f) * weight;
        } else {
            vec3 height = vec3(ramp_height(q.x, i), ramp_height(q.y, j), ramp_height(q.z, l));
            vec3 slope = vec3(ramp_slope(q.x, m.x, i), ramp_slope(q.y, m.y, j), ramp_slope(q.z, m.z, l));
            vec3 n = bumped(p.normal, bump_gradient(b, slope, height));
            lights = lights + vec3(facing(n, lit.to_light), dot(n, lit.up), 1.0f) * weight;
        }
    }
    if (matte)
        sum = sum + b.mortar * (lit.light * (lights.x / BRDF_PI) + lit.below * lights.z + (lit.above - lit.below) * (0.5f * lights.z + AMBIENT_TILT * lights.y));
    Finish brick = f;
    brick.colour = brick_colour(b, brick_place(b, p.position), clamp(1.5f - 2.0f * s.wide, 0.0f, 1.0f));
    if (bricks > 1e-4f)
        sum = sum + bricks * reflected(brick, p.normal, t, p.to_eye, 0.0f, lit);
    return sum;
}
