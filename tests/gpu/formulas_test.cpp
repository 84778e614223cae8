// One formula, one text: each is evaluated at random points by the device and by the processor. Results may differ by 1e-5 of the
// formula's largest term, since a sum that cancels keeps the rounding of what it adds up.

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "gpu/gpu.h"
#include "limn/base/random.h"
#include "limn/formulas/formulas.h"
#include "limn/gpu/program.h"
#include "limn/gpu/resources.h"
#include "support/support.h"

namespace limn::test {
namespace {

using namespace formulas;

constexpr std::size_t points = 100000, outputs = 6;
constexpr float tolerance = 1e-5f;

/// What a formula may read at one point; the layout is std430's.
struct Point {
    vec4 v, n, e1, e2; ///< view vector of any length; an orthonormal frame
    vec4 derivative;
    vec4 k;            ///< k1, k2, and two numbers in [0,1]
};

/// A result and the size of its largest term.
struct Value {
    float result = 0, term = 1;
};
using Values = std::array<Value, outputs>;

std::vector<Point> random_points(std::uint64_t seed)
{
    std::vector<Point> all(points);
    for (std::size_t i = 0; i < points; ++i) {
        Random random(seed, i);
        const auto direction = [&] { return glm::normalize(vec3(dvec3(random.normal(), random.normal(), random.normal()))); };
        const auto number = [&](double size) { return float(size * random.normal()); };
        const vec3 n = direction(), e1 = glm::normalize(glm::cross(n, direction())), e2 = glm::cross(n, e1);
        const vec3 v = float(random.uniform(0.5, 5)) * direction();
        const float size = float(std::exp(random.uniform(-4, 4)));
        all[i] = {vec4(v, 0), vec4(n, 0), vec4(e1, 0), vec4(e2, 0), vec4(number(1), number(1), number(1), number(1)) * size * size,
                  vec4(number(1) * size, number(1) * size, float(random.uniform(0, 1)), float(random.uniform(0, 1)))};
    }
    return all;
}

/// Runs `body` for each point; it reads p (a Point) and writes r[0] ... r[5].
std::vector<float> on_device(const std::string& body, const std::vector<Point>& all)
{
    const std::string text = fmt::format(R"(#include "limn/formulas/radial_curvature.glsl"
#include "limn/formulas/apparent_ridge.glsl"
#include "limn/formulas/normal_map.glsl"
#include "limn/formulas/shading.glsl"
#include "limn/formulas/shader_lines.glsl"
#include "limn/formulas/sobel.glsl"
#include "limn/formulas/texture_lines.glsl"
#include "limn/formulas/crease_outline.glsl"
#include "limn/formulas/direction_grid.glsl"
#include "limn/formulas/map_rank.glsl"
#include "limn/formulas/hermite_edge.glsl"
#include "limn/formulas/suggestive_line.glsl"
#include "limn/formulas/terrain_bound.glsl"
#include "limn/formulas/terrain_error.glsl"
layout(local_size_x = 64) in;
struct Point {{ vec4 v; vec4 n; vec4 e1; vec4 e2; vec4 derivative; vec4 k; }};
layout(std430, binding = 0) readonly buffer Points {{ Point points[]; }};
layout(std430, binding = 1) writeonly buffer Results {{ float results[]; }};
void main()
{{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(points.length()))
        return;
    Point p = points[i];
    vec3 v = p.v.xyz; vec3 n = p.n.xyz;
    RadialTerms t = radial_terms(v, n, p.e1.xyz, p.e2.xyz, p.k.x, p.k.y);
    float r[{0}] = float[{0}](0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f);
    {1}
    for (uint k = 0u; k < {0}u; ++k)
        results[{0}u * i + k] = r[k];
}}
)",
                                         outputs, body);
    const gpu::Program program({{gpu::Stage::compute, "formula.comp", text}});
    const gpu::Buffer in(all), out(all.size() * outputs * sizeof(float));
    in.bind_storage(0);
    out.bind_storage(1);
    program.use();
    glDispatchCompute(unsigned(all.size() + 63) / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    return out.read<float>(all.size() * outputs);
}

struct Formula {
    const char* name;
    const char* body; ///< GLSL
    std::function<Values(const Point&, const RadialTerms&)> on_processor;
};

float sum(std::initializer_list<float> terms)
{
    float all = 0;
    for (const float term : terms)
        all += std::abs(term);
    return all;
}

/// The sizes of the terms of the derivatives of the radial curvature.
float slope_terms(const Point& p, const RadialTerms& t, float per_distance)
{
    const vec4& d = p.derivative;
    const float k = sum({p.k.x, p.k.y}), cot = std::abs(t.nv) / std::sqrt(t.w2);
    return 3 * sum({d.x, d.y, d.z, d.w}) + 2 * k * k * cot + 2 * k * per_distance;
}

RadialTerms terms_of(const Point& p) { return radial_terms(vec3(p.v), vec3(p.n), vec3(p.e1), vec3(p.e2), p.k.x, p.k.y); }

Values view_in_frame(const Point& p, const RadialTerms& t)
{
    const float length = std::sqrt(t.vv), curvature = sum({p.k.x * t.a * t.a, p.k.y * t.b * t.b});
    return {{{t.nv, length}, {t.a, length}, {t.b, length}, {t.w2, t.w2}, {t.vv, t.vv}, {t.f, curvature}}};
}

Values radial(const Point& p, const RadialTerms& t)
{
    const float per = 1 / std::sqrt(t.w2);
    return {{{radial_curvature(t, p.k.x, p.k.y), sum({p.k.x, p.k.y})},
             {radial_curvature_derivative(t, p.k.x, p.k.y, p.derivative), slope_terms(p, t, 0)},
             {radial_curvature_derivative_across(t, p.k.x, p.k.y, p.derivative, per), slope_terms(p, t, per)},
             {is_head_on(t) ? 1.0f : 0.0f, 0}}};
}

Values strength(const Point& p, const RadialTerms& t)
{
    const float d = radial_curvature_derivative(t, p.k.x, p.k.y, p.derivative), size = p.k.z;
    const float g = suggestive_strength(t, d, size, 0.02f);
    return {{{g, 0.02f + size * size * slope_terms(p, t, 0)}, {faded_ink(p.k.z, 0.5f), 1}, {faded_ink(p.k.z, 0.0f), 0}}};
}

Values speeds(const Point& p, const RadialTerms& t)
{
    const float along = p.derivative.x, across = p.derivative.y;
    float turn = 0, gradient = 0;
    suggestive_speed_parts(t, p.k.x, p.k.y, along, across, turn, gradient);
    const float k = sum({p.k.x, p.k.y}), speed = suggestive_speed(t, p.k.x, p.k.y, along, across), contour = contour_speed(t, p.k.x, p.k.y);
    // A speed is large where what it divides by cancels.
    const float bend = 1 / (contour * std::sqrt(t.w2));
    return {{{turn, 2 * k}, {gradient, gradient}, {speed, speed + 2 * k / gradient}, {contour, contour * (1 + 2 * k / bend)}}};
}

Values apparent(const Point& p, const RadialTerms& t)
{
    const float length = std::sqrt(t.vv), cosine = 0.1f + 0.9f * std::min(std::abs(t.nv) / length, 1.0f);
    const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine)), w_length = std::sqrt(t.w2);
    const vec2 w = vec2(t.a, t.b) * (sine / w_length);
    const ApparentRidge r = apparent_ridge(cosine, w, p.k.x, p.k.y, p.derivative, 0.25f);
    // The direction of the larger of two singular values is as uncertain as they are close.
    const float x = 1 / (cosine * (1 + cosine)), k = sum({p.k.x, p.k.y}), other = std::abs(p.k.x * p.k.y) / (cosine * r.q);
    const float apart = std::max(1e-6f, (r.q - other) / r.q), uncertain = 1 / (apart * apart);
    return {{{r.q, k * x * x}, {std::abs(r.along), uncertain}, {std::abs(r.across), uncertain},
             {std::abs(r.slope), uncertain * 8 * x * x * x * (sum({p.derivative.x, p.derivative.y, p.derivative.z, p.derivative.w}) + k * k + k)}}};
}

