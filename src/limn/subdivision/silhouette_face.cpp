#include "limn/subdivision/silhouette_face.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "limn/subdivision/polygon_triangles.h"
#include "limn/subdivision/turned_triangle.h"

namespace limn {
namespace {

constexpr int most_levels_for_loops = 6;

/// A place on side k of a face, seen from the face.
dvec2 on_side(std::uint32_t k, double t)
{
    double weights[3] = {0, 0, 0};
    weights[k] = 1 - t;
    weights[(k + 1) % 3] = t;
    return {weights[1], weights[2]};
}

/// The parameter along side k of a point of its edge.
double along_side(const LoopTopology& topology, std::uint32_t h, double t) { return topology.half_edge[topology.edge[h]] == h ? t : 1 - t; }

/// The samples that arcs are measured by, each made once.
class ArcMeasure {
public:
    ArcMeasure(const SilhouetteView& view, const ContourCell& cell) : view_(view), cell_(cell) {}
    bool needs(const dvec2& a, const dvec2& middle, const dvec2& b, int halvings)
    {
        if (view_.curve_points > 0)
            return (1 << halvings) < view_.curve_points;
        const SurfaceSample from = sample(a), to = sample(b);
        const double error = chord_error(view_.plane, from, sample(middle), to);
        return error > view_.pixels || (!view_.tight.empty() && error > view_.pixels_along(from.position, to.position));
    }

private:
    SurfaceSample sample(const dvec2& at)
    {
        for (const auto& [place, known] : samples_)
            if (place == at)
                return known;
        samples_.emplace_back(at, limn::sample(cell_, at));
        return samples_.back().second;
    }
    const SilhouetteView& view_;
    const ContourCell& cell_;
    std::vector<std::pair<dvec2, SurfaceSample>> samples_;
};

bool are_on_one_side(const std::vector<BoundaryCrossing>& crossings, const dvec2& a, const dvec2& b)
{
    for (const BoundaryCrossing& from : crossings)
        for (const BoundaryCrossing& to : crossings)
            if (from.at == a && to.at == b && from.side == to.side)
                return true;
    return false;
}

void trace(const SilhouetteView& view, FaceLeaf& leaf)
{
    ArcMeasure measure(view, leaf.cell);
    // An arc that leaves through the side that it came in by must not be the side itself, which may be such an arc of the next face too.
    const NeedsPoint needs = [&](const dvec2& a, const dvec2& middle, const dvec2& b, int halvings) {
        return (halvings == 0 && are_on_one_side(leaf.crossings, a, b)) || measure.needs(a, middle, b, halvings);
    };
    leaf.arcs = trace_contour(leaf.cell, leaf.crossings, needs);
    if (leaf.arcs.empty()) {
        leaf.front = leaf.cell.pieces.empty() ? leaf.front : contour_value(leaf.cell, (leaf.cell.corners[0] + leaf.cell.corners[1] + leaf.cell.corners[2]) / 3.0) >= 0;
        leaf.cell.pieces.clear(), leaf.cell.rests.clear();
    }
}

bool has_loop(const FaceLeaf& leaf)
{
    return std::any_of(leaf.arcs.begin(), leaf.arcs.end(), [](const ContourArc& arc) { return arc.front() == arc.back(); });
}

void append_children(const SilhouetteView& view, const FaceLeaf& leaf, std::vector<FaceLeaf>& out)
{
    std::array<SplitCell, 4> children = split_with_crossings(leaf.cell, leaf.crossings);
    for (SplitCell& child : children) {
        FaceLeaf& next = out.emplace_back();
        next = {std::move(child.cell), std::move(child.crossings), {}, leaf.front, leaf.level + 1};
        trace(view, next);
    }
}

CutFace without_loops(const SilhouetteView& view, CutFace face)
{
    for (int level = 0; level < most_levels_for_loops; ++level) {
        std::vector<bool> which;
        for (const FaceLeaf& leaf : face.leaves)
            which.push_back(has_loop(leaf));
        if (std::find(which.begin(), which.end(), true) == which.end())
            break;
        face = split_leaves(view, face, which);
    }
    return face;
}

/// Whether the corners of a face and the middles of its sides are one place but for rounding: then its normals mean nothing.
bool is_point(const SilhouetteView& view, std::uint32_t face)
{
    constexpr double rounding = 1e-12;
    const LoopTopology& t = view.topology();
    const dvec3& first = view.pose.corners.positions[t.triangles[face].x];
    double reach = 0;
    for (std::uint32_t k = 0; k < 3; ++k)
        reach = std::max({reach, glm::distance(first, view.pose.corners.positions[t.start(3 * face + k)]), glm::distance(first, view.pose.middles[t.edge[3 * face + k]])});
    return reach <= rounding * glm::length(first);
}

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Points by their places.
class PointSet {
public:
    /// @return its number; it keeps the one that it had
    std::uint32_t add(const FacePoint& point)
    {
        const auto [place, is_new] = numbers_.try_emplace({point.at.x, point.at.y}, std::uint32_t(points.size()));
        if (is_new)
            points.push_back(point);
        return place->second;
    }
    std::uint32_t number(const dvec2& at) const { return numbers_.at({at.x, at.y}); }

