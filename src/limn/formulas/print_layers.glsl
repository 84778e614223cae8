// Layers of a 3D print, computed from position and line of sight alone (the procedural structures specification, 2.8, 7.1, 7.2 and 7.5). Three
// models: the seed's; the staircase that the slope really has; and the staircase with rounded edges, as beads of plastic have them.
#pragma once
#include "limn/formulas/bead_profile.glsl"
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

// Where edges stand in space, and the light on them.
struct BeadFrame {
    vec3 out_dir; // unit, level
    vec3 up;      // unit, to where the surface faces
    vec3 along;   // unit, of the beads
    float bulge;
    float shift;  // of BeadView
    vec2 light;   // the way to the light on circles, and half of its width there
    float soft;
};

FORMULA BeadFrame bead_frame(const float bulge, const float shift, const vec3 out_dir, const vec3 up, const Illumination lit)
{
    float out_part = dot(lit.to_light, out_dir);
    float up_part = dot(lit.to_light, up);
    BeadFrame frame = { out_dir, up, cross(up, out_dir), bulge, shift, bead_way(bulge, out_part, up_part), soft_on_circles(bulge, out_part, up_part, lit.radius) };
    return frame;
}

// Sky and floor that a place in the groove sees: ambient_around of what is not hidden.
FORMULA vec3 groove_ambient(const BeadFrame frame, const Illumination lit, const vec2 at, const vec2 n)
{
    vec3 normal = frame.out_dir * n.x + frame.up * n.y;
    vec3 aside = frame.up * n.x - frame.out_dir * n.y;
    return ambient_between(lit, normal, aside, groove_opening(frame.bulge, frame.shift, at, n));
}

// Radiance from between two places that have about one normal, whose variance is `spread`, and that `share` of the light reaches. `ambient` is the light of sky and
// floor that reaches them.
FORMULA vec3 groove_reflected(const BeadFrame frame, const Finish f, const vec2 n, const float spread, const vec2 first, const vec2 last, const float share, const vec3 to_eye, const vec3 ambient, const Illumination lit)
{
    vec3 normal = frame.out_dir * n.x + frame.up * n.y;
    Illumination own = lit;
    own.light = lit.light * share;
    vec3 mirrored = normal * (2.0f * dot(normal, to_eye)) - to_eye;
    float out_part = dot(mirrored, frame.out_dir);
    float up_part = dot(mirrored, frame.up);
    float seen = groove_share(frame.shift, bead_way(frame.bulge, out_part, up_part), first, last, soft_on_circles(frame.bulge, out_part, up_part, 0.1f + 2.0f * sqrt(spread)));
    return reflected_in(f, normal, frame.along, to_eye, spread, own, ambient, seen);
}

// Radiance of a part of an edge, given by its middle and standard deviation across the line of sight.
FORMULA vec3 edge_radiance(const BeadFrame frame, const BeadView view, const Finish f, const vec3 to_eye, const float middle, const float spread, const Illumination lit)
{
    // Two points of Gauss' rule for what changes slowly, and all of the part for edges of shadows.
    vec2 low = bead_point(view, max(middle - spread, view.from));
    vec2 high = bead_point(view, min(middle + spread, view.to));
    vec2 first = bead_point(view, max(middle - 1.7320508f * spread, view.from));
    vec2 last = bead_point(view, min(middle + 1.7320508f * spread, view.to));
    vec2 n_low = bead_normal(frame.bulge, low);
    vec2 n_high = bead_normal(frame.bulge, high);
    vec2 apart = n_high - n_low;
    vec3 ambient = 0.5f * (groove_ambient(frame, lit, low, n_low) + groove_ambient(frame, lit, high, n_high));
    float share = groove_share(frame.shift, frame.light, first, last, frame.soft);
    return groove_reflected(frame, f, bead_normal(frame.bulge, bead_point(view, middle)), 0.25f * dot(apart, apart), first, last, share, to_eye, ambient, lit);
}

// Where the shadow of the edge above begins on a tread, across the line of sight, and half of the width of its border.
FORMULA vec2 shadow_on_tread(const BeadFrame frame, const BeadView view)
{
    float rise = max(frame.light.y, 1e-3f);
    vec2 neighbour = vec2(-frame.shift, 2.0f);
    // Where the light that touches the edge meets the tread.
    vec2 at = vec2((frame.light.x + 1.0f - across_way(frame.light, neighbour)) / rise, 1.0f);
    return vec2(view.way.x - at.x * view.way.y, max(frame.soft * dot(frame.light, neighbour - at), 0.02f) * view.way.y / rise);
}