Values shading(const Point& p, const RadialTerms&)
{
    const vec3 n = vec3(p.n), v = glm::normalize(vec3(p.v)), seen = seen_normal(n, v);
    return {{{seen.x, 1}, {seen.y, 1}, {seen.z, 1}, {diffuse(seen, vec3(p.e1)), 1}}};
}

Values toon(const Point& p, const RadialTerms&)
{
    // Away from the steps, where the last bit decides.
    const float lit = (std::floor(p.k.z * 20) + 0.5f) / 20;
    return {{{toon_tone(lit, 0.3f, 2.0f), 1}, {toon_tone(lit, 0.31f, 5.0f), 1}}};
}

Values neighbourhood(const Point& p, const RadialTerms&)
{
    const float z[9] = {p.v.x, p.v.y, p.v.z, p.n.x, p.n.y, p.n.z, p.e1.x, p.e1.y, p.e1.z};
    const vec2 g = sobel(z);
    return {{{g.x, 40}, {g.y, 40}, {sobel_strength(z), 40}, {stands_out(z), 10}}};
}

Values inks(const Point& p, const RadialTerms&)
{
    const float nv = p.k.w, per_unit = 100, contour = contour_distance(nv, p.k.x, per_unit);
    const float suggestive = suggestive_distance(p.k.z, p.k.x, p.derivative.x, per_unit);
    // Covers take distances to the pixel, whose rounding is that of the distance.
    return {{{contour, contour}, {suggestive, suggestive}, {line_cover(p.k.z * 4, 2.0f), 4},
             {shader_ink(nv, p.k.x, p.derivative.x, per_unit, 2.0f, 2.0f, -1.0f), 4}}};
}

