#include "limn/terrain/lattice.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

void check_size(int columns, int rows)
{
    if (columns < 2 || rows < 2)
        throw Error::Input(fmt::format("a height map of {} x {} samples has no area; it needs 2 x 2", columns, rows));
}

ivec2 roots_for(int columns, int rows, int level)
{
    const auto roots = [&](int samples) { return int(((std::int64_t(samples) - 1) + (std::int64_t(1) << level) - 1) >> level); };
    return {roots(columns), roots(rows)};
}

/// Where an edge of the lattice crosses the last column (axis 0) or row (axis 1): a lattice point, since edges are horizontal, vertical or diagonal.
ivec2 crossing(const ivec2& p, const ivec2& q, int axis, int last)
{
    const int other = 1 - axis, steps = last - p[axis], along = q[axis] - p[axis];
    ivec2 out;
    out[axis] = last;
    out[other] = p[other] + (q[other] - p[other]) / std::abs(along) * std::abs(steps);
    return out;
}

ClippedTriangle clip(const ClippedTriangle& in, int axis, int last)
{
    ClippedTriangle out;
    for (int i = 0; i < in.count; ++i) {
        const ivec2 &p = in.corners[i], &q = in.corners[(i + 1) % in.count];
        if (p[axis] <= last)
            out.corners[out.count++] = p;
        if ((p[axis] < last && q[axis] > last) || (p[axis] > last && q[axis] < last))
            out.corners[out.count++] = crossing(p, q, axis, last);
    }
    return out;
}

} // namespace

bool Lattice::is_inside_in_part(const BisectionTriangle& t) const
{
    const ivec2 low = glm::min(t.apex, glm::min(t.a, t.b));
    if (low.x >= columns - 1 || low.y >= rows - 1)
        return false;
    return !is_outside_in_part(t) || clip_to_map(*this, t).count >= 3;
}

bool Lattice::is_outside_in_part(const BisectionTriangle& t) const
{
    const ivec2 high = glm::max(t.apex, glm::max(t.a, t.b));
    return high.x >= columns || high.y >= rows;
}

Lattice make_lattice(int columns, int rows, int level)
{
    check_size(columns, rows);
    if (level < 0 || level > 30)
        throw Error::Input(fmt::format("root squares of 2^{} cells: 0 to 30 can be", level));
    return {columns, rows, level, roots_for(columns, rows, level)};
}

Lattice make_lattice(int columns, int rows)
{
    constexpr double most_waste = 1.3;
    check_size(columns, rows);
    const double area = double(columns - 1) * double(rows - 1);
    for (int level = 15; level > 0; --level) {
        const dvec2 covered = dvec2(roots_for(columns, rows, level)) * double(1 << level);
        if (covered.x * covered.y <= most_waste * area)
            return make_lattice(columns, rows, level);
    }
    return make_lattice(columns, rows, 0);
}

std::vector<BisectionTriangle> root_triangles(const Lattice& lattice, Diagonals diagonals)
{
    std::vector<BisectionTriangle> out;
    const int s = lattice.root_cells();
    for (int row = 0; row < lattice.roots.y; ++row)
        for (int column = 0; column < lattice.roots.x; ++column) {
            const ivec2 nw = ivec2(column, row) * s, ne = nw + ivec2(s, 0), sw = nw + ivec2(0, s), se = nw + ivec2(s, s);
            if (diagonals == Diagonals::alternating && (row + column) % 2 == 1) {
                out.push_back({nw, sw, ne});
                out.push_back({se, ne, sw});
            } else {
                out.push_back({ne, nw, se});
                out.push_back({sw, se, nw});
            }
        }
    return out;
}

ClippedTriangle clip_to_map(const Lattice& lattice, const BisectionTriangle& triangle)
{
    const ClippedTriangle whole = {{triangle.apex, triangle.a, triangle.b}, 3};
    ClippedTriangle part = clip(clip(whole, 0, lattice.columns - 1), 1, lattice.rows - 1);
    const auto area2 = [&] {
        std::int64_t sum = 0;
        for (int i = 0; i < part.count; ++i) {
            const ivec2 &p = part.corners[i], &q = part.corners[(i + 1) % part.count];
            sum += std::int64_t(p.x) * q.y - std::int64_t(p.y) * q.x;
        }
        return sum;
    };
    if (part.count < 3 || area2() == 0)
        part.count = 0;
    // Whichever way its corners were named, a polygon begins at the same one: both triangles of an edge test and draw the same fans.
    const auto before = [](const ivec2& p, const ivec2& q) { return std::pair(p.y, p.x) < std::pair(q.y, q.x); };
    std::rotate(part.corners, std::min_element(part.corners, part.corners + part.count, before), part.corners + part.count);
    return part;
}

} // namespace limn
