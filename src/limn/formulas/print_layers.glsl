// Layers of a 3D print, computed from position and line of sight alone (the procedural structures specification, 2.8, 7.1, 7.2 and 7.5). Three
// models: the seed's; the staircase that the slope really has; and the staircase with rounded edges, as beads of plastic have them.
#pragma once
#include "limn/formulas/brdf.glsl"
#include "limn/formulas/pattern_point.glsl"
#include "limn/formulas/periodic_blur.glsl"

const int LAYERS_SEED = 0;  // literal: the share of treads is that of the line of sight
const int LAYERS_SOFT = 1;  // literal with the seed's smoothstep
const int LAYERS_SLOPE = 2; // flat treads and risers
const int LAYERS_BEAD = 3;  // risers bulge
const int LAYERS_VOXEL = 4; // the seed's along two axes: blocks

struct LayerPattern {
    int model;
    vec3 up;        // print direction, unit
    float soft_low; // edges of the seed's smoothstep, units of height
    float soft_high;
    float bulge;    // of beads: how far they stand out, by half their height; above 0
    float variety;  // how much layers differ in colour, in [0,1]
    vec3 across;    // of blocks: their other axis, unit, and their size along it
    float block;
};

// Where a point lies in the stack.
struct LayerPlace {
    float at;      // counts layers, from the lowest
    float height;  // of its layer
    vec2 change;   // of `at`, for a pixel to the right and down
};

// A stack: layers of heights of their own, and above them layers of one height.
struct LayerRow {
    float bottom; // of the lowest
    float height; // of all above the first `count`
    int count;
};

// The share of a layer, from below or above, that the seed shows as a tread; sight is the component of the unit line of sight along `up`.
FORMULA float seed_gap(const float at, const float height, const float sight)
{
    float next = floor(at) + step(0.0f, sight);
    return height - (next - at) * height / sight; // l - t
}

// 1 on a tread and 0 on a riser, or between the two with the smoothstep.
FORMULA float seed_tread(const LayerPattern s, const LayerPlace place, const float sight)
{
    if (abs(sight) < 1e-6f)
        return 0.0f;
    float gap = seed_gap(place.at, place.height, sight);
    return s.model == LAYERS_SOFT ? smoothstep(s.soft_low, s.soft_high, gap) : step(0.0f, gap);
}

// What replaces the component of a normal along an axis.
FORMULA float signed_tread(const float along, const float tread)
{
    return along == 0.0f ? 0.0f : (along < 0.0f ? -tread : tread);
}

// The seed's normal: its component along `up` is replaced. A riser keeps the normal where nothing else is left of it.
FORMULA vec3 seed_layer_normal(const vec3 n, const vec3 up, const float tread)
{
    float along = dot(n, up);
    vec3 bent = n + up * (signed_tread(along, tread) - along);
    float size = dot(bent, bent);
    return size < 1e-12f ? n : bent * inversesqrt(size);
}

// The same along two axes at once.
FORMULA vec3 block_normal(const vec3 n, const vec3 up, const vec3 across, const float tread, const float side_tread)
{
    float along = dot(n, up);
    float aside = dot(n, across);
    vec3 bent = n + up * (signed_tread(along, tread) - along) + across * (signed_tread(aside, side_tread) - aside);
    float size = dot(bent, bent);
    return size < 1e-12f ? n : bent * inversesqrt(size);
}

// Share of treads that one sees of a staircase on a slope; n and to_eye as the surface has them.
FORMULA float tread_share(const float n_up, const float eye_up, const float n_eye)
{
    return n_eye <= 0.0f ? 0.0f : clamp(n_up * eye_up / n_eye, 0.0f, 1.0f);
}

// 1 on a tread of the staircase, whose risers are at the middle of layers.
FORMULA float slope_tread(const float at, const float share)
{
    return abs(at - floor(at + 0.5f)) <= 0.5f * share ? 1.0f : 0.0f;
}

// The level direction out of a surface, and how much of the normal it is.
FORMULA vec4 outward(const vec3 n, const vec3 up)
{
    vec3 level = n - up * dot(n, up);
    float size = length(level);
    if (size < 1e-4f)
        return vec4(0.0f, 0.0f, 0.0f, 0.0f);
    return vec4(level / size, size);
}

