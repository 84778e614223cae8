#pragma once

#include <cmath>

#include "limn/formulas/formulas.h"
#include "limn/lines/edge_zero.h"
#include "limn/lines/line_model.h"
#include "limn/lines/segment.h"
#include "limn/lines/suggestive.h"
#include "limn/lines/trim.h"

namespace limn {

// What every way of extracting suggestive contours (whole mesh, clusters, random faces) does at one vertex and in one
// face. They give the same bits because they all go through here.

/// What a vertex shows to an eye, as bits: the contour generator and the zero set of the radial curvature run through
/// the faces whose corners differ in a bit. 0 counts as positive.
enum ViewCode : std::uint8_t { facing_away = 1, radially_concave = 2 };

inline std::uint8_t view_code(const formulas::RadialTerms& r) { return std::uint8_t((r.nv < 0 ? facing_away : 0) | (r.f < 0 ? radially_concave : 0)); }

inline formulas::RadialTerms radial_terms_of(const LineModel& model, const View& view, std::uint32_t vertex)
{
    return formulas::radial_terms(view.to_eye(model.positions[vertex]), model.normals[vertex], model.e1[vertex], model.e2[vertex],
                                  model.k1[vertex], model.k2[vertex]);
}

/// True if the flat face turns its outer side to the eye. Computed from positions, so that no estimate of normals enters.
inline bool faces_eye(const vec3& p0, const vec3& p1, const vec3& p2, const View& view)
{
    return glm::dot(glm::cross(p1 - p0, p2 - p0), view.to_eye(p0)) > 0;
}

/// One corner of a face as the trimming reads it.
struct SuggestiveCorner {
    std::uint32_t vertex = 0;          ///< global: orders the ends of an edge
    float kr = 0;                      ///< radial curvature; negative exactly where `radially_concave` is set
    float strength = 0;                ///< g of section 2.8; positive where a line may run
    float turn = 0, gradient = 0;      ///< speed = |turn| / gradient; both 0 where no speed limit is set
};

inline SuggestiveCorner suggestive_corner(const formulas::RadialTerms& r, std::uint32_t vertex, float k1, float k2, const vec4& derivative,
                                          const SuggestiveOptions& options, bool orthographic)
{
    SuggestiveCorner corner;
    corner.vertex = vertex;
    corner.kr = formulas::radial_curvature(r, k1, k2);
    if (r.f < 0 && !(corner.kr < 0))
        corner.kr = r.f; // the quotient underflowed
    const float along = formulas::radial_curvature_derivative(r, k1, k2, derivative);
    corner.strength = formulas::suggestive_strength(r, options.highlight ? -along : along, options.feature_size, options.limit);
    if (options.speed_limit > 0) {
        const float per_distance = orthographic ? 0.0f : 1.0f / std::sqrt(r.w2);
        const float across = formulas::radial_curvature_derivative_across(r, k1, k2, derivative, per_distance);
        formulas::suggestive_speed_parts(r, k1, k2, along, across, corner.turn, corner.gradient);
    }
    return corner;
}

/// Where the line kr = 0 of a face meets one of its edges.
struct SuggestiveEnd {
    vec3 position;
    float strength, turn, gradient;
};

inline SuggestiveEnd suggestive_end(const SuggestiveCorner& i, const SuggestiveCorner& j, const vec3& pi, const vec3& pj)
{
    const EdgeZero zero = edge_zero(i.vertex, j.vertex, i.kr, j.kr);
    const bool swapped = zero.from != i.vertex;
    const SuggestiveCorner &from = swapped ? j : i, &to = swapped ? i : j;
    return {swapped ? zero.mix(pj, pi) : zero.mix(pi, pj), zero.mix(from.strength, to.strength), zero.mix(from.turn, to.turn),
            zero.mix(from.gradient, to.gradient)};
}

/// The place at parameter s between two ends: an end itself, bit for bit, where nothing is cut off.
inline SuggestiveEnd between(const SuggestiveEnd& a, const SuggestiveEnd& b, float s)
{
    if (s <= 0 || s >= 1)
        return s <= 0 ? a : b;
    return {a.position + s * (b.position - a.position), a.strength + s * (b.strength - a.strength), a.turn + s * (b.turn - a.turn),
            a.gradient + s * (b.gradient - a.gradient)};
}

/// The part of [0,1] between two ends where the line is drawn: strong and slow enough.
inline Interval drawn_part(const SuggestiveEnd& a, const SuggestiveEnd& b, float speed_limit)
{
    Interval part = positive_interval(a.strength, b.strength);
    if (speed_limit > 0)
        for (const float sign : {1.0f, -1.0f}) // turning to either side
            part = intersection(part, positive_interval(speed_limit * a.gradient + sign * a.turn, speed_limit * b.gradient + sign * b.turn));
    return part;
}

/// Ink of a place on the line: fades towards the limit, and from half the speed limit on.
inline float suggestive_ink(const SuggestiveEnd& end, const SuggestiveOptions& options)
{
    const float ink = formulas::faded_ink(end.strength, options.fade * options.limit);
    if (!(options.speed_limit > 0) || !(options.fade > 0))
        return ink;
    const float most = options.speed_limit * end.gradient;
    return ink * (most > 0 ? glm::clamp(2.0f - 2.0f * std::abs(end.turn) / most, 0.0f, 1.0f) : 0.0f);
}

/// The piece of suggestive line in a face whose corners differ in the sign of kr. Directed like contours: the side
/// with kr >= 0 lies to its left, so that it leaves by the edge through which the next face is entered.
/// An end that was trimmed lies on no edge.
/// @param edges  ids of the edges from corner k to corner k+1
/// @return false where nothing is drawn
inline bool trim_suggestive(const SuggestiveCorner (&corners)[3], const vec3 (&positions)[3], const std::uint32_t (&edges)[3], std::uint32_t face,
                            const SuggestiveOptions& options, Segment& segment)
{
    const bool concave[3] = {corners[0].kr < 0, corners[1].kr < 0, corners[2].kr < 0};
    const int odd = odd_corner(concave[0], concave[1], concave[2]), arriving = (odd + 2) % 3;
    const int enter = concave[odd] ? odd : arriving, leave = concave[odd] ? arriving : odd;
    const auto end_on = [&](int k) { return suggestive_end(corners[k], corners[(k + 1) % 3], positions[k], positions[(k + 1) % 3]); };
    const SuggestiveEnd a = end_on(enter), b = end_on(leave);
    const Interval part = drawn_part(a, b, options.speed_limit);
    if (part.empty())
        return false;
    const SuggestiveEnd first = between(a, b, part.begin), last = between(a, b, part.end);
    segment.a = first.position;
    segment.b = last.position;
    segment.ink_a = suggestive_ink(first, options);
    segment.ink_b = suggestive_ink(last, options);
    segment.face = face;
    segment.edge_a = part.begin <= 0 ? edges[enter] : none;
    segment.edge_b = part.end >= 1 ? edges[leave] : none;
    return true;
}

/// The same for a face and vertices of a model.
inline SuggestiveCorner suggestive_corner(const LineModel& model, const View& view, std::uint32_t vertex, const SuggestiveOptions& options)
{
    return suggestive_corner(radial_terms_of(model, view, vertex), vertex, model.k1[vertex], model.k2[vertex], model.derivative[vertex], options,
                             view.orthographic);
}

inline bool trim_suggestive(const LineModel& model, std::uint32_t face, const SuggestiveCorner (&corners)[3], const SuggestiveOptions& options,
                            Segment& segment)
{
    const uvec3& t = model.faces[face];
    const vec3 positions[3] = {model.positions[t.x], model.positions[t.y], model.positions[t.z]};
    const std::uint32_t edges[3] = {model.adjacency.edge_id(3 * face), model.adjacency.edge_id(3 * face + 1), model.adjacency.edge_id(3 * face + 2)};
    return trim_suggestive(corners, positions, edges, face, options, segment);
}

inline bool any_strong(const SuggestiveCorner (&corners)[3])
{
    return corners[0].strength > 0 || corners[1].strength > 0 || corners[2].strength > 0;
}

/// A face on its own, with nothing computed before: the facing first, since it is the cheapest test then (section 2.9 c).
/// @return false where nothing is drawn
inline bool suggestive_in_face(const LineModel& model, const View& view, std::uint32_t face, const SuggestiveOptions& options, Segment& segment)
{
    const uvec3& t = model.faces[face];
    if (options.shortcuts.front_only && !faces_eye(model.positions[t.x], model.positions[t.y], model.positions[t.z], view))
        return false;
    const formulas::RadialTerms r[3] = {radial_terms_of(model, view, t.x), radial_terms_of(model, view, t.y), radial_terms_of(model, view, t.z)};
    if ((r[0].f < 0) == (r[1].f < 0) && (r[0].f < 0) == (r[2].f < 0))
        return false;
    const auto corner = [&](int k) {
        return suggestive_corner(r[k], t[k], model.k1[t[k]], model.k2[t[k]], model.derivative[t[k]], options, view.orthographic);
    };
    const SuggestiveCorner corners[3] = {corner(0), corner(1), corner(2)};
    return any_strong(corners) && trim_suggestive(model, face, corners, options, segment);
}

} // namespace limn
