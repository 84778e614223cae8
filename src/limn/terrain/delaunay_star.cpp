#include "limn/terrain/delaunay_star.h"

#include <algorithm>
#include <cmath>

namespace limn {
namespace {

/// Of a part of the ring that has not been looked at, and of one that no triangles fill.
constexpr std::uint8_t unknown = 255, impossible = 254;

} // namespace

void StarFilling::load(std::uint32_t vertex, const DelaunayTriangulation::Star& star)
{
    const auto height = [&](const ivec2& p) { return double(map_.height(p.x, p.y)); };
    const ivec2& at = mesh_.point(vertex);
    vertex_height_ = height(at);
    size_ = star.ring.size();
    for (std::size_t i = 0; i < size_; ++i) {
        points_[i] = mesh_.point(star.ring[i]);
        heights_[i] = height(points_[i]);
        std::fill_n(middles_[i], size_, unknown);
        for (std::size_t j = 0; j < i; ++j)
            areas_[j][i] = DelaunayTriangulation::area2(points_[j], points_[i], at), areas_[i][j] = -areas_[j][i];
    }
}

/// Whether a triangle has the vertex to remove in it, or on its border, and that one is near enough. One triangle of each filling has to, and
/// this is quick to say: most vertices stay because none does.
bool StarFilling::keeps_vertex(std::size_t i, std::size_t m, std::size_t j) const
{
    const std::int64_t of_j = areas_[i][m], of_i = areas_[m][j], of_m = areas_[j][i];
    if (of_i < 0 || of_m < 0 || of_j < 0)
        return false;
    const double area = double(of_i + of_m + of_j),
                 height = (double(of_i) * heights_[i] + double(of_m) * heights_[m] + double(of_j) * heights_[j]) / area;
    return std::abs(height - vertex_height_) <= bound_.tolerance;
}

/// By whether the corner m, of all between i and j, has a circle through i, m, j free of the others.
std::size_t StarFilling::delaunay_middle(std::size_t i, std::size_t j) const
{
    std::size_t best = size_;
    for (std::size_t m = after(i); m != j; m = after(m))
        if (DelaunayTriangulation::area2(points_[i], points_[m], points_[j]) > 0 &&
            (best == size_ || mesh_.is_in_circle(points_[j], points_[i], points_[best], points_[m])))
            best = m;
    return best;
}

bool StarFilling::can_cut_at(std::size_t i, std::size_t m, std::size_t j)
{
    return bound_.holds(map_, points_[i], points_[m], points_[j]) && can_cut(i, m) && can_cut(m, j);
}

/// Whether triangles fill the part of the ring between its edges from i to j and the line from j to i. Since all are counter-clockwise, as the
/// part is, they cannot overlap.
bool StarFilling::can_cut(std::size_t i, std::size_t j)
{
    if (after(i) == j)
        return true;
    std::uint8_t& middle = middles_[i][j];
    if (middle != unknown)
        return middle != impossible;
    const std::size_t first = delaunay_middle(i, j);
    std::uint8_t found = impossible;
    if (first != size_ && can_cut_at(i, first, j))
        found = std::uint8_t(first);
    for (std::size_t m = after(i); m != j && found == impossible; m = after(m))
        if (m != first && can_cut_at(i, m, j))
            found = std::uint8_t(m);
    middle = found;
    return found != impossible;
}

void StarFilling::collect(std::size_t i, std::size_t j)
{
    if (after(i) == j)
        return;
    const std::uint8_t m = middles_[i][j];
    triangles_.push_back({std::uint8_t(i), m, std::uint8_t(j)});
    collect(i, m);
    collect(m, j);
}

bool StarFilling::find(std::uint32_t vertex, const DelaunayTriangulation::Star& star)
{
    if (star.ring.size() > most_neighbours)
        return false;
    load(vertex, star);
    for (std::size_t i = 0; i + 2 < size_; ++i)
        for (std::size_t m = i + 1; m + 1 < size_; ++m) {
            if (areas_[i][m] < 0)
                continue;
            for (std::size_t j = m + 1; j < size_; ++j)
                if (keeps_vertex(i, m, j) && can_cut_at(i, m, j) && can_cut(j, i)) {
                    triangles_.assign({{std::uint8_t(i), std::uint8_t(m), std::uint8_t(j)}});
                    collect(i, m);
                    collect(m, j);
                    collect(j, i);
                    return true;
                }
        }
    return false;
}

} // namespace limn