    std::vector<FacePoint> points;

private:
    std::map<std::pair<double, double>, std::uint32_t> numbers_;
};

/// Everything that may lie on sides of leaves.
PointSet boundary_points(const SilhouetteView& view, const CutFace& face, const EdgePoints& edges)
{
    const LoopTopology& t = view.topology();
    PointSet set;
    for (std::uint32_t k = 0; k < 3; ++k)
        set.add({FacePoint::Of::corner, k, 0, on_side(k, 0)});
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t h = 3 * face.face + k;
        const std::span<const CutPoint> points = edges[t.edge[h]];
        for (std::uint32_t i = 0; i < points.size(); ++i)
            set.add({FacePoint::Of::edge, k, i, on_side(k, along_side(t, h, points[i].t))});
    }
    for (const FaceLeaf& leaf : face.leaves) {
        for (const dvec2& corner : leaf.cell.corners)
            set.add({FacePoint::Of::face, 0, 0, corner});
        for (const BoundaryCrossing& c : leaf.crossings)
            set.add({FacePoint::Of::face, 0, 0, c.at});
    }
    return set;
}

/// Appends the points within a side, in order. The ends of sides are dyadic; crossings keep away from them further than their places are
/// rounded.
void append_between(std::span<const FacePoint> points, const dvec2& from, const dvec2& to, Polygon& polygon)
{
    constexpr double rounding = 1e-13;
    const dvec2 along = to - from;
    const double square = glm::dot(along, along);
    std::vector<std::pair<double, std::uint32_t>> found;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const dvec2 d = points[i].at - from;
        const double t = glm::dot(d, along) / square;
        if (t > 0 && t < 1 && std::abs(cross(d, along)) <= rounding * std::sqrt(square) && points[i].at != to)
            found.emplace_back(t, i);
    }
    std::sort(found.begin(), found.end());
    for (const auto& [t, i] : found)
        polygon.push_back(i);
}

/// The part of a leaf on one side of its arcs.
struct Region {
    Polygon polygon;
    bool front;
};

/// A leaf's corners and the points on its sides.
struct LeafBoundary {
    std::array<std::uint32_t, 3> corners;
    std::array<Polygon, 3> sides; ///< from corner to corner, both included
};

LeafBoundary boundary_of(const FaceLeaf& leaf, std::span<const FacePoint> on_sides, const PointSet& set)
{
    LeafBoundary out;
    for (std::size_t k = 0; k < 3; ++k)
        out.corners[k] = set.number(leaf.cell.corners[k]);
    for (std::size_t k = 0; k < 3; ++k) {
        out.sides[k] = {out.corners[k]};
        append_between(on_sides, leaf.cell.corners[k], leaf.cell.corners[(k + 1) % 3], out.sides[k]);
        out.sides[k].push_back(out.corners[(k + 1) % 3]);
    }
    return out;
}