// A stack of rounded edges as a line of sight meets it. Lengths across are in bulges, heights in half layers, from the middle of an edge; all
// is turned over where the surface faces down.
struct BeadView {
    float steep;    // rise of the line of sight for one across
    float far;      // sqrt(1 + steep^2): where it touches an edge
    float period;   // from edge to edge, of its height straight above an edge's middle
    float from;     // the first height at which an edge is seen, and the last
    float to;
    float turned;   // -1 where turned over, else 1
    int only;       // 1: nothing but treads is seen; 0: edges too
};

FORMULA BeadView bead_view(const float bulge, const float n_out, const float n_up, const float eye_out, const float eye_up)
{
    float turned = n_up < 0.0f ? -1.0f : 1.0f;
    BeadView view = {0.0f, 1.0f, 2.0f, -1.0f, 1.0f, turned, 0};
    float above = turned * eye_up;
    if (n_out < 1e-3f || (eye_out < 1e-4f && above > 0.0f)) {
        view.only = 1;
        return view;
    }
    float rise = clamp(above / max(eye_out, 1e-4f), -1e4f, 1e4f);
    view.steep = rise * bulge;
    view.far = sqrt(1.0f + view.steep * view.steep);
    view.period = max(2.0f + 2.0f * rise * abs(n_up) / n_out, 1e-3f);
    view.from = view.steep >= 0.0f ? -view.far : view.far - view.period;
    view.to = view.steep >= 0.0f ? min(1.0f, view.period - view.far) : view.far;
    return view;
}

// The phase of a line of sight through the point at `at` layers of the surface, of which the edges touch the outermost places: from 0 where
// an edge comes in sight, over to - from (of a period), to 1.
FORMULA float bead_phase(const BeadView view, const float at)
{
    return view.turned * (at - 0.5f) - (view.steep + view.from) / view.period;
}

// Where the line of sight of a height meets an edge: across and up.
FORMULA vec2 bead_point(const BeadView view, const float height)
{
    float across = (sqrt(max(view.far * view.far - height * height, 0.0f)) - view.steep * height) / (view.far * view.far);
    across = max(across, 0.0f);
    return vec2(across, height + view.steep * across);
}

// The height at which that is seen.
FORMULA float bead_height(const BeadView view, const vec2 at)
{
    return at.y - view.steep * at.x;
}

// The normal of an edge, out and up.
FORMULA vec2 bead_normal(const BeadView view, const float bulge, const float height)
{
    vec2 at = bead_point(view, height);
    vec2 n = vec2(at.x, bulge * at.y);
    return n * inversesqrt(max(dot(n, n), 1e-12f));
}

// How much of what is around reaches the groove between two edges: all outside, none at the bottom.
FORMULA float groove_light(const float bulge, const vec2 at)
{
    return mix(1.0f, at.x, 0.7f * min(bulge, 1.0f));
}

FORMULA Illumination in_groove(const Illumination lit, const float open)
{
    Illumination dim = lit;
    dim.above = lit.above * open;
    dim.below = lit.below * open;
    return dim;
}