Values pictures(const Point& p, const RadialTerms&)
{
    const vec3 n = vec3(p.n), v = glm::normalize(vec3(p.v)), step = vec3(p.k.z, p.k.w, 0.5f) / 48.0f;
    return {{{surface_tone(n, v, vec3(p.e1), 0.3f, 0.0f), 1}, {is_step(vec3(p.e1), vec3(p.e1) + 1.5f * step) ? 1.0f : 0.0f, 0}, {ground_cover(5 * p.k.z), 1}}};
}

Values maps(const Point& p, const RadialTerms&)
{
    const vec3 n = vec3(p.n), aside = 0.5f * vec3(p.e1), above = 0.5f * vec3(p.e2);
    const vec2 place = map_place(vec2(p.k.z, p.k.w), 64.0f);
    const vec3 mixed = map_normal(normal_colour(n), normal_colour(n + aside), normal_colour(n - above), normal_colour(n + aside + above), vec2(p.k.z, p.k.w));
    return {{{mixed.x, 1}, {mixed.y, 1}, {mixed.z, 1}, {place.x, 64}, {place.y, 64}, {side_tone(n, glm::normalize(vec3(p.v)), 0.3f, 0.0f), 1}}};
}

Values places(const Point& p, const RadialTerms&)
{
    const float size = 0.05f, strength = p.derivative.x;
    const vec2 place = suggestive_place(p.k.x, strength, size, 0.02f), contour = contour_place(p.k.w);
    const float level = texture_level(vec2(p.derivative.x, p.derivative.y), vec2(p.derivative.z, p.derivative.w), 128.0f);
    return {{{place.x, 1 + TEXTURE_SCALE * size * std::abs(p.k.x)}, {place.y, 1 + size * size * std::abs(strength)}, {contour.x, 1}, {contour.y, 1}, {level, 10}}};
}

/// Numbers of either sign that a face or an edge may have, not so near zero that a quotient of them loses its digits.
float away_from_zero(float x) { return x < 0 ? x - 0.1f : x + 0.1f; }

Values zeros_on_edges(const Point& p, const RadialTerms&)
{
    const float f = 0.1f + p.k.z, g = -0.1f - p.k.w;
    const EdgeZero zero = edge_zero(7u, 3u, f, g);
    const vec3 mixed = at_zero(zero, vec3(p.v), vec3(p.n));
    const vec2 part = positive_part(p.k.z - 0.5f, p.k.w - 0.5f);
    const float apart = std::abs(p.k.z - p.k.w) + 1e-6f; // what the parameter is divided by
    return {{{float(zero.from), 0}, {zero.t, 1}, {mixed.x, 6}, {at_zero(zero, p.v.y, p.n.y), 6}, {part.x, 1 / apart}, {part.y, 1 / apart}}};
}

Values zeros_in_faces(const Point& p, const RadialTerms&)
{
    const float values[3] = {away_from_zero(p.n.x), away_from_zero(p.n.y), away_from_zero(p.e1.x)};
    const bool negative[3] = {values[0] < 0, values[1] < 0, values[2] < 0};
    const CrossedEdges edges = crossed_edges(negative[0], negative[1], negative[2]);
    const uint vertices[3] = {5, 2, 9};
    const vec3 positions[3] = {vec3(p.v), vec3(p.e1), vec3(p.e2)};
    const bool crossed = negative[0] != negative[1] || negative[1] != negative[2];
    const vec3 place = crossed ? zero_on_edge(vertices, positions, values, edges.enter) : vec3(0);
    return {{{float(odd_corner(negative[0], negative[1], negative[2])), 0}, {float(edges.enter), 0}, {float(edges.leave), 0}, {place.x, 6}, {place.y, 6}, {place.z, 6}}};
}

Values crease_parts(const Point& p, const RadialTerms&)
{
    Values all;
    for (int k = 0; k < 3; ++k) {
        const CreasePart part = crease_part(k, p.n.x, p.n.y, p.n.z, p.e1.x, p.k.z, p.k.w);
        all[std::size_t(2 * k)] = {part.drawn ? 1.0f : 0.0f, 0};
        all[std::size_t(2 * k + 1)] = {float(part.from * 4 + part.to) + (part.own_back ? 16.0f : 0.0f), 0};
    }
    return all;
}