// The share of the light that reaches a tread, over the part of it that is under the kernel: `front` and `back` are the blurred saws at its ends, `weight` the
// part's share of the kernel.
FORMULA float light_on_tread(const BeadFrame frame, const BeadView view, const float phase, const Blur blur, const vec2 front, const vec2 back, const float weight)
{
    vec2 shadow = shadow_on_tread(frame, view);
    float end = view.period + view.from;
    float border = max(shadow.x - shadow.y, view.to);
    float dark = min(shadow.x + shadow.y, end);
    if (border >= end)
        return 1.0f;
    if (dark <= view.to)
        return 0.0f;
    float per_period = 1.0f / view.period;
    vec2 border_saw = border > view.to ? blurred_saw(phase - (border - view.from) * per_period, blur) : front;
    vec2 dark_saw = dark < end ? blurred_saw(phase - (dark - view.from) * per_period, blur) : back;
    Stretch bright = stretch_under(front, border_saw, (border - view.to) * per_period, blur);
    Stretch dim = stretch_under(border_saw, dark_saw, (dark - border) * per_period, blur);
    float middle = 0.5f * (border + dark) + dim.middle * view.period;
    return clamp((bright.weight + dim.weight * (0.5f - 0.5f * (middle - shadow.x) / shadow.y)) / weight, 0.0f, 1.0f);
}

// Radiance of a part of a tread that so much of the light reaches: three points, as the groove's bottom is dark.
FORMULA vec3 tread_radiance(const BeadFrame frame, const BeadView view, const Finish f, const vec3 to_eye, const float middle, const float spread, const float share, const Illumination lit)
{
    float end = view.period + view.from;
    float reach = 1.3416408f * spread;
    vec2 n = vec2(0.0f, 1.0f);
    vec3 ambient = (8.0f * groove_ambient(frame, lit, tread_point(view, middle), n) + 5.0f * groove_ambient(frame, lit, tread_point(view, max(middle - reach, view.to)), n) +
                    5.0f * groove_ambient(frame, lit, tread_point(view, min(middle + reach, end)), n)) / 18.0f;
    vec2 first = tread_point(view, max(middle - 1.7320508f * spread, view.to));
    vec2 last = tread_point(view, min(middle + 1.7320508f * spread, end));
    return groove_reflected(frame, f, n, 0.0f, first, last, share, to_eye, ambient, lit);
}

// Where an edge is taken apart, across the line of sight and in their order: at quarters of the angle of its circle, or where a narrow kernel, of so many periods'
// standard deviation, sees little of it, around that.
FORMULA vec3 edge_parts(const BeadView view, const float phase, const float deviation)
{
    if (deviation > 0.12f) {
        vec2 start = bead_point(view, view.from);
        vec2 end = bead_point(view, view.to);
        vec2 middle = normalize(start + end + vec2(1e-6f, 0.0f));
        return vec3(across_way(view.way, normalize(start + middle)), across_way(view.way, middle), across_way(view.way, normalize(middle + end)));
    }
    vec3 at = vec3(phase - 2.5f * deviation, phase, phase + 2.5f * deviation);
    at = at - floor(at);
    vec3 ordered = at.x > at.y ? vec3(at.y, at.z, at.x) : (at.y > at.z ? vec3(at.z, at.x, at.y) : at); // what went around is first
    return min(view.from + view.period * ordered, vec3(view.to, view.to, view.to));
}

// Radiance of the bead model, each part of an edge shaded once and weighted with its share of the kernel.
FORMULA vec3 bead_radiance(const LayerPattern s, const Finish f, const PatternPoint p, const LayerPlace place, const Blur blur, const Illumination lit)
{
    float n_up = dot(p.normal, s.up);
    vec4 level = outward(p.normal, s.up);
    vec3 out_dir = vec3(level.x, level.y, level.z);
    BeadView view = bead_view(s.bulge, level.w, n_up, dot(p.to_eye, out_dir), dot(p.to_eye, s.up));
    vec3 up = s.up * view.turned;
    if (view.only == 1) {
        vec3 along = abs(dot(p.to_eye, s.up)) < 0.999f ? normalize(cross(s.up, p.to_eye)) : p.right * inversesqrt(max(dot(p.right, p.right), 1e-20f));
        return reflected(f, up, along, p.to_eye, 0.0f, lit);
    }
    BeadFrame frame = bead_frame(s.bulge, view.shift, out_dir, up, lit);
    float phase = bead_phase(view, place.at);
    vec3 parts = edge_parts(view, phase, sqrt(blur_variance(blur)));
    const float ends[5] = { view.from, parts.x, parts.y, parts.z, view.to };
    vec2 before = blurred_saw(phase, blur);
    vec2 start = before;
    vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    for (int k = 0; k < 4; ++k) {
        vec2 after = blurred_saw(phase - (ends[k + 1] - view.from) / view.period, blur);
        Stretch part = stretch_under(before, after, (ends[k + 1] - ends[k]) / view.period, blur);
        before = after;
        if (part.weight > 1e-3f)
            sum = sum + part.weight * edge_radiance(frame, view, f, p.to_eye, 0.5f * (ends[k] + ends[k + 1]) + part.middle * view.period, part.spread * view.period, lit);
    }
    float tread = view.period - (view.to - view.from);
    Stretch part = stretch_under(before, start, tread / view.period, blur);
    if (tread > 1e-4f * view.period && part.weight > 1e-3f) {
        float share = light_on_tread(frame, view, phase, blur, before, start, part.weight);
        sum = sum + part.weight * tread_radiance(frame, view, f, p.to_eye, view.to + 0.5f * tread + part.middle * view.period, part.spread * view.period, share, lit);
    }
    return sum;
}

