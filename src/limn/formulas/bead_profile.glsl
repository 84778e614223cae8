// The rounded edges of a stack of layers: what of them a line of sight meets, and what they hide from each other. Edges are half ellipses; lengths across
// are in bulges and heights in half layers, so that they are half circles of radius 1. Places are out and up from the middle of an edge. All is turned over
// where the surface faces down. What is hidden lies behind the next edge above or below: those beyond stand out less.
#pragma once
#include "limn/formulas/irradiance.glsl"

// The level direction out of a surface, and how much of the normal it is.
FORMULA vec4 outward(const vec3 n, const vec3 up)
{
    vec3 level = n - up * dot(n, up);
    float size = length(level);
    if (size < 1e-4f)
        return vec4(0.0f, 0.0f, 0.0f, 0.0f);
    return vec4(level / size, size);
}

// A stack of edges as it is seen from far away.
struct BeadView {
    vec2 way;     // to there, unit
    float period; // from edge to edge, across the way
    float from;   // where across the way an edge is seen, from its middle: the first place and the last
    float to;
    float shift;  // how much further in the next edge is
    float turned; // -1 where turned over, else 1
    int only;     // 1: a floor, nothing but a tread; 0: edges too
};

FORMULA float across_way(const vec2 way, const vec2 at)
{
    return way.x * at.y - way.y * at.x;
}

// A direction as circles see it that ellipses see from `out_part` and `up_part`.
FORMULA vec2 bead_way(const float bulge, const float out_part, const float up_part)
{
    vec2 way = vec2(out_part, bulge * up_part);
    return way * inversesqrt(max(dot(way, way), 1e-12f));
}

FORMULA BeadView bead_view(const float bulge, const float n_out, const float n_up, const float eye_out, const float eye_up)
{
    float turned = n_up < 0.0f ? -1.0f : 1.0f;
    BeadView view = {vec2(1.0f, 0.0f), 2.0f, -1.0f, 1.0f, 0.0f, turned, 0};
    if (n_out < 1e-3f) {
        view.only = 1;
        return view;
    }
    view.way = bead_way(bulge, eye_out, turned * eye_up);
    view.shift = 2.0f * abs(n_up) / (n_out * bulge);
    view.period = max(2.0f * view.way.x + view.shift * view.way.y, 1e-3f);
    bool above = view.way.y >= 0.0f;
    view.from = above ? -1.0f : 1.0f - view.period;
    view.to = above ? min(view.way.x, view.period - 1.0f) : 1.0f;
    return view;
}

// The phase of a line of sight through the point at `at` layers of the surface, of which the edges touch the outermost places: from 0 where
// an edge comes in sight, over to - from (of a period), to 1.
FORMULA float bead_phase(const BeadView view, const float at)
{
    return view.turned * (at - 0.5f) - (view.way.y + view.from) / view.period;
}

// The place of an edge that is seen there across the way.
FORMULA vec2 bead_point(const BeadView view, const float across)
{
    float ahead = sqrt(max(1.0f - across * across, 0.0f));
    return vec2(view.way.x * ahead - view.way.y * across, view.way.y * ahead + view.way.x * across);
}

// And of the tread behind an edge, beyond `view.to`; for views from above.
FORMULA vec2 tread_point(const BeadView view, const float across)
{
    return vec2(min((view.way.x - across) / max(view.way.y, 1e-6f), 0.0f), 1.0f);
}

// The normal of an edge, unit, out and up.
FORMULA vec2 bead_normal(const float bulge, const vec2 at)
{
    vec2 n = vec2(at.x, bulge * at.y);
    return n * inversesqrt(max(dot(n, n), 1e-12f));
}

// Half of the width of a light, radians, as circles see it.
FORMULA float soft_on_circles(const float bulge, const float out_part, const float up_part, const float radius)
{
    float squeezed = out_part * out_part + bulge * bulge * up_part * up_part;
    return radius * bulge * sqrt(out_part * out_part + up_part * up_part) / max(squeezed, 1e-4f);
}

// The integral of a ramp from 0 at -w to 1 at w.
FORMULA float ramp_integral(const float x, const float w)
{
    float t = clamp(x, -w, w) + w;
    return max(x - w, 0.0f) + t * t / (4.0f * w);
}

// Its mean between two places.
FORMULA float ramp_mean(const float a, const float b, const float w)
{
    if (abs(b - a) < 0.05f * w)
        return clamp(0.5f + 0.25f * (a + b) / w, 0.0f, 1.0f);
    return clamp((ramp_integral(b, w) - ramp_integral(a, w)) / (b - a), 0.0f, 1.0f);
}

// How much of the light from a way passes a neighbour of the edge, on average from one place to another. `neighbour` is its middle, `soft` half of the light's width
// on circles.
FORMULA float share_past(const vec2 way, const vec2 neighbour, const vec2 first, const vec2 last, const float soft)
{
    float ahead = dot(way, neighbour - 0.5f * (first + last));
    if (ahead <= 0.0f)
        return 1.0f;
    float side = neighbour.y > 0.0f ? 1.0f : -1.0f;
    float rim = side * across_way(way, neighbour) - 1.0f;
    return ramp_mean(rim - side * across_way(way, first), rim - side * across_way(way, last), max(soft * ahead, 0.02f));
}

// The same of both neighbours.
FORMULA float groove_share(const float shift, const vec2 way, const vec2 first, const vec2 last, const float soft)
{
    return share_past(way, vec2(-shift, 2.0f), first, last, soft) * share_past(way, vec2(shift, -2.0f), first, last, soft);
}

// Sine between the normal and a line that bounds what is seen, of which the normal's own horizon hides the rest.
FORMULA float horizon_sine(const vec2 line, const vec2 n)
{
    float ahead = dot(line, n);
    float aside = across_way(n, line);
    if (ahead <= 0.0f)
        return aside < 0.0f ? -1.0f : 1.0f;
    return aside * inversesqrt(ahead * ahead + aside * aside);
}

// Between which lines one sees out of the groove from a place with a normal, towards the neighbour below and the one above: sines from the normal.
FORMULA vec2 groove_opening(const float bulge, const float shift, const vec2 at, const vec2 n)
{
    vec2 below = vec2(shift - at.x, -2.0f - at.y);
    vec2 above = vec2(-shift - at.x, 2.0f - at.y);
    // The tangents to the circles around these places.
    vec2 low = below * sqrt(max(dot(below, below) - 1.0f, 0.0f)) + vec2(-below.y, below.x);
    vec2 high = above * sqrt(max(dot(above, above) - 1.0f, 0.0f)) + vec2(above.y, -above.x);
    return vec2(horizon_sine(vec2(bulge * low.x, low.y), n), horizon_sine(vec2(bulge * high.x, high.y), n));
}
