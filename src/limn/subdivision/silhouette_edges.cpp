#include "limn/subdivision/silhouette_edges.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "limn/base/parallel.h"
#include "limn/subdivision/contour_crossings.h"
#include "limn/subdivision/contour_filter.h"

namespace limn {
namespace {

constexpr std::size_t vertex_grain = 2048, test_grain = 4096, search_grain = 64, point_grain = 64;

/// Whether the limit surface has a fold there; semi-sharp edges become smooth.
bool is_sharp(const LoopTopology& t, std::uint32_t edge) { return t.sharpness[edge] >= infinitely_sharp; }

CutPoint make_point(const SilhouetteView& view, std::uint32_t edge, double t)
{
    const LoopTopology& topology = view.topology();
    const std::uint32_t h = topology.half_edge[edge], over = topology.twin[h];
    const SurfaceSample sample = view.pose.shape.sample(on_half_edge(h, t));
    CutPoint point{t, edge, {false, false}, sample.position, {sample.normal, sample.normal}};
    if (over != none && is_sharp(topology, edge))
        point.normals[1] = view.pose.shape.normal(on_half_edge(over, 1 - t));
    return point;
}

/// How a vertex is turned to the eye where no edge around it is sharp.
struct VertexFacing {
    double height; ///< Facing::height
    double nearness; ///< of the eye: by how much lines of sight may turn for each unit of length, times 4
    bool faces_eye() const { return height >= 0; }
};

std::vector<VertexFacing> facing_vertices(const SilhouetteView& view)
{
    const LimitSurface& corners = view.pose.corners;
    std::vector<VertexFacing> facing(corners.positions.size());
    parallel_each(facing.size(), vertex_grain, [&](std::size_t v) {
        const dvec3 to_eye = view.eye.from(corners.positions[v]);
        const double inverse = 1 / glm::length(to_eye);
        facing[v] = {glm::dot(to_eye, corners.vertex_normals[v]) * inverse, 4 * view.eye.place.w * inverse};
    });
    return facing;
}

/// Whether an edge has to be searched. Most are ruled out by their start alone: the heights of the other two places are no further from its own
/// than unit normals and lines of sight are from each other, and the directions of two vectors are not further apart than twice the
/// difference of the vectors over the length of one.
bool is_candidate(const SilhouetteView& view, std::span<const VertexFacing> facing, std::uint32_t edge)
{
    const EdgeSpread& spread = view.pose.spreads[edge];
    if (std::isinf(spread.turned)) // an end has no one normal, or there is a border
        return true;
    const VertexFacing& start = facing[spread.start];
    if (std::abs(start.height) >= 2 * double(spread.turned) + start.nearness * double(spread.reach))
        return false;
    const double heights[3] = {start.height, facing[spread.end].height, view.facing(view.pose.middles[edge], view.pose.middle_normals[edge][0]).height};
    return may_be_crossed(heights, double(spread.turned), share_of_edges);
}

void add_outline_points(const SilhouetteView& view, std::uint32_t edge, const CutPoint& a, const CutPoint& b, int depth, std::vector<CutPoint>& points)
{
    constexpr int deepest = 8;
    const CutPoint middle = make_point(view, edge, 0.5 * (a.t + b.t));
    const dvec2 pixels[3] = {view.plane.pixel(a.position), view.plane.pixel(middle.position), view.plane.pixel(b.position)};
    if (depth == deepest || !view.plane.is_in_picture(pixels))
        return;
    if (distance_to_line(pixels[1], pixels[0], pixels[2]) <= view.pixels_along(a.position, b.position))
        return;
    add_outline_points(view, edge, a, middle, depth + 1, points);
    points.push_back(middle);
    add_outline_points(view, edge, middle, b, depth + 1, points);
}

/// Appends the points that an edge has to get where SilhouetteView::tight asks for them.
void append_tight_points(const SilhouetteView& view, std::uint32_t edge, std::span<const CutPoint> points, std::vector<CutPoint>& out)
{
    const LoopTopology& t = view.topology();
    const std::uint32_t h = t.half_edge[edge];
    const auto add = [&](const CutPoint& a, const CutPoint& b) {
        if (view.pixels_along(a.position, b.position) < view.pixels)
            add_outline_points(view, edge, a, b, 0, out);
    };
    CutPoint before{0, edge, {false, false}, view.pose.corners.positions[t.start(h)], {}};
    for (const CutPoint& point : points) {
        add(before, point);
        before = point;
    }
    add(before, {1, edge, {false, false}, view.pose.corners.positions[t.end(h)], {}});
}

using Crossings = std::vector<EdgeCrossing>;

/// Whether the eye sees a border or a sharp edge from one side only, somewhere. @param crossed  by a contour
bool is_outline(const SilhouetteView& view, std::uint32_t edge, bool crossed)
{
    const LoopTopology& t = view.topology();
    const std::uint32_t h = t.half_edge[edge], over = t.twin[h];
    if (over == none)
        return true;
    return is_sharp(t, edge) && (crossed || view.faces_eye(h) != view.faces_eye(next_half_edge(over)));
}

/// Points that are as good as the same become one.
void append_without_repeats(std::span<const CutPoint> points, std::vector<CutPoint>& out)
{
    constexpr double same = 1e-9;
    const std::size_t before = out.size();
    for (const CutPoint& p : points) {
        const bool repeated = out.size() > before && p.t - out.back().t < same && !(p.crossing[0] && out.back().crossing[0]) && !(p.crossing[1] && out.back().crossing[1]);
        if (!repeated) {
            out.push_back(p);
            continue;
        }
        for (std::size_t side = 0; side < 2; ++side)
            out.back().crossing[side] = out.back().crossing[side] || p.crossing[side];
    }
}

/// Appends the points of edges, one edge after the other.
class EdgeCutter {
public:
    EdgeCutter(const SilhouetteView& view, std::span<const VertexFacing> facing) : view_(view), facing_(facing), search_(view.pose.shape, view.eye) {}