// Radiance of the bead model, each part of an edge shaded once and weighted with its share of the kernel.
FORMULA vec3 bead_radiance(const LayerPattern s, const Finish f, const PatternPoint p, const LayerPlace place, const Blur blur, const Illumination lit)
{
    float n_up = dot(p.normal, s.up);
    float eye_up = dot(p.to_eye, s.up);
    vec4 level = outward(p.normal, s.up);
    vec3 out_dir = vec3(level.x, level.y, level.z);
    BeadView view = bead_view(s.bulge, level.w, n_up, dot(p.to_eye, out_dir), eye_up);
    vec3 up = s.up * view.turned;
    vec3 along = abs(dot(p.to_eye, s.up)) < 0.999f ? normalize(cross(s.up, p.to_eye)) : p.right * inversesqrt(max(dot(p.right, p.right), 1e-20f));
    if (view.only == 1)
        return reflected(f, up, along, p.to_eye, 0.0f, lit);
    vec3 tangent = cross(s.up, out_dir);
    float phase = bead_phase(view, place.at);
    // Quarters of the edge by the angle of its circle.
    vec2 first = bead_point(view, view.from);
    vec2 last = bead_point(view, view.to);
    vec2 middle = normalize(first + last + vec2(1e-6f, 0.0f));
    const float heights[5] = { view.from, bead_height(view, normalize(first + middle)), bead_height(view, middle), bead_height(view, normalize(middle + last)), view.to };
    vec2 before = blurred_saw(phase, blur);
    vec2 start = before;
    vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    for (int k = 0; k < 4; ++k) {
        float size = (heights[k + 1] - heights[k]) / view.period;
        vec2 after = blurred_saw(phase - (heights[k + 1] - view.from) / view.period, blur);
        Stretch part = stretch_under(before, after, size, blur);
        before = after;
        if (part.weight < 1e-3f)
            continue;
        float centre = 0.5f * (heights[k] + heights[k + 1]) + part.middle * view.period;
        float reach = part.spread * view.period;
        vec2 n = bead_normal(view, s.bulge, centre);
        vec2 apart = bead_normal(view, s.bulge, min(centre + reach, view.to)) - bead_normal(view, s.bulge, max(centre - reach, view.from));
        Illumination dim = in_groove(lit, groove_light(s.bulge, bead_point(view, centre)));
        sum = sum + part.weight * reflected(f, out_dir * n.x + up * n.y, tangent, p.to_eye, 0.25f * dot(apart, apart), dim);
    }
    float treads = clamp(1.0f - (view.to - view.from) / view.period, 0.0f, 1.0f);
    float share = clamp(treads + start.x - before.x, 0.0f, 1.0f);
    if (treads > 1e-4f && share > 1e-3f)
        sum = sum + share * reflected(f, up, tangent, p.to_eye, 0.0f, lit);
    return sum;
}

// Radiance of a tread or riser of the seed's and of the slope's model.
FORMULA vec3 layer_state(const LayerPattern s, const Finish f, const PatternPoint p, const float tread, const float spread, const Illumination lit)
{
    vec3 n = seed_layer_normal(p.normal, s.up, tread);
    if (s.model == LAYERS_SLOPE && tread > 0.5f)
        n = dot(p.normal, s.up) < 0.0f ? -s.up : s.up;
    vec3 t = cross(s.up, p.normal);
    float size = dot(t, t);
    if (size < 1e-10f) {
        t = cross(abs(s.up.x) < 0.9f ? vec3(1.0f, 0.0f, 0.0f) : vec3(0.0f, 1.0f, 0.0f), n);
        size = dot(t, t);
    }
    return reflected(f, n, t * inversesqrt(size), p.to_eye, spread, lit);
}

// A layer's own shade of the colour: it fades where a pixel sees several.
FORMULA Finish layer_finish(const LayerPattern s, const Finish f, const LayerPlace place, const Blur blur)
{
    Finish own = f;
    float fade = clamp(1.5f - 4.0f * sqrt(blur_variance(blur)), 0.0f, 1.0f);
    if (s.variety > 0.0f && fade > 0.0f)
        own.colour = f.colour * (1.0f + s.variety * fade * (number_of(int(floor(place.at))) - 0.5f));
    return own;
}

