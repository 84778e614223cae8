#include "limn/subdivision/silhouette_edges.h"

#include <algorithm>

#include "limn/base/parallel.h"
#include "limn/subdivision/contour_crossings.h"

namespace limn {
namespace {

constexpr std::size_t grain = 256;

/// Whether the limit surface has a fold there; semi-sharp edges become smooth.
bool is_sharp(const LoopTopology& t, std::uint32_t edge) { return t.sharpness[edge] >= infinitely_sharp; }

CutPoint make_point(const SilhouetteView& view, std::uint32_t edge, double t)
{
    const LoopTopology& topology = view.topology();
    const std::uint32_t h = topology.half_edge[edge], over = topology.twin[h];
    const SurfaceSample sample = view.pose.shape.sample(on_half_edge(h, t));
    CutPoint point{t, {false, false}, sample.position, {sample.normal, sample.normal}};
    if (over != none && is_sharp(topology, edge))
        point.normals[1] = view.pose.shape.normal(on_half_edge(over, 1 - t));
    return point;
}

/// The contour's crossings on one side, as parameters of the half-edge.
std::vector<double> crossings_of(const SilhouetteView& view, std::uint32_t h)
{
    std::vector<double> crossings;
    if (may_be_crossed(std::array<Facing, 3>{view.at_start(h), view.at_middle(h), view.at_start(next_half_edge(h))}, share_of_edges))
        append_crossings(view.pose.shape, view.eye, h, {view.faces_eye(h), view.faces_eye(next_half_edge(h))}, crossings);
    return crossings;
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

/// Whether the eye sees a border or a sharp edge from one side only, somewhere.
bool is_outline(const SilhouetteView& view, std::uint32_t edge, const std::vector<double> (&crossings)[2])
{
    const LoopTopology& t = view.topology();
    const std::uint32_t h = t.half_edge[edge], over = t.twin[h];
    if (over == none)
        return true;
    return is_sharp(t, edge) && (!crossings[0].empty() || !crossings[1].empty() || view.faces_eye(h) != view.faces_eye(next_half_edge(over)));
}

/// Points that are as good as the same become one.
std::vector<CutPoint> without_repeats(std::vector<CutPoint> points)
{
    constexpr double same = 1e-9;
    std::vector<CutPoint> out;
    for (const CutPoint& p : points) {
        const bool repeated = !out.empty() && p.t - out.back().t < same && !(p.crossing[0] && out.back().crossing[0]) && !(p.crossing[1] && out.back().crossing[1]);
        if (!repeated) {
            out.push_back(p);
            continue;
        }
        for (std::size_t side = 0; side < 2; ++side)
            out.back().crossing[side] = out.back().crossing[side] || p.crossing[side];
    }
    return out;
}

std::vector<CutPoint> cut_edge(const SilhouetteView& view, std::uint32_t edge)
{
    const LoopTopology& t = view.topology();
    const std::uint32_t h = t.half_edge[edge], over = t.twin[h];
    const bool two_sides = over != none && is_sharp(t, edge);
    std::vector<double> crossings[2] = {crossings_of(view, h), two_sides ? crossings_of(view, over) : std::vector<double>()};
    std::vector<CutPoint> points;
    if (is_outline(view, edge, crossings))
        add_outline_points(view, edge, make_point(view, edge, 0), make_point(view, edge, 1), 0, points);
    for (std::size_t side = 0; side < 2; ++side)
        for (const double crossing : crossings[side]) {
            points.push_back(make_point(view, edge, side == 0 ? crossing : 1 - crossing));
            points.back().crossing = {side == 0 || !two_sides, side == 1 || !two_sides};
        }
    std::sort(points.begin(), points.end(), [](const CutPoint& a, const CutPoint& b) { return a.t < b.t; });
    return without_repeats(std::move(points));
}

} // namespace

bool is_outline(const SilhouetteView& view, std::uint32_t edge, const std::vector<CutPoint>& points)
{
    const LoopTopology& t = view.topology();
    const std::uint32_t h = t.half_edge[edge], over = t.twin[h];
    if (over == none)
        return true;
    return is_sharp(t, edge)
           && (view.faces_eye(h) != view.faces_eye(next_half_edge(over))
               || std::any_of(points.begin(), points.end(), [](const CutPoint& p) { return p.crossing[0] || p.crossing[1]; }));
}

bool refine_edge(const SilhouetteView& view, std::uint32_t edge, std::vector<CutPoint>& points)
{
    const std::size_t before = points.size();
    std::vector<CutPoint> ends = {make_point(view, edge, 0)}, refined;
    ends.insert(ends.end(), points.begin(), points.end());
    ends.push_back(make_point(view, edge, 1));
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        if (i > 0)
            refined.push_back(ends[i]);
        if (view.pixels_along(ends[i].position, ends[i + 1].position) < view.pixels)
            add_outline_points(view, edge, ends[i], ends[i + 1], 0, refined);
    }
    points = std::move(refined);
    return points.size() > before;
}

EdgePoints cut_edges(const SilhouetteView& view)
{
    EdgePoints edges(view.topology().edge_count());
    parallel_each(edges.size(), grain, [&](std::size_t e) { edges[e] = cut_edge(view, std::uint32_t(e)); });
    return edges;
}

bool add_edge_point(const SilhouetteView& view, std::uint32_t edge, double t, std::vector<CutPoint>& points)
{
    const auto at = std::lower_bound(points.begin(), points.end(), t, [](const CutPoint& p, double value) { return p.t < value; });
    if (at != points.end() && at->t == t)
        return false;
    points.insert(at, make_point(view, edge, t));
    return true;
}

} // namespace limn
