// Formulas of patterns: each text is compiled by both languages, here too, and evaluated at random points by the device and by the processor.
// Results may differ by 1e-5 of the formula's largest term.

#include <array>
#include <cmath>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "gpu/gpu.h"
#include "limn/base/random.h"
#include "limn/formulas/formulas.h"
#include "limn/gpu/program.h"
#include "limn/gpu/resources.h"

namespace limn::test {
namespace {

using namespace formulas;
using glm::clamp, glm::dot, glm::max, glm::min, glm::abs, glm::fract, glm::normalize, glm::mat4, glm::floor;

constexpr std::size_t points = 20000, outputs = 6;
constexpr float tolerance = 1e-5f;

/// What a formula may read at one point; the layout is std430's.
struct Point {
    vec4 n, l, v, t; ///< unit vectors; t is at right angles to n
    vec4 x;          ///< numbers around 0
    vec4 k;          ///< numbers in [0,1]
};

std::vector<Point> random_points(std::uint64_t seed)
{
    std::vector<Point> all(points);
    for (std::size_t i = 0; i < points; ++i) {
        Random random(seed, i);
        const auto direction = [&] { return glm::normalize(vec3(dvec3(random.normal(), random.normal(), random.normal()))); };
        const auto numbers = [&] { return vec4(glm::dvec4(random.normal(), random.normal(), random.normal(), random.normal())); };
        const auto parts = [&] { return vec4(glm::dvec4(random.uniform(), random.uniform(), random.uniform(), random.uniform())); };
        const vec3 n = direction(), t = glm::normalize(glm::cross(n, direction()));
        all[i] = {vec4(n, 0), vec4(direction(), 0), vec4(direction(), 0), vec4(t, 0), numbers(), parts()};
    }
    return all;
}

struct Formula {
    const char* name;
    const char* body; ///< reads n, l, v, t, x, k; writes results r and their largest terms s
    void (*on_processor)(const vec3& n, const vec3& l, const vec3& v, const vec3& t, const vec4& x, const vec4& k, float (&r)[outputs], float (&s)[outputs]);
};

// The body as GLSL and as C++.
#define BOTH(name, ...)                                                                                                                                            \
    {name, #__VA_ARGS__,                                                                                                                                          \
     [](const vec3& n [[maybe_unused]], const vec3& l [[maybe_unused]], const vec3& v [[maybe_unused]], const vec3& t [[maybe_unused]], const vec4& x [[maybe_unused]], \
        const vec4& k [[maybe_unused]], float(&r)[outputs], float(&s [[maybe_unused]])[outputs]) { __VA_ARGS__ }}

const char* const made_of = R"(
Illumination lights(const vec3 l, const vec4 k) { Illumination lit = {l, vec3(2.0f, 1.5f, 1.0f), 0.2f * k.x, vec3(0.0f, 1.0f, 0.0f), vec3(0.4f), vec3(0.1f)}; return lit; }
Finish plastic(const int model, const vec4 k) { Finish f = {model, vec3(0.6f, 0.5f, 0.4f), 0.1f, 1.0f + 20.0f * k.y, 0.2f + 0.3f * k.z, 0.3f + 0.4f * k.w, 0.04f}; return f; }
BrickPattern wall(const int axes, const vec4 k) { BrickPattern b = {vec3(0.52f, 0.18f, 0.21f), 0.02f, axes, vec3(0.05f) * k.w, vec3(0.6f, 0.3f, 0.2f), vec3(0.7f), 0.3f, k.y > 0.5f ? 1 : 0}; return b; }
ThreadPattern cloth(const int woven, const vec4 k) { ThreadPattern c = {0.06f, 0.04f, vec3(0.3f, 0.4f, 0.6f), 0.3f, 1.0f + 20.0f * k.x, -1.0f, 1.0f, woven}; return c; }
LayerPattern stack(const int model) { LayerPattern s = {model, vec3(0.0f, 0.0f, 1.0f), 0.0f, 0.05f, 0.6f, 0.2f, vec3(1.0f, 0.0f, 0.0f), 0.3f}; return s; }
PatternPoint spot(const vec3 n, const vec3 v, const vec3 t, const vec4 x, const vec4 k)
{
    vec3 seen = dot(n, v) < 0.0f ? -n : n;
    PatternPoint p = {vec3(x.x, x.y, x.z), seen, v, t * (0.1f * k.x), cross(n, t) * (0.1f * k.y)};
    return p;
}
float edge_term(const ThreadPattern c, const vec3 n, const vec3 right, const vec3 down)
{
    vec2 r = sphere_change(n, right) / (c.hole + c.thread);
    vec2 d = sphere_change(n, down) / (c.hole + c.thread);
    return 1.0f + 1.0f / max(min(length(vec2(r.x, d.x)), length(vec2(r.y, d.y))), 1e-6f);
}
)";
Illumination lights(const vec3 l, const vec4 k) { return {l, vec3(2.0f, 1.5f, 1.0f), 0.2f * k.x, vec3(0.0f, 1.0f, 0.0f), vec3(0.4f), vec3(0.1f)}; }
Finish plastic(const int model, const vec4 k) { return {model, vec3(0.6f, 0.5f, 0.4f), 0.1f, 1.0f + 20.0f * k.y, 0.2f + 0.3f * k.z, 0.3f + 0.4f * k.w, 0.04f}; }
BrickPattern wall(const int axes, const vec4 k) { return {vec3(0.52f, 0.18f, 0.21f), 0.02f, axes, vec3(0.05f) * k.w, vec3(0.6f, 0.3f, 0.2f), vec3(0.7f), 0.3f, k.y > 0.5f ? 1 : 0}; }
ThreadPattern cloth(const int woven, const vec4 k) { return {0.06f, 0.04f, vec3(0.3f, 0.4f, 0.6f), 0.3f, 1.0f + 20.0f * k.x, -1.0f, 1.0f, woven}; }
LayerPattern stack(const int model) { return {model, vec3(0.0f, 0.0f, 1.0f), 0.0f, 0.05f, 0.6f, 0.2f, vec3(1.0f, 0.0f, 0.0f), 0.3f}; }
PatternPoint spot(const vec3& n, const vec3& v, const vec3& t, const vec4& x, const vec4& k)
{
    const vec3 seen = dot(n, v) < 0.0f ? -n : n;
    return {vec3(x.x, x.y, x.z), seen, v, t * (0.1f * k.x), glm::cross(n, t) * (0.1f * k.y)};
}
/// Largest term of a share of threads: places, in cells, by how far a pixel reaches among them.
float edge_term(const ThreadPattern& c, const vec3& n, const vec3& right, const vec3& down)
{
    const vec2 r = sphere_change(n, right) / (c.hole + c.thread), d = sphere_change(n, down) / (c.hole + c.thread);
    return 1 + 1 / max(min(glm::length(vec2(r.x, d.x)), glm::length(vec2(r.y, d.y))), 1e-6f);
}

std::vector<float> on_device(const std::string& body, const std::vector<Point>& all)
{
    const std::string text = fmt::format(R"(#include "limn/formulas/brick_filter.glsl"
#include "limn/formulas/thread.glsl"
#include "limn/formulas/print_layers.glsl"
#include "limn/formulas/supersampling.glsl"
#include "limn/formulas/lcg.glsl"
#include "limn/formulas/pattern_eye.glsl"
#include "limn/formulas/pattern_picture.glsl"
layout(local_size_x = 64) in;
struct Point {{ vec4 n; vec4 l; vec4 v; vec4 t; vec4 x; vec4 k; }};
layout(std430, binding = 0) readonly buffer Points {{ Point points[]; }};
layout(std430, binding = 1) writeonly buffer Results {{ float results[]; }};
{2}
void main()
{{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(points.length()))
        return;
    Point q = points[i];
    vec3 n = q.n.xyz; vec3 l = q.l.xyz; vec3 v = q.v.xyz; vec3 t = q.t.xyz; vec4 x = q.x; vec4 k = q.k;
    float r[{0}] = float[{0}](0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f);
    float s[{0}] = r;
    {1}
    for (uint j = 0u; j < {0}u; ++j)
        results[{0}u * i + j] = r[j];
}}
)",
                                         outputs, body, made_of);
    const gpu::Program program({{gpu::Stage::compute, "pattern.comp", text}});
    const gpu::Buffer in(all), out(all.size() * outputs * sizeof(float));
    in.bind_storage(0);
    out.bind_storage(1);
    program.use();
    glDispatchCompute(unsigned(all.size() + 63) / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    return out.read<float>(all.size() * outputs);
}