Values suggestive_ends(const Point& p, const RadialTerms& t)
{
    const SuggestiveLimits limits = {0.3f, 0.01f, 2, 1.5f, -1};
    const SuggestiveCorner corner = suggestive_corner(t, 3u, p.k.x, p.k.y, p.derivative, limits, false);
    const SuggestiveCorner i = {3u, 0.1f + p.k.z, p.n.x, p.n.y, p.n.z}, j = {8u, -0.1f - p.k.w, p.e1.x, p.e1.y, p.e1.z};
    const SuggestiveEnd end = suggestive_end(i, j, vec3(p.v), vec3(p.e2));
    const float slopes = slope_terms(p, t, 1 / std::sqrt(t.w2));
    return {{{corner.kr, sum({p.k.x, p.k.y})}, {corner.strength, 0.01f + 0.09f * slopes}, {corner.gradient, std::sqrt(t.w2) * 2 * slopes},
             {end.strength, 2}, {end.position.x, 6}, {end.turn + end.gradient, 4}}};
}

Values suggestive_parts(const Point& p, const RadialTerms&)
{
    const SuggestiveLimits limits = {0.3f, 0.25f, 2, 1.5f, 1};
    const SuggestiveEnd a = {vec3(p.v), p.k.z, p.n.x, 1 + p.k.w}, b = {vec3(p.n), p.e1.x, p.e1.y, 1 + p.k.z};
    const vec2 part = suggestive_part(a, b, limits.speed_limit);
    const SuggestiveEnd between = suggestive_between(a, b, p.k.w);
    // Positive parts divide by the differences of what they compare.
    const float left = limits.speed_limit * (a.gradient - b.gradient), turned = a.turn - b.turn;
    const float apart = std::min({std::abs(a.strength - b.strength), std::abs(left + turned), std::abs(left - turned)}) + 1e-6f;
    return {{{part.x, 1 + 4 / apart}, {part.y, 1 + 4 / apart}, {between.position.x, 6}, {between.strength, 2}, {suggestive_ink(a, limits), 2}, {suggestive_ink(between, limits), 6}}};
}

Values suggestive_pieces(const Point& p, const RadialTerms&)
{
    const SuggestiveLimits limits = {0.3f, 0.25f, 2, 0, 1};
    const SuggestiveCorner corners[3] = {{5u, away_from_zero(p.n.x), away_from_zero(p.n.y), 0, 0},
                                         {2u, away_from_zero(p.n.z), away_from_zero(p.e1.x), 0, 0},
                                         {9u, away_from_zero(p.e1.y), away_from_zero(p.e1.z), 0, 0}};
    const bool crossed = (corners[0].kr < 0) != (corners[1].kr < 0) || (corners[1].kr < 0) != (corners[2].kr < 0);
    const vec3 positions[3] = {vec3(p.v), vec3(p.e1), vec3(p.e2)};
    SuggestivePiece piece = {vec3(0), vec3(0), 0, 0, 0, 0};
    const bool drawn = crossed && suggestive_piece(corners, positions, limits, piece);
    if (!drawn)
        return {{{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}}};
    // A cut divides by the difference of two strengths.
    const float cut = piece.edge_a < 0 || piece.edge_b < 0 ? 1e2f : 1.0f;
    return {{{1, 0}, {float(piece.edge_a * 4 + piece.edge_b), 0}, {piece.a.x, 6 * cut}, {piece.b.y, 6 * cut}, {piece.ink_a, 6 * cut}, {piece.ink_b, 6 * cut}}};
}

/// Directions, there and back, and frames of places in one of the three grids: the device has another one for each third of the points.
Values directions(const Point& p, const RadialTerms&)
{
    const int kind = int(p.k.w * 2.999f);
    const vec2 place = place_of_direction(kind, vec3(p.n));
    const MapFrame back = frame_of_place(kind, place), frame = frame_of_place(kind, vec2(p.k.z, 0.5f * p.k.z + 0.25f * p.k.w));
    const vec2 folded = fold_octahedron(vec2(p.k.z, p.k.w));
    return {{{place.x + turn_about_y(p.n.x, p.n.z), 2}, {dot(back.towards, vec3(p.v)), 10}, {sum({frame.right.x, frame.up.y}), 2}, {dot(frame.up, vec3(1, 2, 3)), 6}, {dot(frame.towards, vec3(1, 2, 3)), 6},
             {folded.x - folded.y, 2}}};
}

/// Whole numbers, so exactly the same.
Values map_ranks(const Point& p, const RadialTerms&)
{
    const ivec2 cell = ivec2(vec2(p.k.z, p.k.w) * 15.9f);
    const ivec2 cells = ivec2(16, 16);
    return {{{float(swept_rank(cell.x, cell.y, 16, true)), 1}, {float(hilbert_rank(16u, cell)), 1}, {float(rank_of_cell(PHI_ZIGZAG, cells, cell)), 1},
             {float(rank_of_cell(HILBERT_CURVE, cells, cell)), 1}, {float(rank_of_cell(THETA_LINEAR, cells, cell)), 1}}};
}