bool faces_eye_at(const SilhouetteView& view, std::uint32_t face, const FaceLeaf& leaf, const dvec2& corner)
{
    if (leaf.arcs.empty())
        return leaf.front;
    for (std::uint32_t k = 0; k < 3; ++k)
        if (corner == on_side(k, 0))
            return view.faces_eye(3 * face + k);
    return contour_value(leaf.cell, corner) >= 0;
}

/// The leaf's polygon, cut along its arcs. @param curves  gains those that cut it
std::vector<Region> regions_of(const SilhouetteView& view, std::uint32_t face, const FaceLeaf& leaf, const LeafBoundary& boundary, PointSet& set,
                               std::vector<std::vector<std::uint32_t>>& curves)
{
    Polygon whole;
    for (const Polygon& side : boundary.sides)
        whole.insert(whole.end(), side.begin(), side.end() - 1);
    const std::array<std::uint32_t, 3>& corners = boundary.corners;
    std::vector<Region> regions = {{std::move(whole), faces_eye_at(view, face, leaf, leaf.cell.corners[0])}};
    const auto sign_of = [&](const Polygon& polygon, bool otherwise) {
        for (std::size_t k = 0; k < 3; ++k)
            if (std::find(polygon.begin(), polygon.end(), corners[k]) != polygon.end())
                return faces_eye_at(view, face, leaf, leaf.cell.corners[k]);
        return otherwise;
    };
    for (const ContourArc& arc : leaf.arcs) {
        std::vector<std::uint32_t> line;
        for (const dvec2& at : arc)
            line.push_back(set.add({FacePoint::Of::face, 0, 0, at}));
        for (std::size_t i = 0; i < regions.size(); ++i) {
            std::vector<Polygon> parts = cut_polygon(regions[i].polygon, line);
            if (parts.empty())
                continue;
            const bool first = sign_of(parts[0], !sign_of(parts[1], !regions[i].front));
            regions.push_back({std::move(parts[1]), sign_of(parts[1], !first)});
            regions[i] = {std::move(parts[0]), first};
            curves.push_back(std::move(line));
            break;
        }
    }
    return regions;
}

/// Places in a leaf's plane, so that its triangles have their shape; the parameters where it has no plane.
class LeafPlane {
public:
    /// @param p  where the corners are
    LeafPlane(const ParameterTriangle& corners, const std::array<dvec3, 3>& p) : corners_(corners)
    {
        const dvec3 a = p[1] - p[0], b = p[2] - p[0];
        const double length = glm::length(a), height = length > 0 ? glm::length(glm::cross(a, b)) / length : 0;
        if (height > 0)
            first_ = {length, 0}, second_ = {glm::dot(a, b) / length, height};
    }
    dvec2 place(const dvec2& at) const
    {
        const dvec2 a = corners_[1] - corners_[0], b = corners_[2] - corners_[0], d = at - corners_[0];
        const double area = cross(a, b);
        return cross(d, b) / area * first_ + cross(a, d) / area * second_;
    }

private:
    const ParameterTriangle& corners_;
    dvec2 first_ = {1, 0}, second_ = {0, 1};
};

using Segment = std::pair<std::uint32_t, std::uint32_t>;