    /// @param edges  candidates, up to 64
    void cut(std::span<const std::uint32_t> edges, std::vector<CutPoint>& out)
    {
        for (std::uint64_t left = changing(edges); left != 0; left &= left - 1)
            cut(edges[std::size_t(std::countr_zero(left))], out);
    }

private:
    std::array<bool, 2> faces_eye(std::uint32_t edge) const
    {
        const EdgeSpread& spread = view_.pose.spreads[edge];
        return {facing_[spread.start].faces_eye(), facing_[spread.end].faces_eye()};
    }
    /// A bit for each of the edges but those that are regular and along which the coefficients of the contour's polynomial have one sign.
    std::uint64_t changing(std::span<const std::uint32_t> edges) const
    {
        const ControlEdges& kinds = view_.pose.shape.table().edges();
        std::uint64_t bits = 0;
        EdgeLanes lanes;
        std::array<std::size_t, edge_lanes> numbers;
        std::size_t count = 0;
        const auto test = [&] {
            const SignLanes signs = contour_signs(lanes, view_.eye);
            for (std::size_t k = 0; k < count; ++k) {
                const bool front = !(signs.negative >> k & 1), change = signs.change >> k & 1;
                if (change || faces_eye(edges[numbers[k]]) != std::array<bool, 2>{front, front})
                    bits |= std::uint64_t(1) << numbers[k];
            }
            count = 0;
        };
        for (std::size_t i = 0; i < edges.size(); ++i) {
            if (kinds.kind(edges[i]) != ControlEdges::Kind::regular) {
                bits |= std::uint64_t(1) << i;
                continue;
            }
            const RegularEdge& support = kinds.regular(edges[i]);
            for (std::size_t p = 0; p < support.size(); ++p)
                lanes.set(count, p, view_.pose.shape.control_positions()[support[p]]);
            numbers[count++] = i;
            if (count == edge_lanes)
                test();
        }
        if (count > 0)
            test();
        return bits;
    }
    void cut(std::uint32_t edge, std::vector<CutPoint>& out)
    {
        const ControlEdges::Kind kind = view_.pose.shape.table().edges().kind(edge);
        if (kind == ControlEdges::Kind::creased) {
            cut_creased(edge, out);
            return;
        }
        const Crossings& found =
            kind == ControlEdges::Kind::regular ? search_.along_regular(edge, faces_eye(edge)) : search_.along(view_.topology().half_edge[edge], faces_eye(edge));
        for (const EdgeCrossing& c : found)
            out.push_back({c.t, edge, {true, true}, c.sample.position, {c.sample.normal, c.sample.normal}});
    }
    /// The contour's crossings on one side, as parameters of the half-edge.
    Crossings crossings_of(std::uint32_t h)
    {
        if (!may_be_crossed(std::array<Facing, 3>{view_.at_start(h), view_.at_middle(h), view_.at_start(next_half_edge(h))}, share_of_edges))
            return {};
        return search_.along(h, {view_.faces_eye(h), view_.faces_eye(next_half_edge(h))});
    }
    void cut_creased(std::uint32_t edge, std::vector<CutPoint>& out)
    {
        const LoopTopology& t = view_.topology();
        const std::uint32_t h = t.half_edge[edge], over = t.twin[h];
        const bool two_sides = over != none && is_sharp(t, edge);
        const Crossings crossings[2] = {crossings_of(h), two_sides ? crossings_of(over) : Crossings()};
        std::vector<CutPoint> points;
        if (is_outline(view_, edge, !crossings[0].empty() || !crossings[1].empty()))
            add_outline_points(view_, edge, make_point(view_, edge, 0), make_point(view_, edge, 1), 0, points);
        for (std::size_t side = 0; side < 2; ++side)
            for (const EdgeCrossing& crossing : crossings[side]) {
                points.push_back(make_point(view_, edge, side == 0 ? crossing.t : 1 - crossing.t));
                points.back().crossing = {side == 0 || !two_sides, side == 1 || !two_sides};
            }
        std::sort(points.begin(), points.end(), comes_before);
        append_without_repeats(points, out);
    }