/// Tangents lose digits where they are made longer.
Values bent_edges(const Point& p, const RadialTerms&)
{
    const dvec3 from(p.v), to(p.e2), n1(p.n), n2(p.e1);
    const double weight = double(p.k.z), size = glm::length(to - from);
    const EdgeTangents t = edge_tangents(from, to, n1, n2);
    const float a = float(size / glm::length(to - from - n1 * glm::dot(to - from, n1))), b = float(size / glm::length(to - from - n2 * glm::dot(to - from, n2)));
    const float term = 6 * std::max({1.0f, a, b});
    const dvec3 middle = edge_middle(from, to, t, weight);
    return {{{float(middle.x), term}, {float(middle.y), term}, {float(edge_quarter(t, weight).x), term}, {float(edge_three_quarters(t, weight).y), term},
             {float(along_edge(from, to, middle)), term / float(size)}, {float(across_edge(from, to, n1).z), 1}}};
}

Values edge_normals(const Point& p, const RadialTerms&)
{
    const dvec3 from(p.v), to(p.e2), n1(p.n), n2(p.e1);
    const dvec3 plain = edge_normal(from, to, n1, n2, double(p.k.z), false), mirrored = edge_normal(from, to, n1, n2, double(p.k.z), true);
    const bool serpentine = is_serpentine(from, from + n1, n1 + n2, p.k.z > 0.5f ? n1 : -n1);
    return {{{float(plain.x), 2}, {float(plain.z), 2}, {float(mirrored.x), 2}, {float(mirrored.z), 2}, {serpentine ? 1.0f : 0.0f, 0}}};
}