Segment segment(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// In order.
std::vector<Segment> segments_of(const std::vector<std::vector<std::uint32_t>>& curves)
{
    std::vector<Segment> segments;
    for (const std::vector<std::uint32_t>& curve : curves)
        for (std::size_t i = 0; i + 1 < curve.size(); ++i)
            segments.push_back(segment(curve[i], curve[i + 1]));
    std::sort(segments.begin(), segments.end());
    return segments;
}

/// Whether a leaf that faces the eye somewhere is further from the surface than it may be.
bool is_too_flat(const SilhouetteView& view, std::uint32_t face, const FaceLeaf& leaf)
{
    if (!(view.surface_pixels > 0) || (leaf.arcs.empty() && !leaf.front))
        return false;
    const auto at = [&](const dvec2& place) { return view.pose.shape.position({face, place.x, place.y}); };
    for (std::size_t k = 0; k < 3; ++k) {
        const dvec2 &a = leaf.cell.corners[k], &b = leaf.cell.corners[(k + 1) % 3];
        if (middle_error(view.plane, at(a), at(0.5 * (a + b)), at(b)) > view.surface_pixels)
            return true;
    }
    return false;
}

} // namespace

bool may_hold_contour(const SilhouetteView& view, std::uint32_t face, const EdgePoints& edges)
{
    const LoopTopology& t = view.topology();
    std::array<Facing, 6> places;
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t h = 3 * face + k;
        for (const CutPoint& p : edges[t.edge[h]])
            if (p.crossing[view.side_of(h)])
                return true;
        places[k] = view.at_start(h);
        places[k + 3] = view.at_middle(h);
    }
    return may_be_crossed(places, share_of_faces) && !is_clear_of_contours(view.pose.shape, view.eye, face);
}

CutFace cut_face(const SilhouetteView& view, std::uint32_t face, const EdgePoints& edges, bool may_hold)
{
    const LoopTopology& t = view.topology();
    CutFace out{face, {}};
    FaceLeaf& leaf = out.leaves.emplace_back();
    leaf.cell.corners = {dvec2(0, 0), dvec2(1, 0), dvec2(0, 1)};
    leaf.front = view.faces_eye(3 * face);
    if (!may_hold || is_point(view, face))
        return out;
    leaf.cell = contour_cell(view.pose.shape, view.eye, face);
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t h = 3 * face + k;
        for (const CutPoint& p : edges[t.edge[h]])
            if (p.crossing[view.side_of(h)]) {
                const double along = along_side(t, h, p.t);
                leaf.crossings.push_back({int(k), along, on_side(k, along)});
            }
    }
    trace(view, leaf);
    return without_loops(view, std::move(out));
}

CutFace split_leaves(const SilhouetteView& view, const CutFace& face, const std::vector<bool>& which)
{
    CutFace out{face.face, {}};
    for (std::size_t i = 0; i < face.leaves.size(); ++i) {
        if (which[i])
            append_children(view, face.leaves[i], out.leaves);
        else
            out.leaves.push_back(face.leaves[i]);
    }
    return out;
}

bool refine_arcs(const SilhouetteView& view, CutFace& face)
{
    const auto points = [&] {
        std::size_t count = 0;
        for (const FaceLeaf& leaf : face.leaves)
            for (const ContourArc& arc : leaf.arcs)
                count += arc.size();
        return count;
    };
    const std::size_t before = points();
    for (FaceLeaf& leaf : face.leaves)
        if (!leaf.arcs.empty())
            trace(view, leaf);
    return points() > before;
}

std::vector<SidePoint> side_points(const CutFace& face)
{
    std::vector<SidePoint> points;
    for (const FaceLeaf& leaf : face.leaves)
        for (const dvec2& at : leaf.cell.corners) {
            const dvec3 weights(1 - at.x - at.y, at.x, at.y);
            for (int side = 0; side < 3; ++side)
                if (weights[(side + 2) % 3] == 0 && weights[side] > 0 && weights[side] < 1)
                    points.push_back({side, weights[(side + 1) % 3]});
        }
    return points;
}

FaceEdges face_edges(const LoopTopology& topology, std::uint32_t face, const EdgePoints& edges)
{
    return {edges[topology.edge[3 * face]], edges[topology.edge[3 * face + 1]], edges[topology.edge[3 * face + 2]]};
}

