#pragma once

#include "limn/formulas/formulas.h"
#include "limn/lines/line_model.h"
#include "limn/lines/segment.h"
#include "limn/lines/suggestive.h"

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

using formulas::SuggestiveCorner;

inline formulas::SuggestiveLimits suggestive_limits(const SuggestiveOptions& options)
{
    return {options.feature_size, options.limit, options.fade, options.speed_limit, options.highlight ? -1.0f : 1.0f};
}

inline SuggestiveCorner suggestive_corner(const formulas::RadialTerms& r, std::uint32_t vertex, float k1, float k2, const vec4& derivative,
                                          const SuggestiveOptions& options, bool orthographic)
{
    return formulas::suggestive_corner(r, vertex, k1, k2, derivative, suggestive_limits(options), orthographic);
}

/// The piece of suggestive line in a face whose corners differ in the sign of kr, directed as formulas::suggestive_piece says.
/// An end that was trimmed lies on no edge.
/// @param edges  ids of the edges from corner k to corner k+1
/// @return false where nothing is drawn
inline bool trim_suggestive(const SuggestiveCorner (&corners)[3], const vec3 (&positions)[3], const std::uint32_t (&edges)[3], std::uint32_t face,
                            const SuggestiveOptions& options, Segment& segment)
{
    formulas::SuggestivePiece piece;
    if (!formulas::suggestive_piece(corners, positions, suggestive_limits(options), piece))
        return false;
    segment.a = piece.a;
    segment.b = piece.b;
    segment.ink_a = piece.ink_a;
    segment.ink_b = piece.ink_b;
    segment.face = face;
    segment.edge_a = piece.edge_a >= 0 ? edges[piece.edge_a] : none;
    segment.edge_b = piece.edge_b >= 0 ? edges[piece.edge_b] : none;
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
