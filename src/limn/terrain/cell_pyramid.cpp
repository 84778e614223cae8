#include "limn/terrain/cell_pyramid.h"

#include <algorithm>
#include <cmath>

#include "limn/base/parallel.h"

namespace limn {
namespace {

constexpr float nothing = std::numeric_limits<float>::infinity();
constexpr double widest = 4; ///< a box is at most so many squares wide

float rounded_up(double value)
{
    const float near = float(value);
    return double(near) < value ? std::nextafter(near, nothing) : near;
}

/// No bounds where there is no surface.
CellBounds bounds_of(const HeightPatch& patch)
{
    if (std::isnan(patch.b[0][0]) || std::isnan(patch.b[1][1]))
        return {};
    return {rounded_up(patch.bend()), -rounded_up(-patch.low()), rounded_up(patch.high())};
}

} // namespace

CellPyramid::CellPyramid(const HeightSurface& surface)
{
    ivec2 size(surface.map().columns - 1, surface.map().rows - 1);
    Level finest = {size, std::vector<CellBounds>(std::size_t(size.x) * std::size_t(size.y))};
    parallel_each(std::size_t(size.y), 1, [&](std::size_t y) {
        for (int x = 0; x < size.x; ++x)
            finest.cells[y * std::size_t(size.x) + std::size_t(x)] = bounds_of(surface.patch({x, int(y)}));
    });
    levels_.push_back(std::move(finest));
    while (size.x > 1 || size.y > 1) {
        const Level& finer = levels_.back();
        size = (size + 1) / 2;
        Level coarser = {size, std::vector<CellBounds>(std::size_t(size.x) * std::size_t(size.y))};
        parallel_each(std::size_t(finer.size.y + 1) / 2, 64, [&](std::size_t y) {
            for (int j = int(2 * y); j < std::min(int(2 * y) + 2, finer.size.y); ++j)
                for (int i = 0; i < finer.size.x; ++i)
                    coarser.cells[y * std::size_t(size.x) + std::size_t(i / 2)].add(finer.cells[std::size_t(j) * std::size_t(finer.size.x) + std::size_t(i)]);
        });
        levels_.push_back(std::move(coarser));
    }
}

CellBounds CellPyramid::over(const dvec2& low, const dvec2& high) const
{
    const double wide = std::max(high.x - low.x, high.y - low.y);
    std::size_t k = 0;
    while (k + 1 < levels_.size() && wide > widest * double(1 << k))
        ++k;
    const Level& level = levels_[k];
    const double square = double(1 << k);
    // Squares with some of their inside in the box.
    const auto first = [&](double from, int size) { return int(std::clamp(std::floor(from / square), 0.0, double(size))); };
    const auto end = [&](double to, int size) { return int(std::clamp(std::ceil(to / square), 0.0, double(size))); };
    CellBounds all;
    for (int y = first(low.y, level.size.y); y < end(high.y, level.size.y); ++y)
        for (int x = first(low.x, level.size.x); x < end(high.x, level.size.x); ++x)
            all.add(level.cells[std::size_t(y) * std::size_t(level.size.x) + std::size_t(x)]);
    return all;
}

} // namespace limn