const Formula formulas_of_the_library[] = {
    {"direction_grid",
     "int kind = int(p.k.w * 2.999f); vec2 place = place_of_direction(kind, n); MapFrame back = frame_of_place(kind, place);"
     "MapFrame f = frame_of_place(kind, vec2(p.k.z, 0.5f * p.k.z + 0.25f * p.k.w)); vec2 folded = fold_octahedron(vec2(p.k.z, p.k.w)); r[0] = place.x + turn_about_y(n.x, n.z);"
     "r[1] = dot(back.towards, v); r[2] = abs(f.right.x) + abs(f.up.y); r[3] = dot(f.up, vec3(1, 2, 3)); r[4] = dot(f.towards, vec3(1, 2, 3)); r[5] = folded.x - folded.y;",
     directions},
    {"map_rank",
     "ivec2 cell = ivec2(p.k.zw * 15.9f); ivec2 cells = ivec2(16, 16); r[0] = float(swept_rank(cell.x, cell.y, 16, true)); r[1] = float(hilbert_rank(16u, cell));"
     "r[2] = float(rank_of_cell(PHI_ZIGZAG, cells, cell)); r[3] = float(rank_of_cell(HILBERT_CURVE, cells, cell)); r[4] = float(rank_of_cell(THETA_LINEAR, cells, cell));",
     map_ranks},
    {"radial_terms", "r[0] = t.nv; r[1] = t.a; r[2] = t.b; r[3] = t.w2; r[4] = t.vv; r[5] = t.f;", view_in_frame},
    {"radial_curvature and derivatives",
     "r[0] = radial_curvature(t, p.k.x, p.k.y); r[1] = radial_curvature_derivative(t, p.k.x, p.k.y, p.derivative);"
     "r[2] = radial_curvature_derivative_across(t, p.k.x, p.k.y, p.derivative, 1.0f / sqrt(t.w2)); r[3] = is_head_on(t) ? 1.0f : 0.0f;",
     radial},
    {"suggestive_strength, faded_ink",
     "float d = radial_curvature_derivative(t, p.k.x, p.k.y, p.derivative); r[0] = suggestive_strength(t, d, p.k.z, 0.02f);"
     "r[1] = faded_ink(p.k.z, 0.5f); r[2] = faded_ink(p.k.z, 0.0f);",
     strength},
    {"speeds",
     "suggestive_speed_parts(t, p.k.x, p.k.y, p.derivative.x, p.derivative.y, r[0], r[1]);"
     "r[2] = suggestive_speed(t, p.k.x, p.k.y, p.derivative.x, p.derivative.y); r[3] = contour_speed(t, p.k.x, p.k.y);",
     speeds},
    {"apparent_ridge",
     "float cosine = 0.1f + 0.9f * min(abs(t.nv) / sqrt(t.vv), 1.0f); float sine = sqrt(max(0.0f, 1.0f - cosine * cosine));"
     "vec2 w = vec2(t.a, t.b) * (sine / sqrt(t.w2)); ApparentRidge a = apparent_ridge(cosine, w, p.k.x, p.k.y, p.derivative, 0.25f);"
     "r[0] = a.q; r[1] = abs(a.along); r[2] = abs(a.across); r[3] = abs(a.slope);",
     apparent},
    {"edge_zero, at_zero, positive_part",
     "EdgeZero zero = edge_zero(7u, 3u, 0.1f + p.k.z, -0.1f - p.k.w); vec2 part = positive_part(p.k.z - 0.5f, p.k.w - 0.5f); r[0] = float(zero.from);"
     "r[1] = zero.t; r[2] = at_zero(zero, v, n).x; r[3] = at_zero(zero, v.y, n.y); r[4] = part.x; r[5] = part.y;",
     zeros_on_edges},
    {"odd_corner, crossed_edges, zero_on_edge",
     "float f[3] = float[3](n.x, n.y, p.e1.x); for (int k = 0; k < 3; ++k) f[k] += f[k] < 0.0f ? -0.1f : 0.1f;"
     "bool s0 = f[0] < 0.0f; bool s1 = f[1] < 0.0f; bool s2 = f[2] < 0.0f; CrossedEdges edges = crossed_edges(s0, s1, s2);"
     "vec3 place = s0 != s1 || s1 != s2 ? zero_on_edge(uint[3](5u, 2u, 9u), vec3[3](v, p.e1.xyz, p.e2.xyz), f, edges.enter) : vec3(0.0f);"
     "r[0] = float(odd_corner(s0, s1, s2)); r[1] = float(edges.enter); r[2] = float(edges.leave); r[3] = place.x; r[4] = place.y; r[5] = place.z;",
     zeros_in_faces},
    {"crease_part",
     "for (int k = 0; k < 3; ++k) { CreasePart part = crease_part(k, n.x, n.y, n.z, p.e1.x, p.k.z, p.k.w); r[2 * k] = part.drawn ? 1.0f : 0.0f;"
     "r[2 * k + 1] = float(part.from * 4u + part.to) + (part.own_back ? 16.0f : 0.0f); }",
     crease_parts},
    {"suggestive_corner, suggestive_end",
     "SuggestiveCorner c = suggestive_corner(t, 3u, p.k.x, p.k.y, p.derivative, SuggestiveLimits(0.3f, 0.01f, 2.0f, 1.5f, -1.0f), false);"
     "SuggestiveEnd e = suggestive_end(SuggestiveCorner(3u, 0.1f + p.k.z, n.x, n.y, n.z), SuggestiveCorner(8u, -0.1f - p.k.w, p.e1.x, p.e1.y, p.e1.z), v, p.e2.xyz);"
     "r[0] = c.kr; r[1] = c.strength; r[2] = c.gradient; r[3] = e.strength; r[4] = e.position.x; r[5] = e.turn + e.gradient;",
     suggestive_ends},
    {"suggestive_part, suggestive_between, suggestive_ink",
     "SuggestiveLimits limits = SuggestiveLimits(0.3f, 0.25f, 2.0f, 1.5f, 1.0f); SuggestiveEnd a = SuggestiveEnd(v, p.k.z, n.x, 1.0f + p.k.w);"
     "SuggestiveEnd b = SuggestiveEnd(n, p.e1.x, p.e1.y, 1.0f + p.k.z); vec2 part = suggestive_part(a, b, limits.speed_limit);"
     "SuggestiveEnd m = suggestive_between(a, b, p.k.w); r[0] = part.x; r[1] = part.y; r[2] = m.position.x; r[3] = m.strength;"
     "r[4] = suggestive_ink(a, limits); r[5] = suggestive_ink(m, limits);",
     suggestive_parts},
    {"suggestive_piece",
     "float f[6] = float[6](n.x, n.y, n.z, p.e1.x, p.e1.y, p.e1.z); for (int k = 0; k < 6; ++k) f[k] += f[k] < 0.0f ? -0.1f : 0.1f;"
     "SuggestiveCorner c[3] = SuggestiveCorner[3](SuggestiveCorner(5u, f[0], f[1], 0.0f, 0.0f), SuggestiveCorner(2u, f[2], f[3], 0.0f, 0.0f),"
     "SuggestiveCorner(9u, f[4], f[5], 0.0f, 0.0f)); SuggestivePiece piece;"
     "if (((f[0] < 0.0f) != (f[2] < 0.0f) || (f[2] < 0.0f) != (f[4] < 0.0f))"
     "&& suggestive_piece(c, vec3[3](v, p.e1.xyz, p.e2.xyz), SuggestiveLimits(0.3f, 0.25f, 2.0f, 0.0f, 1.0f), piece)) {"
     "r[0] = 1.0f; r[1] = float(piece.edge_a * 4 + piece.edge_b); r[2] = piece.a.x; r[3] = piece.b.y; r[4] = piece.ink_a; r[5] = piece.ink_b; }",
     suggestive_pieces},
    {"seen_normal, diffuse",
     "vec3 seen = seen_normal(n, normalize(v)); r[0] = seen.x; r[1] = seen.y; r[2] = seen.z; r[3] = diffuse(seen, p.e1.xyz);", shading},
    {"shader lines",
     "float nv = p.k.w; r[0] = contour_distance(nv, p.k.x, 100.0f); r[1] = suggestive_distance(p.k.z, p.k.x, p.derivative.x, 100.0f);"
     "r[2] = line_cover(p.k.z * 4.0f, 2.0f); r[3] = shader_ink(nv, p.k.x, p.derivative.x, 100.0f, 2.0f, 2.0f, -1.0f);",
     inks},
    {"texture lines",
     "vec2 place = suggestive_place(p.k.x, p.derivative.x, 0.05f, 0.02f); vec2 contour = contour_place(p.k.w); r[0] = place.x; r[1] = place.y;"
     "r[2] = contour.x; r[3] = contour.y; r[4] = texture_level(p.derivative.xy, p.derivative.zw, 128.0f);",
     places},
    {"sobel, stands_out",
     "float z[9] = float[9](v.x, v.y, v.z, n.x, n.y, n.z, p.e1.x, p.e1.y, p.e1.z); vec2 g = sobel(z); r[0] = g.x; r[1] = g.y;"
     "r[2] = sobel_strength(z); r[3] = stands_out(z);",
     neighbourhood},
    {"surface_tone, is_step, ground_cover",
     "r[0] = surface_tone(n, normalize(v), p.e1.xyz, 0.3f, 0.0f); vec3 s = vec3(p.k.z, p.k.w, 0.5f) / 48.0f;"
     "r[1] = is_step(p.e1.xyz, p.e1.xyz + 1.5f * s) ? 1.0f : 0.0f; r[2] = ground_cover(5.0f * p.k.z);",
     pictures},
    {"normal_colour, map_place, map_normal, side_tone",
     "vec3 aside = 0.5f * p.e1.xyz; vec3 above = 0.5f * p.e2.xyz; vec2 place = map_place(p.k.zw, 64.0f); vec3 mixed = map_normal(normal_colour(n),"
     "normal_colour(n + aside), normal_colour(n - above), normal_colour(n + aside + above), p.k.zw); r[0] = mixed.x; r[1] = mixed.y; r[2] = mixed.z;"
     "r[3] = place.x; r[4] = place.y; r[5] = side_tone(n, normalize(v), 0.3f, 0.0f);",
     maps},
    {"toon_tone", "float lit = (floor(p.k.z * 20.0f) + 0.5f) / 20.0f; r[0] = toon_tone(lit, 0.3f, 2.0f); r[1] = toon_tone(lit, 0.31f, 5.0f);", toon},
    {"terrain error",
     "ErrorCamera c = ErrorCamera(p.e1.xyz, p.e2.xyz, n, 1000.0f, 0.01f, 0.0f); vec3 at = v + 6.0f * n;"
     "r[0] = height_error_exact(c, at, 0.5f * p.k.z); r[1] = height_error_any_way(c, at, 0.5f * p.k.z); r[2] = height_error_exact(c, -at, p.k.z);"
     "r[3] = height_off_chord(v.x, v.y, v.z);",
     [](const Point& p, const RadialTerms&) -> Values {
         const ErrorCamera c = {vec3(p.e1), vec3(p.e2), vec3(p.n), 1000.0f, 0.01f, 0.0f};
         const vec3 at = vec3(p.v) + 6.0f * vec3(p.n);
         const float exact = height_error_exact(c, at, 0.5f * p.k.z), z = dot(c.forward, at), far_z = z + 0.5f * p.k.z * c.forward.z;
         return {Value{exact, 500.0f * p.k.z * 4 * length(at) / (z * far_z)}, {height_error_any_way(c, at, 0.5f * p.k.z), 1000.0f}, {height_error_exact(c, -at, p.k.z), NO_BOUND},
                 {float(height_off_chord(double(p.v.x), double(p.v.y), double(p.v.z))), sum({p.v.x, p.v.y, p.v.z})}};
     }},
    {"terrain bound",
     "BoundCamera c = BoundCamera(p.e1.xyz, p.e2.xyz, n, 1000.0f, 0.01f, 0.0f); vec3 at = v + 6.0f * n; vec3 reach = 0.2f * vec3(p.k.z, p.k.w, 0.5f);"
     "r[0] = height_error_bound(c, at, reach, p.k.w, 1e-4f); r[1] = box_may_be_seen(c, vec2(0.4f, 0.3f), at, reach, 1e-4f) ? 1.0f : 0.0f;",
     [](const Point& p, const RadialTerms&) -> Values {
         const BoundCamera c = {dvec3(p.e1), dvec3(p.e2), dvec3(p.n), 1000.0, double(0.01f), 0.0};
         const vec3 at = vec3(p.v) + 6.0f * vec3(p.n), reach = 0.2f * vec3(p.k.z, p.k.w, 0.5f);
         const float bound = float(height_error_bound(c, dvec3(at), dvec3(reach), double(p.k.w), double(1e-4f)));
         return {Value{bound, 10 * bound + 1}, {box_may_be_seen(c, dvec2(double(0.4f), double(0.3f)), dvec3(at), dvec3(reach), double(1e-4f)) ? 1.0f : 0.0f, 1}};
     }},
    {"edge_tangents, edge_middle, edge_quarter, edge_three_quarters, along_edge, across_edge",
     "EdgeTangents e = edge_tangents(v, p.e2.xyz, n, p.e1.xyz); vec3 m = edge_middle(v, p.e2.xyz, e, p.k.z); r[0] = m.x; r[1] = m.y;"
     "r[2] = edge_quarter(e, p.k.z).x; r[3] = edge_three_quarters(e, p.k.z).y; r[4] = along_edge(v, p.e2.xyz, m); r[5] = across_edge(v, p.e2.xyz, n).z;",
     bent_edges},
    {"is_serpentine, edge_normal",
     "vec3 m = edge_normal(v, p.e2.xyz, n, p.e1.xyz, p.k.z, false); vec3 s = edge_normal(v, p.e2.xyz, n, p.e1.xyz, p.k.z, true); r[0] = m.x; r[1] = m.z;"
     "r[2] = s.x; r[3] = s.z; r[4] = is_serpentine(v, v + n, n + p.e1.xyz, p.k.z > 0.5f ? n : -n) ? 1.0f : 0.0f;",
     edge_normals},
};