// Radiance of the seed's smoothstep: half the tread at a time.
FORMULA vec3 soft_radiance(const LayerPattern s, const Finish f, const PatternPoint p, const LayerPlace place, const float sight, const Blur blur, const Illumination lit)
{
    float reach = min(abs(sight), 1.0f);
    float x = sight < 0.0f ? place.at : -place.at; // from the plane that the line of sight meets, away
    vec2 before = blurred_saw(x, blur);
    vec2 start = before;
    vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    for (int k = 0; k < 2; ++k) {
        vec2 after = blurred_saw(x - 0.5f * reach * float(k + 1), blur);
        Stretch part = stretch_under(before, after, 0.5f * reach, blur);
        before = after;
        if (part.weight < 1e-4f)
            continue;
        float at = 0.5f * reach * (float(k) + 0.5f) + part.middle;
        float gap = place.height * (1.0f - at / reach);
        float spread = place.height * part.spread / reach;
        float low = smoothstep(s.soft_low, s.soft_high, gap - spread);
        float high = smoothstep(s.soft_low, s.soft_high, gap + spread);
        sum = sum + part.weight * layer_state(s, f, p, 0.5f * (low + high), 0.25f * (high - low) * (high - low), lit);
    }
    float risers = clamp(1.0f - reach + start.x - before.x, 0.0f, 1.0f);
    return risers > 1e-4f ? sum + risers * layer_state(s, f, p, 0.0f, 0.0f, lit) : sum;
}

// How much of a kernel the seed shows as treads. `eye_along` is the component of the direction to the eye along their axis.
FORMULA float seed_treads(const float at, const float eye_along, const Blur blur)
{
    float share = abs(eye_along);
    return blurred_pulse(at, eye_along > 0.0f ? 0.0f : 1.0f - share, share, blur);
}

// Radiance of blocks: treads and risers of two axes, each of the four pairs shaded once.
FORMULA vec3 block_radiance(const LayerPattern s, const Finish f, const PatternPoint p, const LayerPlace place, const int kernel, const float width, const Illumination lit)
{
    Blur across_blur = blur_along(kernel, width, change_per_pixel(p, s.across) / s.block);
    float treads = seed_treads(place.at, dot(p.to_eye, s.up), blur_along(kernel, width, place.change));
    float sides = seed_treads(dot(p.position, s.across) / s.block, dot(p.to_eye, s.across), across_blur);
    vec3 t = abs(dot(p.normal, s.up)) < 0.999f ? normalize(cross(s.up, p.normal)) : s.across;
    vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    for (int k = 0; k < 4; ++k) {
        float tread = k < 2 ? 1.0f : 0.0f;
        float side = k == 0 || k == 2 ? 1.0f : 0.0f;
        float share = (k < 2 ? treads : 1.0f - treads) * (side > 0.5f ? sides : 1.0f - sides);
        if (share > 1e-4f)
            sum = sum + share * reflected(f, block_normal(p.normal, s.up, s.across, tread, side), t, p.to_eye, 0.0f, lit);
    }
    return sum;
}

// Radiance of a pixel. With KERNEL_NONE: of the point itself.
FORMULA vec3 layers_through(const LayerPattern s, const Finish f, const PatternPoint p, const LayerPlace place, const int kernel, const float width, const Illumination lit)
{
    Blur blur = blur_along(kernel, width, place.change);
    Finish own = layer_finish(s, f, place, blur);
    if (s.model == LAYERS_BEAD)
        return bead_radiance(s, own, p, place, blur, lit);
    if (s.model == LAYERS_VOXEL)
        return block_radiance(s, own, p, place, kernel, width, lit);
    float eye_up = dot(p.to_eye, s.up);
    if (s.model == LAYERS_SOFT && blur.kernel != KERNEL_NONE && abs(eye_up) > 1e-3f)
        return soft_radiance(s, own, p, place, -eye_up, blur, lit);
    float share = abs(eye_up);
    float start = eye_up > 0.0f ? 0.0f : 1.0f - share;
    if (s.model == LAYERS_SLOPE) {
        share = tread_share(dot(p.normal, s.up), eye_up, dot(p.normal, p.to_eye));
        start = -0.5f * share;
    }
    if (blur.kernel == KERNEL_NONE) {
        float here = s.model == LAYERS_SLOPE ? slope_tread(place.at, share) : seed_tread(s, place, -eye_up);
        return layer_state(s, own, p, here, 0.0f, lit);
    }
    float treads = blurred_pulse(place.at, start, share, blur);
    vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    if (treads > 1e-4f)
        sum = treads * layer_state(s, own, p, 1.0f, 0.0f, lit);
    if (treads < 0.9999f)
        sum = sum + (1.0f - treads) * layer_state(s, own, p, 0.0f, 0.0f, lit);
    return sum;
}
