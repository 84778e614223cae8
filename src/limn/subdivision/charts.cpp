#include "limn/subdivision/charts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "limn/base/parallel.h"

namespace limn {
namespace {

using Triangle = std::array<dvec2, 3>;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

/// The triangle with corner `first` at the origin and the next one on the x axis. Isometric; the third corner has y >= 0.
Triangle flat_triangle(const uvec3& face, std::span<const dvec3> positions, int first)
{
    const dvec3 &a = positions[face[first]], &b = positions[face[(first + 1) % 3]], &c = positions[face[(first + 2) % 3]];
    const double length = glm::distance(a, b);
    const dvec3 along = length > 0 ? (b - a) / length : dvec3(0);
    Triangle flat;
    flat[std::size_t(first)] = dvec2(0);
    flat[std::size_t((first + 1) % 3)] = {length, 0};
    flat[std::size_t((first + 2) % 3)] = {glm::dot(c - a, along), glm::length(glm::cross(along, c - a))};
    return flat;
}

int longest_side(const uvec3& face, std::span<const dvec3> positions)
{
    int longest = 0;
    double most = -1;
    for (int k = 0; k < 3; ++k)
        if (const double length = glm::distance(positions[face[k]], positions[face[(k + 1) % 3]]); length > most) {
            most = length;
            longest = k;
        }
    return longest;
}

/// Moves a chart's box to the origin and measures it.
void settle(Chart& chart)
{
    dvec2 low = chart.corners[0][0], high = low;
    for (int f = 0; f < chart.face_count(); ++f)
        for (const dvec2& p : chart.corners[f]) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    for (int f = 0; f < chart.face_count(); ++f)
        for (dvec2& p : chart.corners[f])
            p -= low;
    chart.size = high - low;
}

Chart single_chart(const LoopTopology& t, std::span<const dvec3> positions, std::uint32_t face)
{
    Chart chart;
    chart.faces[0] = face;
    const Triangle flat = flat_triangle(t.triangles[face], positions, longest_side(t.triangles[face], positions));
    std::copy(flat.begin(), flat.end(), chart.corners[0]);
    settle(chart);
    return chart;
}

/// A chart turned so that a direction of it runs along the x axis; lying if that is wider than high.
Chart turned(Chart chart, const dvec2& direction)
{
    const dvec2 x = glm::normalize(direction);
    for (int f = 0; f < chart.face_count(); ++f)
        for (dvec2& p : chart.corners[f])
            p = {glm::dot(x, p), cross(x, p)};
    settle(chart);
    if (chart.size.y > chart.size.x) {
        for (int f = 0; f < chart.face_count(); ++f)
            for (dvec2& p : chart.corners[f])
                p = {-p.y, p.x};
        settle(chart);
    }
    return chart;
}

/// The two faces at an edge, unfolded, in the smallest box that has one of their outer sides, or the line between the outer corners, along a
/// side: one of these is the smallest of all (Freeman and Shapira 1975).
Chart paired_chart(const LoopTopology& t, std::span<const dvec3> positions, std::uint32_t edge)
{
    const std::uint32_t h = t.half_edge[edge], over = t.twin[h];
    const Triangle here = flat_triangle(t.triangles[h / 3], positions, int(h % 3)), there = flat_triangle(t.triangles[over / 3], positions, int(over % 3));
    Chart chart;
    chart.faces[0] = h / 3;
    chart.faces[1] = over / 3;
    const double length = here[(h % 3 + 1) % 3].x;
    for (std::size_t k = 0; k < 3; ++k) {
        chart.corners[0][k] = here[k];
        chart.corners[1][k] = dvec2(length, 0) - there[k]; // turned half round: the edge runs the other way there
    }
    if (chart.faces[1] < chart.faces[0]) {
        std::swap(chart.faces[0], chart.faces[1]);
        std::swap(chart.corners[0], chart.corners[1]);
    }
    const dvec2 tips[2] = {here[(h % 3 + 2) % 3], dvec2(length, 0) - there[(over % 3 + 2) % 3]};
    const dvec2 ends[2] = {dvec2(0), dvec2(length, 0)};
    const dvec2 directions[] = {tips[0] - ends[0], tips[0] - ends[1], tips[1] - ends[0], tips[1] - ends[1], ends[1] - ends[0], tips[1] - tips[0]};
    Chart best;
    for (const dvec2& direction : directions) {
        if (!(glm::dot(direction, direction) > 0))
            continue;
        const Chart candidate = turned(chart, direction);
        if (best.faces[0] == none || candidate.size.x * candidate.size.y < best.size.x * best.size.y)
            best = candidate;
    }
    return best;
}

struct Candidate {
    double fill;
    std::uint32_t edge;
};

/// The edges that faces may be paired across, the best first.
std::vector<Candidate> pair_candidates(const LoopTopology& t, std::span<const dvec3> positions)
{
    std::vector<Candidate> candidates = parallel_collect<Candidate>(t.edge_count(), 1024, [&](std::size_t begin, std::size_t end, std::vector<Candidate>& out) {
        for (std::uint32_t e = std::uint32_t(begin); e < end; ++e) {
            if (t.is_border(e) || t.sharpness[e] > 0 || t.half_edge[e] / 3 == t.twin[t.half_edge[e]] / 3)
                continue;
            const Chart chart = paired_chart(t, positions, e);
            const double box = chart.size.x * chart.size.y;
            if (chart.area() > box / 2) // else two charts of their own are as good
                out.push_back({chart.area() / box, e});
        }
    });
    std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.fill > b.fill; });
    return candidates;
}

} // namespace

double Chart::area() const
{
    double sum = 0;
    for (int f = 0; f < face_count(); ++f)
        sum += cross(corners[f][1] - corners[f][0], corners[f][2] - corners[f][0]) / 2;
    return sum;
}

std::vector<Chart> make_charts(const LoopTopology& t, std::span<const dvec3> positions, ChartKind kind)
{
    const std::size_t faces = t.triangles.size();
    std::vector<std::uint32_t> paired_across(faces, none);
    if (kind == ChartKind::pairs)
        for (const Candidate& candidate : pair_candidates(t, positions)) {
            const std::uint32_t a = t.half_edge[candidate.edge] / 3, b = t.twin[t.half_edge[candidate.edge]] / 3;
            if (paired_across[a] == none && paired_across[b] == none)
                paired_across[a] = paired_across[b] = candidate.edge;
        }
    return parallel_collect<Chart>(faces, 1024, [&](std::size_t begin, std::size_t end, std::vector<Chart>& out) {
        for (std::uint32_t f = std::uint32_t(begin); f < end; ++f) {
            if (paired_across[f] == none)
                out.push_back(single_chart(t, positions, f));
            else if (Chart chart = paired_chart(t, positions, paired_across[f]); chart.faces[0] == f)
                out.push_back(chart);
        }
    });
}

} // namespace limn