const dvec3& position_of(const SilhouetteView& view, std::uint32_t face, const FacePoint& point, const FaceEdges& on_sides, const std::vector<SurfaceSample>& own)
{
    switch (point.of) {
    case FacePoint::Of::corner: return view.pose.corners.positions[view.topology().triangles[face][int(point.side)]];
    case FacePoint::Of::edge: return on_sides[point.side][point.index].position;
    default: return own[point.index].position;
    }
}

const dvec3& normal_of(const SilhouetteView& view, std::uint32_t face, const FacePoint& point, const FaceEdges& on_sides, const std::vector<SurfaceSample>& own)
{
    const std::uint32_t h = 3 * face + point.side;
    switch (point.of) {
    case FacePoint::Of::corner: return view.pose.corners.normals[h];
    case FacePoint::Of::edge: return on_sides[point.side][point.index].normals[view.side_of(h)];
    default: return own[point.index].normal;
    }
}

FaceTriangles triangulate_face(const SilhouetteView& view, const CutFace& face, const EdgePoints& edges)
{
    PointSet set = boundary_points(view, face, edges);
    FaceTriangles out;
    std::vector<LeafBoundary> boundaries;
    std::vector<std::vector<Region>> regions;
    for (const FaceLeaf& leaf : face.leaves)
        boundaries.push_back(boundary_of(leaf, set.points, set));
    for (std::size_t i = 0; i < face.leaves.size(); ++i)
        regions.push_back(regions_of(view, face.face, face.leaves[i], boundaries[i], set, out.curves));
    out.points = std::move(set.points);
    for (FacePoint& point : out.points)
        if (point.of == FacePoint::Of::face) {
            point.index = std::uint32_t(out.own.size());
            out.own.push_back(view.pose.shape.sample({face.face, point.at.x, point.at.y}));
        }
    for (const FaceLeaf& leaf : face.leaves)
        out.to_split.push_back(is_too_flat(view, face.face, leaf));
    const std::vector<Segment> along_curves = segments_of(out.curves);
    std::vector<dvec2> places(out.points.size());
    std::vector<std::uint8_t> lines(out.points.size());
    const FaceEdges on_sides = face_edges(view.topology(), face.face, edges);
    const auto positions = [&](const std::array<std::uint32_t, 3>& corners) {
        std::array<dvec3, 3> at;
        for (std::uint32_t k = 0; k < 3; ++k)
            at[k] = position_of(view, face.face, out.points[corners[k]], on_sides, out.own);
        return at;
    };
    for (std::size_t i = 0; i < face.leaves.size(); ++i) {
        const LeafPlane plane(face.leaves[i].cell.corners, positions(boundaries[i].corners));
        for (const Region& region : regions[i])
            for (const std::uint32_t p : region.polygon)
                places[p] = plane.place(out.points[p].at), lines[p] = 0;
        for (std::size_t k = 0; k < 3; ++k)
            for (const std::uint32_t p : boundaries[i].sides[k])
                lines[p] = std::uint8_t(lines[p] | (1u << k));
        for (const Region& region : regions[i])
            for (const uvec3& triangle : triangulate_polygon(region.polygon, {places, lines})) {
                out.triangles.push_back(triangle);
                DrawnTriangle drawn{face.face, {}, positions({triangle.x, triangle.y, triangle.z}), {}};
                if (shows_side(view, drawn.positions, region.front))
                    continue;
                for (int k = 0; k < 3; ++k) {
                    drawn.at[std::size_t(k)] = out.points[triangle[k]].at;
                    drawn.on_contour[std::size_t(k)] = std::binary_search(along_curves.begin(), along_curves.end(), segment(triangle[k], triangle[(k + 1) % 3]));
                }
                const double turned = turned_beyond(view, drawn, region.front);
                out.to_split[i] = out.to_split[i] || (turned > 0 && turned > pixels_around(view, drawn));
                out.most_turned = std::max(out.most_turned, turned);
            }
    }
    return out;
}

} // namespace limn