class GpuFormulas : public Gpu {};

TEST_F(GpuFormulas, GiveTheSameOnBothSides)
{
    const std::vector<Point> all = random_points(11);
    for (const Formula& formula : formulas_of_the_library) {
        const std::vector<float> device = on_device(formula.body, all);
        float worst = 0;
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Values values = formula.on_processor(all[i], terms_of(all[i]));
            for (std::size_t k = 0; k < outputs; ++k) {
                const float difference = std::abs(device[outputs * i + k] - values[k].result), term = values[k].term;
                if (!(difference <= tolerance * term) && wrong++ < 3)
                    ADD_FAILURE() << formula.name << ", result " << k << " at point " << i << ": " << device[outputs * i + k] << " on the device, "
                                  << values[k].result << " on the processor, largest term " << term;
                if (term > 0)
                    worst = std::max(worst, difference / term);
            }
        }
        EXPECT_EQ(wrong, 0u) << formula.name;
        fmt::print("[ formula  ] {}: largest difference {:.1e} of the largest term\n", formula.name, worst);
    }
}

// A formula that nobody compares may drift apart. (Those of pictures are compared whole, in image_lines_test.cpp.)
TEST_F(GpuFormulas, AreAllCompared)
{
    std::string bodies = "radial_terms("; // every body starts from them
    for (const Formula& formula : formulas_of_the_library)
        bodies += formula.body;
    // Families with a test of their own.
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(LIMN_FORMULAS) / "../../../tests/gpu"))
        if (entry.path().filename().string().ends_with("_formulas_test.cpp"))
            bodies += read_text(entry.path());
    // A shader whose answers shadow_look_up_test.cpp compares: near borders of texels the least rounding makes another one of them.
    bodies += read_text(std::filesystem::path(LIMN_FORMULAS) / "../gpu/shaders/shadow_look_up.comp");
    int found = 0;
    for (const auto& entry : std::filesystem::directory_iterator(LIMN_FORMULAS)) {
        const std::string text = read_text(entry.path());
        if (entry.path().extension() != ".glsl" || text.find("#pragma once") == std::string::npos)
            continue;
        for (std::size_t at = text.find("\nFORMULA "); at != std::string::npos; at = text.find("\nFORMULA ", at + 1), ++found) {
            const std::size_t name = text.find(' ', at + 9) + 1, end = text.find('(', name);
            EXPECT_NE(bodies.find(text.substr(name, end + 1 - name)), std::string::npos) << entry.path() << ": " << text.substr(name, end - name);
        }
    }
    EXPECT_GE(found, 16);
}

} // namespace
} // namespace limn::test
