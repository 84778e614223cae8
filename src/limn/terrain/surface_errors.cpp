#include "limn/terrain/surface_errors.h"

#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

constexpr std::int64_t most_base_samples = 20'000'000;
constexpr int most_levels = 12, most_base = 2;
constexpr std::int64_t furthest = 1 << 29; // coordinates of a lattice

float rounded_up(double value)
{
    const float near = float(value);
    return double(near) < value ? std::nextafter(near, std::numeric_limits<float>::infinity()) : near;
}

/// How much finer the lattice is that errors are kept for.
int base_levels(const HeightMap& map, int levels)
{
    int base = 0;
    while (base < std::min(levels, most_base) && (std::int64_t(map.columns) << (base + 1)) * (std::int64_t(map.rows) << (base + 1)) <= most_base_samples)
        ++base;
    return base;
}

/// The lattice of the map's hierarchy, so much finer.
Lattice finer_lattice(const HeightMap& map, int levels)
{
    const int level = make_lattice(map.columns, map.rows).level + levels;
    return make_lattice(((map.columns - 1) << levels) + 1, ((map.rows - 1) << levels) + 1, level);
}

HeightMap frame_of(const HeightMap& map, int levels)
{
    HeightMap frame;
    frame.columns = ((map.columns - 1) << levels) + 1, frame.rows = ((map.rows - 1) << levels) + 1;
    frame.spacing = map.spacing / double(1 << levels);
    frame.origin = map.origin, frame.system = map.system;
    return frame;
}

int checked(const HeightMap& map, int levels)
{
    if (levels < 0 || levels > 16 || (std::int64_t(std::max(map.columns, map.rows)) << levels) > furthest)
        throw Error::Input(fmt::format("a lattice 2^{} finer than {} x {} samples is too fine", levels, map.columns, map.rows));
    return levels;
}

} // namespace

SurfaceErrors::SurfaceErrors(const HeightSurface& surface, int levels)
    : surface_(surface), levels_(checked(surface.map(), levels)), base_(base_levels(surface.map(), levels)), frame_(frame_of(surface.map(), levels)),
      base_map_(resampled(surface, base_)), lattice_(finer_lattice(surface.map(), levels)), nested_(nest_errors(base_map_, finer_lattice(surface.map(), base_))), cells_(surface)
{
    const CellBounds whole = cells_.whole();
    if (base_ > 0 && whole.low <= whole.high) // corners and samples are off by half a unit in the last place each
        rounding_ = 2 * 0x1p-24 * double(std::max(std::abs(whole.low), std::abs(whole.high)));
}

PointBounds SurfaceErrors::bounds(const BisectionTriangle& t) const
{
    const ivec2 p = t.middle(), along = glm::abs(t.b - t.a);
    const int half = std::max(along.x, along.y) / 2;
    const double cell = 1.0 / (1 << levels_), reach = reach_of_point(half, along.x == along.y);
    const CellBounds cells = cells_.over((dvec2(p) - reach) * cell, (dvec2(p) + reach) * cell);
    if (!is_of_base(p)) {
        const double size = 2 * half * cell;
        return {rounded_up(double(cells.bend) * size * size), cells.low, cells.high};
    }
    const double size = base_step() * cell, sampled = double(nested_.error(p / base_step()));
    return {rounded_up(sampled + double(cells.bend) * size * size + rounding_), cells.low, cells.high};
}

bool SurfaceErrors::has_data(const ivec2& p) const
{
    if (!is_of_base(p))
        return true;
    const ivec2 q = p / base_step();
    return base_map_.contains(q.x, q.y) && base_map_.has_data(q.x, q.y);
}

bool SurfaceErrors::is_on_surface(const BisectionTriangle& t) const
{
    const ivec2 along = glm::abs(t.b - t.a);
    if (std::max(along.x, along.y) > base_step())
        return true; // in part, maybe
    return has_data(t.apex) && has_data(t.a) && has_data(t.b);
}

int levels_for(const HeightSurface& surface, double tolerance)
{
    const HeightMap& map = surface.map();
    const double bend = double(CellPyramid(surface).whole().bend);
    int levels = 0;
    while (levels < most_levels && !(std::ldexp(bend, -2 * levels) <= tolerance) && (std::int64_t(std::max(map.columns, map.rows)) << (levels + 1)) <= furthest)
        ++levels;
    return levels;
}

} // namespace limn