const Formula formulas_of_patterns[] = {
    BOTH("lcg_next, lcg_unit, number_of", uint a = uint(65536.0f * k.x); r[0] = float(lcg_next(a)); r[1] = lcg_unit(lcg_next(lcg_next(a))); r[2] = number_of(int(1e6f * x.x));
         s[0] = 0.0f; s[1] = 0.0f; s[2] = 0.0f;),
    BOTH("pulses and their integrals", float d = k.x; float at = 3.0f * x.x; r[0] = pulse(0.5f * d, k.y); r[1] = pulse_integral(at, d); r[2] = pulse_second_integral(at, d);
         r[3] = pulse_box_mean(x.y, d, 0.5f + k.z, 0.5f + k.w); s[1] = 4.0f + abs(at); s[2] = 4.0f + at * at; s[3] = 10.0f;),
    BOTH("blur_along, blur_variance", Blur g = blur_along(KERNEL_GAUSS, 0.5f, vec2(x.x, x.y)); Blur b = blur_along(KERNEL_BOX, 2.0f, vec2(x.x, x.y));
         Blur h = blur_along(KERNEL_BOX, 1.0f, vec2(1e-7f, 0.0f)); r[0] = g.a; r[1] = b.a; r[2] = b.b; r[3] = blur_variance(g); r[4] = blur_variance(b); r[5] = float(h.kernel);
         s[0] = 5.0f; s[1] = 10.0f; s[2] = 10.0f; s[3] = 10.0f; s[4] = 10.0f;),
    BOTH("sharp_saw, narrow_gauss_saw, saw_wave, wide_gauss_saws", vec2 a = sharp_saw(x.x); vec2 b = narrow_gauss_saw(x.x, 0.001f + 0.124f * k.x); SawPair c = wide_gauss_saws(turn_of(x.x), gauss_fade(0.125f + k.x));
         r[0] = a.x; r[1] = a.y + saw_wave(turn_of(x.y), 2.0f, k.y).y; r[2] = b.x; r[3] = b.y; r[4] = c.here.x - c.half_on.y; r[5] = c.here.y + c.half_on.x; s[2] = 1.0f + 0.01f / (0.001f + 0.124f * k.x);),
    BOTH("narrow_box_saw, saw_integral_2, wide_box_saw", float a = 0.01f + 0.5f * k.x; vec2 u = narrow_box_saw(x.x, a, a * k.y); vec2 w = wide_box_saw(x.x, 0.5f + k.x, 0.5f + 0.5f * k.y);
         vec2 thin = saw_integral_2(x.x) + wide_box_saw(x.x, 0.9995f + k.x, 0.0005f); r[0] = u.x; r[1] = u.y; r[2] = w.x; r[3] = w.y; r[4] = thin.x; r[5] = thin.y; s[0] = 1.0f + 0.01f / a;),
    BOTH("blur_of, is_wide, narrow_saw, turn_of, turn_sum, turn_difference, blurred_saw_turned", vec2 a = turn_of(x.x); vec2 b = turn_of(x.y); vec2 c = turn_sum(a, b); vec2 d = turn_difference(a, b);
         Blur g = blur_of(KERNEL_GAUSS, 0.13f + 0.5f * k.x, 0.0f); vec2 e = blurred_saw_turned(x.x, a, g); r[0] = a.x; r[1] = c.x; r[2] = c.y; r[3] = d.x; r[4] = e.x + narrow_saw(x.y, blur_of(KERNEL_BOX, 0.1f + 0.4f * k.y, 0.1f * k.y)).y; r[5] = e.y + (is_wide(blur_of(KERNEL_GAUSS, 0.25f * k.z, 0.0f)) ? 1.0f : 0.0f);),
    BOTH("blurred_saw, blurred_pulse, stretch_under", Blur g = blur_along(KERNEL_GAUSS, 1.0f, vec2(0.4f * k.x, 0.4f * k.y)); Blur b = blur_along(KERNEL_BOX, 2.0f, vec2(0.2f + k.x, 0.2f + k.y));
         Stretch m = stretch_under(blurred_saw(x.x, b), blurred_saw(x.x - 0.4f, b), 0.4f, b); r[0] = blurred_pulse(x.x, x.y, k.z, g); r[1] = blurred_pulse(x.x, x.y, k.z, b); r[2] = m.weight;
         r[3] = m.middle * m.weight; r[4] = m.spread; s[0] = 1.0f + 0.02f / (g.a + 0.001f); s[1] = 2.0f;),
    BOTH("facing, point_falloff, lit_by_point, radiance_around, ambient_around", Illumination lit = lights(l, k); Illumination lamp = lit_by_point(lit, vec3(x.x, x.y, x.z), vec3(1.0f), vec3(0.1f, 0.2f, 1.0f), n);
         r[0] = facing(n, l); r[1] = point_falloff(k.x, vec3(0.5f, 1.0f, 2.0f)); r[2] = lamp.light.x; r[3] = lamp.to_light.y; r[4] = radiance_around(lit, v).x; r[5] = ambient_around(lit, n).y;
         s[1] = 2.0f; s[2] = 10.0f;),
    BOTH("phong_lobe, blinn_phong_lobe, schlick, ggx_lobe, ggx_ambient", r[0] = phong_lobe(n, l, v, 20.0f * k.x); r[1] = blinn_phong_lobe(n, l, v, 20.0f * k.x); r[2] = schlick(0.04f, k.y);
         r[3] = ggx_lobe(n, t, l, v, 0.2f + k.x, 0.2f + k.y); r[4] = ggx_ambient(0.04f, 0.01f + 0.99f * k.z, k.w); s[0] = 50.0f; s[1] = 50.0f; s[3] = 20.0f + 40.0f * r[3];),
    BOTH("reflected, hair_diffuse, hair_specular", Illumination lit = lights(l, k); r[0] = reflected(plastic(FINISH_GGX, k), n, t, v, 0.1f * k.y, lit).x; r[1] = reflected(plastic(FINISH_PHONG, k), n, t, v, 0.0f, lit).y;
         r[2] = reflected(plastic(FINISH_BLINN_PHONG, k), n, t, v, 0.1f, lit).z; r[3] = reflected(plastic(FINISH_MATTE, k), n, t, v, 0.0f, lit).x; r[4] = hair_diffuse(n, l);
         r[5] = hair_specular(n, l, v, 1.0f + 9.0f * k.x, -1.0f); s[0] = 20.0f + 40.0f * r[0]; s[1] = 20.0f; s[2] = 20.0f; s[4] = 10.0f; s[5] = 10.0f;),
    BOTH("step_on_plane, change_per_pixel", PatternPoint p = spot(n, v, t, x, k); vec3 a = step_on_plane(l, v, n); vec2 c = change_per_pixel(p, l); float steep = 1.0f + 1.0f / max(abs(dot(v, n)), 1e-4f);
         r[0] = a.x; r[1] = a.y; r[2] = c.x; r[3] = c.y; s[0] = steep * steep; s[1] = s[0];),
    BOTH("framed, pattern_sight, place_at_depth, way_to_eye, seen_point, plane_place", mat3 turn = mat3(n, t, cross(n, t)); PatternEye e = {framed(turn, 2.0f, l, v) * 3.0f, l, 0.01f * t, 0.01f * n, vec2(50.0f, 40.0f), k.x > 0.5f ? 1 : 0};
         vec3 at = vec3(x.x, x.y, x.z); vec2 pixel = vec2(100.0f * k.y, 80.0f * k.z); vec3 to = way_to_eye(e, at); PatternPoint p = seen_point(e, at, n, to, to); vec3 moved = plane_place(e, at, to, pixel, pixel + vec2(k.x, k.y));
         r[0] = pattern_sight(e, pixel).x; r[1] = to.y; r[2] = p.right.x; r[3] = p.down.z; r[4] = abs(dot(normalize(pattern_sight(e, pixel)), to)) < 0.3f ? 0.0f : moved.y; r[5] = place_at_depth(e, pixel, 3.0f * x.w).z; s[0] = 2.0f; s[2] = 2.0f; s[3] = 2.0f; s[4] = 400.0f; s[5] = 10.0f;),
    BOTH("shown_light, cusp_height, cusp_light, is_outline", SeenPlace a = {vec3(x.x, x.y, x.z), n, 0.01f}; SeenPlace b = {vec3(x.x, x.y, x.z) + 0.1f * k.x * t, v, 0.01f}; SeenPlace gone = {l, n, 0.0f};
         r[0] = shown_light(vec3(3.0f * k.x, k.y, 0.8f)).x; r[1] = cusp_height(0.2f, x.x); r[2] = cusp_light(n, v); r[3] = is_outline(a, b) ? 1.0f : 0.0f; r[4] = is_outline(a, gone) && !is_outline(gone, gone) ? 1.0f : 0.0f;),
    BOTH("window_direction, meet_plane, meet_sphere", mat4 back = mat4(0.5f, 0.0f, 0.0f, 0.0f, 0.0f, 0.4f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, -5.0f, 0.0f, 0.0f, -1.0f, 5.0f);
         vec3 d = window_direction(back, vec3(100.0f * k.x, 100.0f * k.y, 0.5f), 2.0f + k.z, vec2(100.0f, 100.0f)); vec3 m = meet_plane(d, vec3(x.x, x.y, x.z), n); float steep = abs(dot(d, n)) + 1e-4f;
         r[0] = d.x; r[1] = d.y; r[2] = d.z; r[3] = steep < 0.05f ? 0.0f : m.x; r[4] = meet_sphere(d, d * 3.0f + 0.5f * t, 1.0f, k.w > 0.5f); s[3] = 10.0f / (steep * steep); s[4] = 10.0f;),
    BOTH("mortar_part, brick_place, brick_mask, bevels", BrickPattern b = wall(3, k); vec3 at = brick_place(b, vec3(x.x, x.y, x.z)); r[0] = mortar_part(b).y; r[1] = at.x; r[2] = brick_mask(b, vec3(x.x, x.y, x.z));
         r[3] = bevel(0.2f, k.x); r[4] = bevel_slope(0.2f, k.x); r[5] = bevel_difference(0.2f, k.y, 0.05f); s[1] = 20.0f; s[4] = 20.0f; s[5] = 40.0f;),
    BOTH("bumped, bump_gradient, brick_gradient, brick_colour", BrickPattern b = wall(2, k); vec3 g = brick_gradient(b, vec3(x.x, x.y, x.z)); vec3 h = bump_gradient(b, l, v); r[0] = bumped(n, 2.0f * l).x;
         r[1] = g.x; r[2] = g.y; r[3] = h.z; r[4] = brick_colour(b, vec3(x.x, x.y, x.z) * 10.0f, k.x).x; s[0] = 10.0f; s[1] = 40.0f; s[2] = 40.0f;),
    BOTH("blurred_saw_ends, ramp_under, brick_axis, shifted_axes, ramp_spread", Blur g = blur_along(KERNEL_GAUSS, 0.5f, vec2(k.x, k.y)); BrickAxes a = shifted_axes(x.x, 0.1f, k.z, g); SawEnds w = blurred_saw_ends(x.y, 0.05f, true, g);
         BrickAxis c = brick_axis(w.start.here, w.after.here, w.before.half_on, w.start.half_on, 0.05f, 0.5f); vec2 u = ramp_under(w.start.half_on, w.after.half_on, 0.05f); r[0] = a.even.up; r[1] = a.odd.top; r[2] = a.odd.down_place;
         r[3] = c.top + ramp_spread(0.1f, g); r[4] = u.x; r[5] = u.y; s[0] = 2.0f; s[1] = 2.0f; s[2] = 2.0f; s[3] = 2.0f; s[4] = 2.0f; s[5] = 10.0f;),
    BOTH("brick_rows, brick_shares, brick_share, mortar_shares", PatternPoint p = spot(n, v, t, x, k); BrickPattern b = wall(3, k); BrickShares a = brick_shares(b, p, KERNEL_GAUSS, 0.5f); MortarShares w = mortar_shares(b, a); BrickAxis axis = {k.x, k.y, k.z, k.w, k.x};
         BrickRows rows = brick_rows(axis, axis, axis); r[0] = a.wide; r[1] = a.even.top.z + rows.up_place.y; r[2] = brick_share(a); r[3] = w.up.x + w.down.y; r[4] = w.corner; r[5] = w.gradient.y; s[0] = 20.0f; s[1] = 4.0f; s[2] = 4.0f; s[3] = 4.0f; s[4] = 4.0f; s[5] = 40.0f;),
    BOTH("others, mean_place, ramp_slopes, slope_lit, ramp_lit, corner_gradient, corner_square", vec3 place = mean_place(vec3(k.x, k.y, k.z) * k.w, vec3(k.w, 1.0f, 0.5f)); RampSlopes a = ramp_slopes(place, 0.3f * vec3(k.y, k.z, k.x), 6.0f * l); vec3 part = 0.3f * vec3(k.w, k.x, k.y);
         BrickRows rows = {part, vec3(1.0f, 1.0f, 1.0f) - 2.0f * part, part, part * k.x, part * k.y}; r[0] = others(n).y; r[1] = place.x; r[2] = a.low.x + a.height.y; r[3] = slope_lit(a.high.x, vec2(n.x, n.y), vec2(l.x, v.x), 1.0f - n.x * n.x).x + ramp_lit(part.y, a.low.y, a.high.y, vec2(n.x, n.y), vec2(l.y, v.y), 1.0f - n.y * n.y).y;
         r[4] = corner_gradient(rows, a, a).z; r[5] = corner_square(rows, a, a); s[2] = 2.0f; s[3] = 3.0f; s[4] = 5.0f; s[5] = 5.0f;),
    BOTH("brick_at, any_tangent, corner_normal, matte_light, matte_bricks", PatternPoint p = spot(n, v, t, x, k); Illumination lit = lights(l, k); BrickPattern b = wall(3, k); MortarShares w = mortar_shares(b, brick_shares(b, p, KERNEL_GAUSS, 0.5f));
         r[0] = brick_at(b, plastic(FINISH_MATTE, k), p.position, p.normal, v, lit).x; r[1] = any_tangent(n).z; r[2] = w.corner * corner_normal(w, p.normal).x; r[3] = matte_light(lit, vec2(k.x, k.y), k.z).y; r[4] = matte_bricks(b, vec3(0.5f, 0.4f, 0.3f), w, p.normal, lit).z;
         s[0] = 40.0f; s[1] = 4.0f; s[2] = 40.0f; s[3] = 4.0f; s[4] = 40.0f;),
    BOTH("ramp_radiance, glossy_bricks, bricks_through", PatternPoint p = spot(n, v, t, x, k); Illumination lit = lights(l, k); BrickPattern b = wall(3, k); Finish f = plastic(FINISH_GGX, k); BrickShares a = brick_shares(b, p, KERNEL_GAUSS, 0.5f); MortarShares w = mortar_shares(b, a);
         r[0] = ramp_radiance(f, p, t, vec3(0.0f, 1.0f, 0.0f), x.x, x.y, lit).x; r[1] = glossy_bricks(b, f, a, w, p, lit).y; r[2] = bricks_through(b, plastic(FINISH_MATTE, k), p, KERNEL_GAUSS, 0.5f, lit).x;
         r[3] = bricks_through(wall(2, k), f, p, KERNEL_BOX, 2.0f, lit).y; s[0] = 40.0f; s[1] = 40.0f; s[2] = 40.0f; s[3] = 40.0f;),
    BOTH("sphere_place, sphere_change, tangents", vec2 at = sphere_place(n); vec2 c = sphere_change(n, l); float across = n.x * n.x + n.z * n.z; r[0] = abs(n.y) > 0.99f || abs(n.x) < 1e-3f ? 0.0f : at.x; r[1] = abs(n.y) > 0.99f ? 0.0f : at.y;
         r[2] = across < 0.01f ? 0.0f : c.x; r[3] = across < 0.01f ? 0.0f : c.y; r[4] = level_tangent(n).x; r[5] = upright_tangent(n).y; s[0] = 5.0f; s[1] = 50.0f; s[2] = 100.0f; s[3] = 20.0f;),
    BOTH("thread_part, thread_mask, thread_lit, thread_at", ThreadPattern c = cloth(1, k); Illumination lit = lights(l, k); vec2 at = sphere_place(n) / 0.1f; vec2 near = abs(fract(at) - vec2(0.5f, 0.5f)); vec2 off = abs(near - vec2(0.3f, 0.3f));
         float sure = abs(n.y) > 0.9f ? 0.0f : clamp(10.0f * min(min(off.x, off.y), min(0.5f - max(near.x, near.y), min(near.x, near.y))) - 0.05f, 0.0f, 1.0f); r[0] = thread_part(c); r[1] = float(thread_mask(c, vec2(10.0f * x.x, 10.0f * x.y)));
         r[2] = thread_lit(c, t, n, v, lit).x; r[3] = sure * thread_at(c, n, n, v, lit).y; s[2] = 40.0f; s[3] = 40.0f;),
    BOTH("thread_shares, thread_through", ThreadPattern c = cloth(k.z > 0.5f ? 1 : 0, k); PatternPoint p = spot(n, v, t, vec4(n, 0.0f), k); Illumination lit = lights(l, k); bool sure = abs(n.y) < 0.9f && k.x > 0.2f;
         vec4 a = thread_through(c, p, KERNEL_GAUSS, 0.5f, lit); vec4 b = thread_through(c, p, KERNEL_BOX, 2.0f, lit); r[0] = sure ? a.x : 0.0f; r[1] = sure ? a.w : 0.0f; r[2] = sure ? b.y : 0.0f; r[3] = sure ? b.w : 0.0f; Blur g = blur_along(KERNEL_GAUSS, 0.5f, vec2(0.02f + k.x, k.y)); vec2 odd = thread_shares(x.x, 0.3f, true, g);
         r[4] = odd.x - odd.y + thread_shares(x.y, 0.3f, false, g).x; s[4] = 5.0f; s[1] = edge_term(c, n, p.right, p.down); s[0] = 2.0f * s[1]; s[2] = s[0]; s[3] = s[1];),
    BOTH("thread_around", ThreadPattern c = cloth(1, k); vec3 centre = vec3(0.1f, 0.2f, 0.3f); PatternPoint p = spot(n, v, t, vec4(centre + n * 1.5f, 0.0f), k); bool sure = abs(n.y) < 0.9f && k.x > 0.2f && abs(dot(n, v)) > 0.01f;
         vec4 a = thread_around(c, centre, p, KERNEL_GAUSS, 0.5f, lights(l, k)); r[0] = sure ? a.x : 0.0f; r[1] = sure ? a.w : 0.0f; s[1] = edge_term(c, n, p.right / 1.5f, p.down / 1.5f); s[0] = 2.0f * s[1];),
    BOTH("signed_tread, block_normal, seed_treads, block_radiance", PatternPoint p = spot(n, v, t, x, k); LayerPlace place = {x.w, 0.2f, vec2(0.02f + k.x, k.y)}; Blur g = blur_along(KERNEL_GAUSS, 0.5f, place.change);
         bool sure = length(vec2(n.x, n.y)) > 0.2f && abs(n.y) > 0.2f; vec3 up = vec3(0.0f, 0.0f, 1.0f); vec3 across = vec3(1.0f, 0.0f, 0.0f); r[0] = signed_tread(x.x, k.x); r[1] = sure ? block_normal(n, up, across, k.x, k.y).z : 0.0f; r[2] = seed_treads(x.x, v.z, g);
         r[3] = sure ? block_radiance(stack(LAYERS_VOXEL), plastic(FINISH_BLINN_PHONG, k), p, place, KERNEL_GAUSS, 0.5f, lights(l, k)).x : 0.0f; s[1] = 10.0f; s[2] = 5.0f; s[3] = 60.0f;),
    BOTH("seed_gap, seed_tread, seed_layer_normal, tread_share, slope_tread", LayerPlace place = {x.x, 0.2f, vec2(k.x, k.y)}; float sight = x.y < 0.0f ? -0.1f - 0.9f * k.z : 0.1f + 0.9f * k.z; r[0] = seed_gap(x.x, 0.2f, sight);
         r[1] = seed_tread(stack(LAYERS_SOFT), place, sight); r[2] = seed_layer_normal(n, v, k.x).x; r[3] = tread_share(n.x, v.x, dot(n, v)); r[4] = slope_tread(x.x, k.x); s[0] = 4.0f; s[1] = 100.0f; s[2] = 10.0f;
         s[3] = 1.0f + 1.0f / max(abs(dot(n, v)), 1e-4f);),
    BOTH("outward, bead_view, bead_phase, bead_point, bead_normal, across_way, tread_point", vec4 o = outward(n, l); BeadView b = bead_view(0.6f, 0.2f + k.x, x.x, 0.2f + k.y, x.y); float place = mix(b.from, b.to, 0.1f + 0.8f * k.z);
         vec2 at = bead_point(b, place); r[0] = o.x; r[1] = bead_phase(b, x.z) * b.period; r[2] = at.x; r[3] = across_way(b.way, at); r[4] = bead_normal(0.6f, at).y; r[5] = tread_point(b, b.to + 0.1f * k.w).x * b.way.y;
         s[0] = 1.0f / max(o.w, 0.01f); s[1] = 10.0f * (1.0f + abs(x.z) * b.period); s[2] = 10.0f / sqrt(max(1.0f - place * place, 0.01f)); s[3] = s[2]; s[4] = 2.0f * s[2]; s[5] = 10.0f;),
    BOTH("bead_way, soft_on_circles, ramp_integral, ramp_mean, share_past, groove_share", vec2 way = bead_way(0.6f, n.x, n.y); float soft = soft_on_circles(0.6f, n.x, n.y, 0.05f + 0.2f * k.x); vec2 a = vec2(k.y, 1.0f - 2.0f * k.z); vec2 b = a + vec2(0.1f, 0.2f) * k.w;
         bool sure = length(vec2(n.x, n.y)) > 0.1f; r[0] = sure ? way.x : 0.0f; r[1] = sure ? soft : 0.0f; r[2] = ramp_integral(x.x, 0.1f + k.x); r[3] = ramp_mean(x.x, x.x + 0.1f + k.y, 0.1f + k.x); r[4] = sure ? share_past(way, vec2(-k.x, 2.0f), a, b, 0.1f + soft) : 0.0f;
         r[5] = sure ? groove_share(2.0f * k.x, way, a, b, 0.1f + soft) : 0.0f; s[0] = 2.0f; s[1] = 5.0f; s[2] = 5.0f; s[3] = 5.0f; s[4] = 5.0f; s[5] = 5.0f;),
    BOTH("horizon_sine, groove_opening, half_disc, ambient_between", float turn = 1.5f * (1.0f - 2.0f * k.x); vec2 at = vec2(cos(turn), sin(turn)); vec2 sines = groove_opening(0.6f, 2.0f * k.y, at, bead_normal(0.6f, at)); float ahead = abs(dot(normalize(vec2(n.x, n.y)), normalize(vec2(l.x, l.y))));
         r[0] = ahead > 0.1f ? horizon_sine(vec2(n.x, n.y), normalize(vec2(l.x, l.y))) : 0.0f; r[1] = sines.x; r[2] = sines.y; r[3] = half_disc(2.0f * k.z - 1.0f); r[4] = ambient_between(lights(l, k), n, t, vec2(-k.z, k.w)).y; s[0] = 2.0f; s[1] = 2.0f; s[2] = 2.0f;),
    BOTH("bead_frame, groove_ambient, groove_reflected", Illumination lit = lights(l, k); BeadFrame f = bead_frame(0.6f, k.y, n, t, lit); vec2 a = normalize(vec2(0.3f + k.x, 1.0f - 2.0f * k.z)); vec2 b = bead_normal(0.6f, a); vec3 ambient = groove_ambient(f, lit, a, b);
         bool sure = length(f.light) > 0.9f && length(vec2(dot(l, n), dot(l, t))) > 0.2f && length(vec2(dot(v, n), dot(v, t))) > 0.3f; r[0] = ambient.x; r[1] = sure ? f.soft : 0.0f; r[2] = sure ? f.light.y : 0.0f;
         r[3] = sure ? groove_reflected(f, plastic(FINISH_MATTE, k), b, 0.01f, a, normalize(a + vec2(0.0f, 0.1f)), k.w, v, ambient, lit).x : 0.0f; s[0] = 5.0f; s[1] = 5.0f; s[2] = 5.0f; s[3] = 5.0f;),
    BOTH("reflected_in, edge_radiance, tread_radiance", Illumination lit = lights(l, k); BeadFrame f = bead_frame(0.6f, k.y, n, t, lit); BeadView b = bead_view(0.6f, 0.2f + k.x, abs(x.x), 0.2f + k.y, 0.2f + abs(x.y)); Finish matte = plastic(FINISH_MATTE, k);
         bool sure = length(vec2(dot(l, n), dot(l, t))) > 0.2f && length(vec2(dot(v, n), dot(v, t))) > 0.3f; float tread = b.period - (b.to - b.from); r[0] = reflected_in(plastic(FINISH_GGX, k), n, t, v, 0.1f * k.y, lit, vec3(0.3f, 0.2f, 0.1f), k.z).x;
         r[1] = sure ? edge_radiance(f, b, matte, v, mix(b.from, b.to, 0.2f + 0.6f * k.z), 0.05f, lit).x : 0.0f; r[2] = sure && tread > 0.05f ? tread_radiance(f, b, matte, v, b.to + (0.2f + 0.6f * k.w) * tread, 0.1f * tread, k.y, lit).x : 0.0f;
         s[0] = 20.0f; s[1] = 5.0f; s[2] = 5.0f;),
    BOTH("edge_parts, shadow_on_tread, light_on_tread", BeadFrame f = bead_frame(0.6f, 2.0f * k.y, n, t, lights(l, k)); BeadView b = bead_view(0.6f, 0.2f + k.x, abs(x.x), 0.2f + k.y, 0.2f + abs(x.y));
         float wide = edge_parts(b, k.w, 0.2f).x; vec3 narrow = edge_parts(b, 0.5f + 0.1f * k.x, 0.02f + 0.09f * k.z); vec3 around = edge_parts(b, 0.03f, 0.02f + 0.09f * k.z);
         float tread = b.period - (b.to - b.from); bool sure = f.light.y > 0.1f && length(vec2(dot(l, n), dot(l, t))) > 0.2f && tread > 0.2f && b.way.y > 0.1f; vec2 shadow = shadow_on_tread(f, b);
         Blur g = blur_along(KERNEL_GAUSS, 0.5f, vec2(0.3f + k.x, k.y)); vec2 front = blurred_saw(k.w - (b.to - b.from) / b.period, g); vec2 back = blurred_saw(k.w, g); Stretch part = stretch_under(front, back, tread / b.period, g);
         r[0] = wide; r[1] = narrow.x + narrow.y + narrow.z; r[2] = around.x + around.y + around.z; r[3] = sure ? shadow.x : 0.0f; r[4] = sure ? shadow.y : 0.0f; r[5] = sure && part.weight > 0.05f ? light_on_tread(f, b, k.w, g, front, back, part.weight) : 0.0f;
         s[0] = 10.0f; s[1] = 10.0f * b.period; s[2] = s[1]; s[3] = 50.0f; s[4] = 50.0f; s[5] = 50.0f;),
    BOTH("bead_radiance", PatternPoint p = spot(n, v, t, x, k); Illumination lit = lights(l, k); LayerPlace place = {x.w, 0.2f, vec2(0.02f + k.x, k.y)}; Blur g = blur_along(KERNEL_GAUSS, 0.5f, place.change);
         bool sure = dot(p.normal, v) > 0.2f && length(vec2(n.x, n.y)) > 0.2f && length(vec2(v.x, v.y)) > 0.2f;
         r[0] = sure ? bead_radiance(stack(LAYERS_BEAD), plastic(FINISH_GGX, k), p, place, g, lit).x : 0.0f; s[0] = 5.0f;),
    BOTH("corner_share, step_radiance", PatternPoint p = spot(n, v, t, x, k); Illumination lit = lights(l, k); bool sure = dot(p.normal, v) > 0.2f && length(vec2(n.x, n.y)) > 0.2f && length(vec2(v.x, v.y)) > 0.2f && abs(v.z) > 0.1f;
         r[0] = corner_share(vec2(x.x, x.y), vec2(-k.x, 1.0f), vec2(-k.x - 0.1f - k.y, 1.0f), 1.0f, 0.2f * k.z); r[1] = sure ? step_radiance(stack(LAYERS_SLOPE), plastic(FINISH_GGX, k), p, 1.0f, lit).x : 0.0f;
         r[2] = sure ? step_radiance(stack(LAYERS_SLOPE), plastic(FINISH_GGX, k), p, 0.0f, lit).x : 0.0f; s[0] = 5.0f; s[1] = 5.0f; s[2] = 5.0f;),
    BOTH("layer_state, layer_finish, soft_radiance, layers_through", PatternPoint p = spot(n, v, t, x, k); Illumination lit = lights(l, k); LayerPlace place = {x.w, 0.2f, vec2(0.02f + k.x, k.y)}; Finish f = plastic(FINISH_BLINN_PHONG, k);
         Blur g = blur_along(KERNEL_GAUSS, 0.5f, place.change); bool sure = dot(p.normal, v) > 0.2f && length(vec2(n.x, n.y)) > 0.2f && abs(v.z) > 0.1f; r[0] = sure ? layer_state(stack(LAYERS_SEED), f, p, 0.5f, 0.0f, lit).x : 0.0f;
         r[1] = layer_finish(stack(LAYERS_BEAD), f, place, g).colour.x; r[2] = sure ? soft_radiance(stack(LAYERS_SOFT), f, p, place, -v.z, g, lit).x : 0.0f;
         r[3] = sure ? layers_through(stack(LAYERS_SLOPE), f, p, place, KERNEL_GAUSS, 0.5f, lit).x : 0.0f; r[4] = sure ? layers_through(stack(LAYERS_SEED), f, p, place, KERNEL_BOX, 2.0f, lit).x : 0.0f;
         s[0] = 40.0f; s[2] = 40.0f; s[3] = 40.0f; s[4] = 40.0f;),
};

