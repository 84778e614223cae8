#include "limn/terrain/coarse_errors.h"

#include <algorithm>

#include "limn/base/parallel.h"

namespace limn {

CoarseErrors::CoarseErrors(const Lattice& lattice, int first, std::function<float(const ivec2&)> height)
    : lattice_(lattice), first_(first), height_(std::move(height)), before_(std::size_t(std::max(0, lattice.level - first)) + 1)
{
    const ivec2 cells = lattice.points() - 1;
    for (int power = first; power < lattice.level; ++power) {
        const ivec2 points = cells / (1 << power) + 1;
        before_[std::size_t(power - first) + 1] = before_[std::size_t(power - first)] + std::size_t(points.x) * std::size_t(points.y);
    }
    of_slot_.resize(before_.back());
    for (int power = lattice.level - 1; power >= first; --power) {
        const int s = 2 << power;
        const auto add_point = [&](const SplitPoint& point) {
            for (int i = 0; i < point.count; ++i) {
                const BisectionTriangle t = point.triangle(i);
                const bool is_cut = lattice_.is_outside_in_part(t);
                if (is_cut && !lattice_.is_inside_in_part(t))
                    continue;
                const CornerHeights corners =
                    is_cut ? CornerHeights{} : CornerHeights{double(height_(t.apex)), double(height_(t.a)), double(height_(t.b))};
                of_slot_[slot(power, point.middle())].push_back(triangles_.size());
                triangles_.push_back({t, corners, is_cut, {}});
            }
        };
        const ivec2 squares = cells / s;
        for (int j = 0; j <= squares.y; ++j)
            for (int i = 0; i <= squares.x; ++i) {
                if (i < squares.x)
                    add_point(split_point_on_row(lattice, i * s, j * s, s));
                if (j < squares.y)
                    add_point(split_point_on_column(lattice, i * s, j * s, s));
                if (i < squares.x && j < squares.y)
                    add_point(split_point_in_square(lattice, i, j, s));
            }
    }
}

std::size_t CoarseErrors::slot(int power, const ivec2& middle) const
{
    const std::size_t columns = std::size_t((lattice_.points().x - 1) >> power) + 1;
    return before_[std::size_t(power - first_)] + std::size_t(middle.y >> power) * columns + std::size_t(middle.x >> power);
}

void CoarseErrors::add(const HeightWindow& window)
{
    parallel_each(triangles_.size(), 1, [&](std::size_t i) {
        Triangle& triangle = triangles_[i];
        const BisectionTriangle& t = triangle.t;
        const int top = std::min({t.apex.y, t.a.y, t.b.y}), bottom = std::max({t.apex.y, t.a.y, t.b.y});
        if (top >= window.end.y || bottom < window.first.y)
            return;
        if (triangle.is_cut)
            scan_triangle(
                window, lattice_, t, [&](const ivec2& p) { return double(height_(p)); }, triangle.found);
        else
            triangle.found.add(error_off_legs(window, t, triangle.corners));
    });
}

double CoarseErrors::error(int power, const ivec2& middle) const
{
    double worst = 0;
    for (const std::size_t i : of_slot_[slot(power, middle)])
        worst = std::max(worst, triangles_[i].found.error());
    return worst;
}

} // namespace limn
