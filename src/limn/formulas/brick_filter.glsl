// Bricks in mortar through the kernel of a pixel (the procedural structures specification, 7.1 and 7.2): which shares of it the tops and the ramps of
// bricks have on each axis, and the light that they reflect.
#pragma once
#include "limn/formulas/bricks.glsl"

// One axis of the cell under a kernel.
struct BrickAxis {
    float up;         // shares of the kernel: on the ramp up, on the top, on the ramp down
    float top;
    float down;
    float up_place;   // mean place on a ramp from its outer end, in [0,1], times the ramp's share
    float down_place;
};

// Share of a ramp that is so long, and the mean place on it from its start times that, from the blurred saws at its two ends.
FORMULA vec2 ramp_under(const vec2 at_start, const vec2 at_end, const float ramp)
{
    float share = clamp(ramp + at_end.x - at_start.x, 0.0f, 1.0f);
    float off_middle = 0.5f * (at_start.x + at_end.x + (at_end.y - at_start.y) / ramp);
    return vec2(share, clamp(0.5f * share + off_middle, 0.0f, share));
}

// From the blurred saws at the cell's start, at the top's ends, and at the cell's end. The cell takes `size` periods, its ramps `ramp`.
FORMULA BrickAxis brick_axis(const vec2 start, const vec2 high, const vec2 low, const vec2 end, const float ramp, const float size)
{
    vec2 up = ramp_under(start, high, ramp);
    vec2 down = ramp_under(low, end, ramp);
    BrickAxis axis = {up.x, clamp(size - 2.0f * ramp + low.x - high.x, 0.0f, 1.0f), down.x, up.y, down.x - down.y};
    return axis;
}

// The axes of even or of odd rows: along y, the shares hold how many there are of them.
struct BrickRows {
    vec3 up;
    vec3 top;
    vec3 down;
    vec3 up_place;
    vec3 down_place;
};

FORMULA BrickRows brick_rows(const BrickAxis x, const BrickAxis y, const BrickAxis z)
{
    BrickRows r = {vec3(x.up, y.up, z.up), vec3(x.top, y.top, z.top), vec3(x.down, y.down, z.down), vec3(x.up_place, y.up_place, z.up_place),
                   vec3(x.down_place, y.down_place, z.down_place)};
    return r;
}

// An axis in even rows, which start where x is whole, and in odd ones, which may be shifted by half a cell.
struct BrickAxes {
    BrickAxis even;
    BrickAxis odd;
};

// `odd_rows` is the share of rows that are shifted. Where all are, where none is, or where it does not show, one axis is both.
FORMULA BrickAxes shifted_axes(const float x, const float m, const float odd_rows, const Blur blur)
{
    bool halves = odd_rows > 1e-4f && odd_rows < 1.0f - 1e-4f && blur_variance(blur) < 0.8f;
    float at = !halves && odd_rows > 0.5f ? x + 0.5f : x;
    SawEnds s = blurred_saw_ends(at, m, halves, blur);
    BrickAxes axes;
    axes.even = brick_axis(s.start.here, s.after.here, s.before.here, s.start.here, m, 1.0f);
    axes.odd = axes.even;
    if (halves)
        axes.odd = brick_axis(s.start.half_on, s.after.half_on, s.before.half_on, s.start.half_on, m, 1.0f);
    return axes;
}

// Standard deviation of places that the kernel sees on a ramp, as a part of it; at most that of all its places.
FORMULA float ramp_spread(const float ramp, const Blur blur)
{
    float variance = blur_variance(blur);
    return sqrt(variance / (ramp * ramp + 12.0f * variance));
}

// The shares of a pixel's kernel on the axes of a wall.
struct BrickShares {
    BrickRows even;
    BrickRows odd;
    vec3 spread; // of places on a ramp, by the axis
    float wide;  // the kernel's standard deviation, in cells
};