class GpuPatternFormulas : public Gpu {};

TEST_F(GpuPatternFormulas, GiveTheSameOnBothSides)
{
    const std::vector<Point> all = random_points(7);
    for (const Formula& formula : formulas_of_patterns) {
        const std::vector<float> device = on_device(formula.body, all);
        float worst = 0;
        std::size_t wrong = 0, not_zero = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Point& p = all[i];
            float r[outputs] = {}, s[outputs] = {1, 1, 1, 1, 1, 1};
            formula.on_processor(vec3(p.n), vec3(p.l), vec3(p.v), vec3(p.t), p.x, p.k, r, s);
            for (std::size_t j = 0; j < outputs; ++j) {
                const float difference = std::abs(device[outputs * i + j] - r[j]);
                not_zero += r[j] != 0;
                if (!(difference <= tolerance * s[j]) && wrong++ < 3)
                    ADD_FAILURE() << formula.name << ", result " << j << " at point " << i << ": " << device[outputs * i + j] << " on the device, " << r[j]
                                  << " on the processor, largest term " << s[j];
                if (s[j] > 0)
                    worst = std::max(worst, difference / s[j]);
            }
        }
        EXPECT_EQ(wrong, 0u) << formula.name;
        EXPECT_GT(not_zero, all.size() / 4) << formula.name;
        fmt::print("[ formula  ] {}: largest difference {:.1e} of the largest term\n", formula.name, worst);
    }
}

} // namespace
} // namespace limn::test
