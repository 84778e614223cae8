#include "limn/lines/crossings.h"

#include <algorithm>
#include <numeric>

namespace limn {
namespace {

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

bool shares_an_end(const Segment& s, const Occluder& o)
{
    const auto is_end = [&](std::uint32_t id) { return id != none && (id == o.id_a || id == o.id_b); };
    return is_end(s.edge_a) || is_end(s.edge_b);
}

/// Parameters on both pieces of their crossing in the picture; false where they do not cross.
bool cross_in_picture(const dvec2& a, const dvec2& b, const dvec2& c, const dvec2& d, double& t, double& s)
{
    const dvec2 ab = b - a, cd = d - c, ac = c - a;
    const double area = cross(ab, cd);
    if (area == 0)
        return false;
    t = cross(ac, cd) / area;
    s = cross(ac, ab) / area;
    return t > 0 && t < 1 && s >= 0 && s <= 1;
}

} // namespace

OccluderGrid::OccluderGrid(std::vector<Occluder> occluders, const Camera& camera) : occluders_(std::move(occluders))
{
    // Only what lies in the picture matters, give or take a border: lines end there.
    low_ = -0.1 * dvec2(camera.size);
    const dvec2 extent = 1.2 * dvec2(camera.size);
    double length = 0;
    for (const Occluder& o : occluders_)
        length += std::min(glm::distance(dvec2(o.a), dvec2(o.b)), extent.x);
    const double mean = occluders_.empty() ? 1 : length / double(occluders_.size());
    cell_ = std::max(2 * mean, std::max(extent.x, extent.y) / 512);
    cells_ = ivec2(glm::ceil(extent / cell_)) + 1;
    start_.assign(std::size_t(cells_.x) * std::size_t(cells_.y) + 1, 0);
    const auto each = [&](auto&& f) {
        for (std::uint32_t i = 0; i < occluders_.size(); ++i)
            for_cells(occluders_[i].a, occluders_[i].b, [&](std::size_t cell) { f(cell, i); });
    };
    each([&](std::size_t cell, std::uint32_t) { ++start_[cell]; });
    std::exclusive_scan(start_.begin(), start_.end(), start_.begin(), 0u);
    item_.resize(start_.back());
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    each([&](std::size_t cell, std::uint32_t i) { item_[next[cell]++] = i; });
}

/// The cells of the rows that a piece crosses, each row from the piece's lowest to its highest column in it.
template <class F> void OccluderGrid::for_cells(const dvec3& a, const dvec3& b, F&& f) const
{
    dvec2 p = (dvec2(a) - low_) / cell_, q = (dvec2(b) - low_) / cell_;
    if (p.y > q.y)
        std::swap(p, q);
    if (!(q.y >= 0 && p.y < cells_.y && std::max(p.x, q.x) >= 0 && std::min(p.x, q.x) < cells_.x))
        return;
    const double slope = q.y > p.y ? (q.x - p.x) / (q.y - p.y) : 0;
    const int first = int(std::max(p.y, 0.0)), last = int(std::min(q.y, cells_.y - 1.0));
    for (int row = first; row <= last; ++row) {
        double x0 = p.x, x1 = q.x;
        if (first != last) {
            x0 = p.x + slope * (std::clamp(double(row), p.y, q.y) - p.y);
            x1 = p.x + slope * (std::clamp(row + 1.0, p.y, q.y) - p.y);
        }
        if (x0 > x1)
            std::swap(x0, x1);
        // A hair more than the exact columns, so that rounding loses no cell.
        const int left = int(std::clamp(x0 - 1e-6, 0.0, cells_.x - 1.0)), right = int(std::clamp(x1 + 1e-6, 0.0, cells_.x - 1.0));
        for (int column = left; column <= right; ++column)
            f(std::size_t(row) * std::size_t(cells_.x) + std::size_t(column));
    }
}

void OccluderGrid::find(std::uint32_t index, const Segment& segment, const dvec3& a, const dvec3& b, const Projector& projector,
                        std::vector<Cut>& cuts) const
{
    const std::size_t before = cuts.size();
    std::vector<std::uint32_t> met; // occluders already found in another cell; almost always empty
    for_cells(a, b, [&](std::size_t cell) {
        for (std::uint32_t k = start_[cell]; k < start_[cell + 1]; ++k) {
            const Occluder& o = occluders_[item_[k]];
            double t, s;
            if (!cross_in_picture(dvec2(a), dvec2(b), dvec2(o.a), dvec2(o.b), t, s) || shares_an_end(segment, o))
                continue;
            const double own = projector.space_parameter(t, a.z, b.z), other = projector.space_parameter(s, o.a.z, o.b.z);
            const bool behind = glm::mix(a.z, b.z, own) > glm::mix(o.a.z, o.b.z, other);
            if (!behind || std::find(met.begin(), met.end(), item_[k]) != met.end())
                continue;
            met.push_back(item_[k]);
            const bool leaves = glm::dot(dvec2(b) - dvec2(a), o.outward) > 0;
            cuts.push_back({index, float(own), !leaves, leaves});
        }
    });
    std::sort(cuts.begin() + std::ptrdiff_t(before), cuts.end(), [](const Cut& x, const Cut& y) { return x.t < y.t; });
}

} // namespace limn