FORMULA BrickShares brick_shares(const BrickPattern b, const PatternPoint p, const int kernel, const float width)
{
    vec3 m = mortar_part(b);
    vec3 at = p.position / b.cell;
    Blur along_x = blur_along(kernel, width, vec2(p.right.x, p.down.x) / b.cell.x);
    Blur pairs = blur_along(kernel, width, vec2(p.right.y, p.down.y) * (0.5f / b.cell.y)); // of rows
    SawEnds rows = blurred_saw_ends(0.5f * at.y, 0.5f * m.y, true, pairs);
    float odd_rows = 0.5f + rows.start.here.x - rows.start.half_on.x;
    BrickAxes across = shifted_axes(at.x, m.x, odd_rows, along_x);
    BrickAxis y_even = brick_axis(rows.start.here, rows.after.here, rows.before.half_on, rows.start.half_on, 0.5f * m.y, 0.5f);
    BrickAxis y_odd = brick_axis(rows.start.half_on, rows.after.half_on, rows.before.here, rows.start.here, 0.5f * m.y, 0.5f);
    BrickAxis whole = {0.0f, 1.0f, 0.0f, 0.0f, 0.0f};
    BrickAxes deep = {whole, whole};
    float variance = max(blur_variance(along_x), 4.0f * blur_variance(pairs));
    BrickShares s;
    s.spread = vec3(ramp_spread(m.x, along_x), ramp_spread(0.5f * m.y, pairs), 0.0f);
    if (b.axes == 3) {
        Blur along_z = blur_along(kernel, width, vec2(p.right.z, p.down.z) / b.cell.z);
        deep = shifted_axes(at.z, m.z, b.bond != 0 ? odd_rows : 0.0f, along_z);
        s.spread.z = ramp_spread(m.z, along_z);
        variance = max(variance, blur_variance(along_z));
    }
    s.even = brick_rows(across.even, y_even, deep.even);
    s.odd = brick_rows(across.odd, y_odd, deep.odd);
    s.wide = sqrt(variance);
    return s;
}

// Share of the kernel on the tops of bricks.
FORMULA float brick_share(const BrickShares s)
{
    return s.even.top.x * s.even.top.y * s.even.top.z + s.odd.top.x * s.odd.top.y * s.odd.top.z;
}

// Of three numbers, the products of the other two.
FORMULA vec3 others(const vec3 a)
{
    return vec3(a.y * a.z, a.x * a.z, a.x * a.y);
}

// A mean place from its sums over even and odd rows, and the ramps' shares.
FORMULA vec3 mean_place(const vec3 places, const vec3 shares)
{
    return clamp(places / max(shares, vec3(1e-7f, 1e-7f, 1e-7f)), vec3(0.0f, 0.0f, 0.0f), vec3(1.0f, 1.0f, 1.0f));
}

// Slopes of ramps at two places for all that the kernel sees of them: as far from the mean as those are spread. By the axis.
struct RampSlopes {
    vec3 low;
    vec3 high;
    vec3 height; // at the mean place
};

FORMULA RampSlopes ramp_slopes(const vec3 place, const vec3 spread, const vec3 steep)
{
    vec3 low = max(place - spread, vec3(0.0f, 0.0f, 0.0f));
    vec3 high = min(place + spread, vec3(1.0f, 1.0f, 1.0f));
    RampSlopes s = {steep * (low - low * low), steep * (high - high * high), place * place * (vec3(3.0f, 3.0f, 3.0f) - 2.0f * place)};
    return s;
}

// Matte mortar needs no more of a normal than its cosine to the light and to the sky. Here n and axis are those (x: light, y: sky) of the surface and of
// the axis along it, square is that axis's own, and slope is that of the ramp.
FORMULA vec2 slope_lit(const float slope, const vec2 n, const vec2 axis, const float square)
{
    vec2 d = (n - axis * slope) * inversesqrt(1.0f + slope * slope * square);
    return vec2(max(d.x, 0.0f), d.y);
}

// The same of a ramp that has two slopes, times its share.
FORMULA vec2 ramp_lit(const float share, const float low, const float high, const vec2 n, const vec2 axis, const float square)
{
    if (share < 1e-6f)
        return vec2(0.0f, 0.0f);
    return (slope_lit(low, n, axis, square) + slope_lit(high, n, axis, square)) * (0.5f * share);
}

