#include "limn/subdivision/edge_points.h"

#include <algorithm>

namespace limn {

bool has_point(std::span<const CutPoint> points, double t)
{
    return std::any_of(points.begin(), points.end(), [t](const CutPoint& p) { return p.t == t; });
}

EdgePoints::EdgePoints(std::size_t edges, std::vector<CutPoint> points) : edges_(edges), points_(std::move(points)), words_((edges + 63) / 64 + 1) { count(); }

std::span<const CutPoint> EdgePoints::operator[](std::uint32_t edge) const
{
    if (!has_points(edge))
        return {};
    const Word* word = &words_[edge / 64];
    const CutPoint *first = points_.data() + word[0].first, *behind = points_.data() + word[1].first;
    first = std::lower_bound(first, behind, edge, [](const CutPoint& p, std::uint32_t e) { return p.edge < e; });
    const CutPoint* last = first;
    while (last != behind && last->edge == edge)
        ++last;
    return {first, last};
}

void EdgePoints::add(const std::vector<CutPoint>& points)
{
    std::vector<CutPoint> merged(points_.size() + points.size());
    std::merge(points_.begin(), points_.end(), points.begin(), points.end(), merged.begin(), comes_before);
    points_ = std::move(merged);
    count();
}

void EdgePoints::count()
{
    std::fill(words_.begin(), words_.end(), Word());
    for (const CutPoint& p : points_) {
        words_[p.edge / 64].marked |= std::uint64_t(1) << p.edge % 64;
        ++words_[p.edge / 64 + 1].first;
    }
    for (std::size_t w = 1; w < words_.size(); ++w)
        words_[w].first += words_[w - 1].first;
}

} // namespace limn
