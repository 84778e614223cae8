#include "limn/subdivision/contour_crossings.h"

#include <algorithm>

#include "limn/subdivision/bezier_roots.h"
#include "limn/subdivision/silhouette_pose.h"

namespace limn {
namespace {

/// Crossings are kept this far away from the ends of their edge.
constexpr double least = 1e-7;
/// Levels below the refined face at which the pieces of an edge end towards an extraordinary vertex: always, and where a crossing is nearer.
constexpr int first_levels = 4, most_levels = 8;

const PatchClass::Node& root_of(const FacePatches& face) { return face.patches().nodes[0]; }

} // namespace

const std::vector<EdgeCrossing>& CrossingSearch::along(std::uint32_t half_edge, const std::array<bool, 2>& faces_eye) &
{
    half_edge_ = half_edge;
    const std::uint32_t face = half_edge / 3, k = half_edge % 3;
    const FacePatches first = shape_.patches(4 * face + k), second = shape_.patches(4 * face + (k + 1) % 3);
    parts_.clear();
    crossings_.clear();
    collect(first, root_of(first), 0, 0, 0.5, first_levels, parts_);
    collect(second, root_of(second), 2, 0.5, 1, first_levels, parts_);
    search(parts_, faces_eye[0], faces_eye[1], first_levels);
    finish();
    return crossings_;
}

const std::vector<EdgeCrossing>& CrossingSearch::along_regular(std::uint32_t edge, const std::array<bool, 2>& faces_eye) &
{
    const PatchTable& table = shape_.table();
    half_edge_ = table.control().half_edge[edge];
    crossings_.clear();
    std::array<dvec3, regular_edge_support> points;
    const RegularEdge& support = table.edges().regular(edge);
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = shape_.control_positions()[support[i]];
    const Piece piece = {dvec3(0), regular_side_net(points), 0, 1};
    const bool at_end = add_changes(piece, contour_along(piece.anchor, piece.net, eye_), faces_eye[0]);
    if (at_end != faces_eye[1]) // by rounding
        add_at(1);
    finish();
    return crossings_;
}

/// Appends the parts of a triangle's side, in order.
void CrossingSearch::collect(const FacePatches& face, const PatchClass::Node& node, int side, double begin, double end, int levels, std::vector<Part>& parts) const
{
    if (node.kind == PatchClass::Kind::patch) {
        const SideNet net = side_net(face, node, side);
        parts.push_back({&face, &node, side, {face.anchor(), net, begin, end}, contour_along(face.anchor(), net, eye_)});
    } else if (node.kind == PatchClass::Kind::corner || levels == 0) {
        parts.push_back({&face, &node, side, {face.anchor(), {}, begin, end}, {}});
    } else {
        const double middle = 0.5 * (begin + end);
        const PatchClass::Node* children = &face.patches().nodes[node.first_child];
        collect(face, children[side], 0, begin, middle, levels - 1, parts);
        collect(face, children[(side + 1) % 3], 2, middle, end, levels - 1, parts);
    }
}

/// @param before, after  whether the surface faces the eye at the ends
void CrossingSearch::search(const std::vector<Part>& parts, bool before, bool after, int levels)
{
    bool now = before;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Part& part = parts[i];
        if (part.is_patch()) {
            now = add_changes(part.piece, part.along, now);
            continue;
        }
        const bool last = i + 1 == parts.size(), known = last || parts[i + 1].is_patch();
        const bool next = last ? after : parts[i + 1].along[0] >= 0;
        if (known && now == next)
            continue;
        if (part.node->kind == PatchClass::Kind::corner || levels == most_levels) {
            if (known)
                add_at(0.5 * (part.piece.begin + part.piece.end));
        } else {
            std::vector<Part> finer;
            collect(*part.face, *part.node, part.side, part.piece.begin, part.piece.end, 1, finer);
            search(finer, now, known ? next : now, levels + 1);
        }
        now = known ? next : now;
    }
    if (now != after)
        add_at(parts.back().piece.end);
}

/// The changes of a piece's sign. @return the sign at its end
bool CrossingSearch::add_changes(const Piece& piece, const std::array<double, 10>& along, bool before)
{
    if ((along.front() >= 0) != before) // by rounding
        add_at(piece.begin);
    roots_.clear();
    append_sign_changes(along, roots_);
    for (const double root : roots_) {
        const double t = piece.begin + root * (piece.end - piece.begin);
        if (t >= least && t <= 1 - least)
            crossings_.push_back({t, sample_side(piece.anchor, piece.net, root)});
        else
            add_at(t);
    }
    return along.back() >= 0;
}

void CrossingSearch::add_at(double t)
{
    t = std::clamp(t, least, 1 - least);
    crossings_.push_back({t, shape_.sample(on_half_edge(half_edge_, t))});
}

void CrossingSearch::finish()
{
    if (crossings_.size() > 1)
        std::sort(crossings_.begin(), crossings_.end(), [](const EdgeCrossing& a, const EdgeCrossing& b) { return a.t < b.t; });
}

} // namespace limn