// What the kernel sees of mortar.
struct MortarShares {
    vec3 up;       // shares of places on one ramp alone, by the axis
    vec3 down;
    RampSlopes rise;
    RampSlopes fall;
    float corner;  // share of places on several
    vec3 gradient; // of the height, their mean times their share
    float brick;   // what is left
};

// The gradient's sum over places of several ramps in even or in odd rows: over all places less those on one ramp, where the others' heights are 1.
FORMULA vec3 corner_gradient(const BrickRows r, const RampSlopes rise, const RampSlopes fall)
{
    vec3 slope = 0.5f * (r.up * (rise.low + rise.high) - r.down * (fall.low + fall.high));
    vec3 height = r.top + r.up * rise.height + r.down * fall.height;
    return slope * (others(height) - others(r.top));
}

// The same sum of its square.
FORMULA float corner_square(const BrickRows r, const RampSlopes rise, const RampSlopes fall)
{
    vec3 square = 0.5f * (r.up * (rise.low * rise.low + rise.high * rise.high) + r.down * (fall.low * fall.low + fall.high * fall.high));
    vec3 height = r.top + r.up * rise.height * rise.height + r.down * fall.height * fall.height;
    return dot(square, others(height) - others(r.top));
}

FORMULA MortarShares mortar_shares(const BrickPattern b, const BrickShares s)
{
    vec3 even_tops = others(s.even.top);
    vec3 odd_tops = others(s.odd.top);
    float even = s.even.up.y + s.even.top.y + s.even.down.y; // share of such rows
    vec3 even_rows = vec3(even, 1.0f, even);
    vec3 odd_rows = vec3(1.0f - even, 1.0f, 1.0f - even);
    vec3 up = mean_place(even_rows * s.even.up_place + odd_rows * s.odd.up_place, even_rows * s.even.up + odd_rows * s.odd.up);
    vec3 down = mean_place(even_rows * s.even.down_place + odd_rows * s.odd.down_place, even_rows * s.even.down + odd_rows * s.odd.down);
    vec3 steep = 6.0f * b.bump / mortar_part(b);
    MortarShares w;
    w.up = s.even.up * even_tops + s.odd.up * odd_tops;
    w.down = s.even.down * even_tops + s.odd.down * odd_tops;
    w.rise = ramp_slopes(up, s.spread, steep);
    w.fall = ramp_slopes(down, s.spread, steep);
    w.brick = brick_share(s);
    vec3 single = w.up + w.down;
    w.corner = max(1.0f - w.brick - (single.x + single.y + single.z), 0.0f);
    w.gradient = corner_gradient(s.even, w.rise, w.fall) + corner_gradient(s.odd, w.rise, w.fall);
    return w;
}

// Normal at places on several ramps.
FORMULA vec3 corner_normal(const MortarShares w, const vec3 n)
{
    return bumped(n, w.gradient / max(w.corner, 1e-4f));
}

// Light by its cosine with a normal, and by that of the sky.
FORMULA vec3 matte_light(const Illumination lit, const vec2 cosines, const float weight)
{
    return lit.light * (cosines.x / BRDF_PI) + lit.below * weight + (lit.above - lit.below) * (0.5f * weight + AMBIENT_TILT * cosines.y);
}

// Radiance of matte bricks, whose colour is `brick`, and mortar.
FORMULA vec3 matte_bricks(const BrickPattern b, const vec3 brick, const MortarShares w, const vec3 n, const Illumination lit)
{
    vec2 flat_light = vec2(dot(n, lit.to_light), dot(n, lit.up));
    vec3 light = lit.to_light - n * flat_light.x; // along the surface
    vec3 sky = lit.up - n * flat_light.y;
    vec2 x = vec2(light.x, sky.x);
    vec2 y = vec2(light.y, sky.y);
    vec2 z = vec2(light.z, sky.z);
    vec3 square = vec3(1.0f, 1.0f, 1.0f) - n * n;
    vec2 mortar = ramp_lit(w.up.x, w.rise.low.x, w.rise.high.x, flat_light, x, square.x) + ramp_lit(w.down.x, -w.fall.low.x, -w.fall.high.x, flat_light, x, square.x) +
                  ramp_lit(w.up.y, w.rise.low.y, w.rise.high.y, flat_light, y, square.y) + ramp_lit(w.down.y, -w.fall.low.y, -w.fall.high.y, flat_light, y, square.y) +
                  ramp_lit(w.up.z, w.rise.low.z, w.rise.high.z, flat_light, z, square.z) + ramp_lit(w.down.z, -w.fall.low.z, -w.fall.high.z, flat_light, z, square.z);
    if (w.corner > 1e-5f) {
        vec3 bent = corner_normal(w, n);
        mortar = mortar + vec2(facing(bent, lit.to_light), dot(bent, lit.up)) * w.corner;
    }
    return brick * matte_light(lit, vec2(max(flat_light.x, 0.0f), flat_light.y) * w.brick, w.brick) + b.mortar * matte_light(lit, mortar, 1.0f - w.brick);
}