// Radiance of a tread or riser of the seed's models.
FORMULA vec3 layer_state(const LayerPattern s, const Finish f, const PatternPoint p, const float tread, const float spread, const Illumination lit)
{
    vec3 n = seed_layer_normal(p.normal, s.up, tread);
    vec3 t = cross(s.up, p.normal);
    float size = dot(t, t);
    if (size < 1e-10f) {
        t = cross(abs(s.up.x) < 0.9f ? vec3(1.0f, 0.0f, 0.0f) : vec3(0.0f, 1.0f, 0.0f), n);
        size = dot(t, t);
    }
    return reflected(f, n, t * inversesqrt(size), p.to_eye, spread, lit);
}

// How much of a light gets past the corner of a step, on average between two places from which the corner lies in these directions. Turning from `low` to `high`
// one sees more; all is out and up.
FORMULA float corner_share(const vec2 way, const vec2 low, const vec2 high, const float turn, const float radius)
{
    return ramp_mean(turn * across_way(way, low), turn * across_way(way, high), max(radius, 0.02f) * 0.5f * (length(low) + length(high)));
}

// Radiance of what is seen of a tread or riser of flat steps, with what the step above or below hides from it on average. Lengths are in layers.
FORMULA vec3 step_radiance(const LayerPattern s, const Finish f, const PatternPoint p, const float tread, const Illumination lit)
{
    vec4 level = outward(p.normal, s.up);
    float n_up = dot(p.normal, s.up);
    vec3 up = n_up < 0.0f ? -s.up : s.up;
    if (level.w < 1e-3f)
        return layer_state(s, f, p, 1.0f, 0.0f, lit);
    vec3 out_dir = vec3(level.x, level.y, level.z);
    float width = abs(n_up) / level.w; // of treads
    vec2 eye = vec2(dot(p.to_eye, out_dir), dot(p.to_eye, up));
    vec2 light = vec2(dot(lit.to_light, out_dir), dot(lit.to_light, up));
    bool is_tread = tread > 0.5f;
    vec3 n = is_tread ? up : out_dir;
    vec3 mirrored = n * (2.0f * dot(n, p.to_eye)) - p.to_eye;
    vec2 reflection = vec2(dot(mirrored, out_dir), dot(mirrored, up));
    // From the innermost place that is seen to the outermost, or from the lowest to the highest: where the corner lies that hides the most.
    float first = is_tread ? clamp(-eye.x / max(eye.y, 1e-6f), 0.0f, 0.99f * width) : clamp(-width * eye.y / max(eye.x, 1e-6f), 0.0f, 0.99f);
    vec2 low = is_tread ? vec2(-first, 1.0f) : vec2(width, -first);
    vec2 high = is_tread ? vec2(-width, 1.0f) : vec2(width, -1.0f);
    float sine = (length(high) - length(low)) / max(is_tread ? width - first : 1.0f - first, 1e-4f); // its mean
    float turn = is_tread ? 1.0f : -1.0f;
    vec2 sines = is_tread ? vec2(-1.0f, min(sine, 1.0f)) : vec2(max(-sine, -1.0f), 1.0f);
    Illumination own = lit;
    own.light = lit.light * corner_share(light, low, high, turn, lit.radius);
    vec3 ambient = ambient_between(lit, n, is_tread ? -out_dir : up, sines);
    return reflected_in(f, n, cross(up, out_dir), p.to_eye, 0.0f, own, ambient, corner_share(reflection, low, high, turn, 0.1f));
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
    float treads = 0.0f;
    if (blur.kernel != KERNEL_NONE)
        treads = blurred_pulse(place.at, start, share, blur);
    else if (s.model == LAYERS_SLOPE)
        treads = slope_tread(place.at, share);
    else
        return layer_state(s, own, p, seed_tread(s, place, -eye_up), 0.0f, lit);
    vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    if (treads > 1e-4f)
        sum = treads * (s.model == LAYERS_SLOPE ? step_radiance(s, own, p, 1.0f, lit) : layer_state(s, own, p, 1.0f, 0.0f, lit));
    if (treads < 0.9999f)
        sum = sum + (1.0f - treads) * (s.model == LAYERS_SLOPE ? step_radiance(s, own, p, 0.0f, lit) : layer_state(s, own, p, 0.0f, 0.0f, lit));
    return sum;
}