    const SilhouetteView& view_;
    std::span<const VertexFacing> facing_;
    CrossingSearch search_;
};

} // namespace

EdgePoints cut_edges(const SilhouetteView& view)
{
    const std::size_t edges = view.topology().edge_count();
    const std::vector<VertexFacing> facing = facing_vertices(view);
    const std::vector<std::uint32_t> candidates = parallel_collect<std::uint32_t>(edges, test_grain, [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& out) {
        for (std::size_t e = begin; e < end; ++e)
            if (is_candidate(view, facing, std::uint32_t(e)))
                out.push_back(std::uint32_t(e));
    });
    return {edges, parallel_collect<CutPoint>(candidates.size(), search_grain, [&](std::size_t begin, std::size_t end, std::vector<CutPoint>& out) {
                EdgeCutter(view, facing).cut(std::span(candidates).subspan(begin, end - begin), out);
            })};
}

void add_edge_points(const SilhouetteView& view, std::vector<EdgePlace> places, EdgePoints& edges)
{
    std::sort(places.begin(), places.end(), [](const EdgePlace& a, const EdgePlace& b) { return a.edge != b.edge ? a.edge < b.edge : a.t < b.t; });
    places.erase(std::unique(places.begin(), places.end()), places.end());
    std::erase_if(places, [&](const EdgePlace& place) { return has_point(edges[place.edge], place.t); });
    if (places.empty())
        return;
    std::vector<CutPoint> points(places.size());
    parallel_each(points.size(), point_grain, [&](std::size_t i) { points[i] = make_point(view, places[i].edge, places[i].t); });
    edges.add(points);
}

std::vector<std::uint32_t> outline_edges(const SilhouetteView& view, const EdgePoints& edges)
{
    const LoopTopology& t = view.topology();
    const auto is_crossed = [](std::span<const CutPoint> points) { return std::any_of(points.begin(), points.end(), [](const CutPoint& p) { return p.crossing[0] || p.crossing[1]; }); };
    return parallel_collect<std::uint32_t>(edges.size(), test_grain, [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& out) {
        for (std::uint32_t e = std::uint32_t(begin); e < end; ++e)
            if (is_sharp(t, e) && is_outline(view, e, is_crossed(edges[e]))) // borders are sharp
                out.push_back(e);
    });
}

std::vector<std::uint32_t> refine_edges(const SilhouetteView& view, std::span<const std::uint32_t> which, EdgePoints& edges)
{
    const std::vector<CutPoint> points = parallel_collect<CutPoint>(which.size(), point_grain, [&](std::size_t begin, std::size_t end, std::vector<CutPoint>& out) {
        for (std::size_t i = begin; i < end; ++i)
            append_tight_points(view, which[i], edges[which[i]], out);
    });
    if (!points.empty())
        edges.add(points);
    std::vector<std::uint32_t> refined;
    for (const CutPoint& point : points)
        if (refined.empty() || refined.back() != point.edge)
            refined.push_back(point.edge);
    return refined;
}

} // namespace limn