// Radiance of mortar on one ramp, along an axis, by its two slopes. Their highlights are as wide as to make one.
FORMULA vec3 ramp_radiance(const Finish mortar, const PatternPoint p, const vec3 t, const vec3 axis, const float low, const float high, const Illumination lit)
{
    float spread = 0.1f * (high - low) * (high - low);
    return 0.5f * (reflected(mortar, bumped(p.normal, axis * low), t, p.to_eye, spread, lit) + reflected(mortar, bumped(p.normal, axis * high), t, p.to_eye, spread, lit));
}

// A unit tangent.
FORMULA vec3 any_tangent(const vec3 n)
{
    return normalize(cross(abs(n.y) < 0.9f ? vec3(0.0f, 1.0f, 0.0f) : vec3(1.0f, 0.0f, 0.0f), n));
}

// Radiance of bricks and mortar that shine: every state of the surface is lit.
FORMULA vec3 glossy_bricks(const BrickPattern b, const Finish brick, const BrickShares s, const MortarShares w, const PatternPoint p, const Illumination lit)
{
    vec3 t = any_tangent(p.normal);
    Finish mortar = brick;
    mortar.colour = b.mortar;
    vec3 mean = w.gradient / max(w.corner, 1e-4f);
    float square = (corner_square(s.even, w.rise, w.fall) + corner_square(s.odd, w.rise, w.fall)) / max(w.corner, 1e-4f);
    float spread = 0.5f * max(square - dot(mean, mean), 0.0f); // of the slopes there, along each direction
    vec3 sum = w.brick * reflected(brick, p.normal, t, p.to_eye, 0.0f, lit) + w.corner * reflected(mortar, bumped(p.normal, mean), t, p.to_eye, spread, lit);
    for (int k = 0; k < 3; ++k) {
        vec3 axis = vec3(k == 0 ? 1.0f : 0.0f, k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f);
        if (w.up[k] > 1e-5f)
            sum = sum + w.up[k] * ramp_radiance(mortar, p, t, axis, w.rise.low[k], w.rise.high[k], lit);
        if (w.down[k] > 1e-5f)
            sum = sum + w.down[k] * ramp_radiance(mortar, p, t, axis, -w.fall.low[k], -w.fall.high[k], lit);
    }
    return sum;
}

// Radiance of a pixel through a kernel so wide.
FORMULA vec3 bricks_through(const BrickPattern b, const Finish f, const PatternPoint p, const int kernel, const float width, const Illumination lit)
{
    if (kernel == KERNEL_NONE)
        return brick_at(b, f, p.position, p.normal, p.to_eye, lit);
    BrickShares s = brick_shares(b, p, kernel, width);
    Finish brick = f;
    brick.colour = brick_colour(b, brick_place(b, p.position), clamp(1.5f - 2.0f * s.wide, 0.0f, 1.0f));
    if (brick_share(s) > 0.9999f)
        return reflected(brick, p.normal, any_tangent(p.normal), p.to_eye, 0.0f, lit);
    MortarShares w = mortar_shares(b, s);
    return f.model == FINISH_MATTE ? matte_bricks(b, brick.colour, w, p.normal, lit) : glossy_bricks(b, brick, s, w, p, lit);
}
