#include "limn/terrain/height_surface.h"

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/terrain/fill_no_data.h"

namespace limn {
namespace {

const double no_height = std::nan("");

/// Height, slopes and twist at a sample, in steps along columns (u) and rows (v).
struct SampleJet {
    double h, u, v, uv;
};

/// Means of the one-sided differences that there are: central differences where both neighbours have data.
class SlopeRule {
public:
    explicit SlopeRule(const HeightMap& map) : map_(map) {}
    SampleJet at(const ivec2& p) const
    {
        const double h = height(p);
        Mean u, v, uv;
        for (const int side : {-1, 1}) {
            u.add(side * (height(p + ivec2(side, 0)) - h));
            v.add(side * (height(p + ivec2(0, side)) - h));
            for (const int other : {-1, 1})
                uv.add(side * other * (height(p + ivec2(side, other)) - height(p + ivec2(side, 0)) - height(p + ivec2(0, other)) + h));
        }
        return {h, u.get(), v.get(), uv.get()};
    }

private:
    struct Mean {
        double sum = 0;
        int count = 0;
        void add(double x)
        {
            if (!std::isnan(x))
                sum += x, ++count;
        }
        double get() const { return count > 0 ? sum / count : 0; }
    };
    double height(const ivec2& p) const { return map_.contains(p.x, p.y) ? double(map_.height(p.x, p.y)) : no_height; }
    const HeightMap& map_;
};

/// Coefficients of the cubic B-spline through values, with no second derivative at the ends: the first and the last are the values themselves.
/// @param values  become the coefficients
/// @param scratch as long
void spline_line(double* values, std::size_t count, std::size_t stride, std::vector<double>& scratch)
{
    if (count < 3)
        return;
    const std::size_t last = count - 1;
    const auto at = [&](std::size_t i) -> double& { return values[i * stride]; };
    // c[i - 1] + 4 c[i] + c[i + 1] = 6 h[i], by elimination; c[0] and c[last] are known.
    scratch[0] = 0;
    double before = at(0);
    for (std::size_t i = 1; i < last; ++i) {
        const double pivot = 4 - scratch[i - 1];
        scratch[i] = 1 / pivot;
        before = at(i) = (6 * at(i) - before) / pivot;
    }
    for (std::size_t i = last - 1; i > 0; --i)
        at(i) -= scratch[i] * at(i + 1);
}

bool has_holes(const HeightMap& map)
{
    return std::any_of(map.heights.begin(), map.heights.end(), [](float h) { return std::isnan(h); });
}

std::vector<double> spline_coefficients(const HeightMap& map)
{
    const bool holes = has_holes(map);
    HeightMap filled;
    if (holes) {
        filled = map;
        fill_no_data(filled);
    }
    const std::vector<float>& heights = holes ? filled.heights : map.heights;
    std::vector<double> c(heights.begin(), heights.end());
    const std::size_t columns = std::size_t(map.columns), rows = std::size_t(map.rows);
    parallel_blocks(rows, 16, [&](std::size_t begin, std::size_t end) {
        std::vector<double> scratch(columns);
        for (std::size_t row = begin; row < end; ++row)
            spline_line(&c[row * columns], columns, 1, scratch);
    });
    parallel_blocks(columns, 16, [&](std::size_t begin, std::size_t end) {
        std::vector<double> scratch(rows);
        for (std::size_t column = begin; column < end; ++column)
            spline_line(&c[column], rows, columns, scratch);
    });
    return c;
}

/// The one corner without data, or -1, or -2 where there are more. Corner k of a cell is at (k % 2, k / 2).
template <class F> int missing_corner(F&& has_data)
{
    int missing = -1;
    for (int k = 0; k < 4; ++k)
        if (!has_data(ivec2(k % 2, k / 2)))
            missing = missing == -1 ? k : -2;
    return missing;
}

/// The four Bernstein coefficients at a corner.
void set_corner(HeightPatch& patch, const ivec2& corner, const SampleJet& s)
{
    const int i = 3 * corner.x, j = 3 * corner.y, di = 1 - 2 * corner.x, dj = 1 - 2 * corner.y; // into the cell
    const double u = di * s.u / 3, v = dj * s.v / 3;
    patch.b[i][j] = s.h;
    patch.b[i + di][j] = s.h + u;
    patch.b[i][j + dj] = s.h + v;
    patch.b[i + di][j + dj] = s.h + u + v + di * dj * s.uv / 9;
}

/// Bernstein coefficients of a cubic B-spline's piece, from four of its coefficients.
void to_bernstein(const double (&c)[4], double (&b)[4])
{
    b[0] = (c[0] + 4 * c[1] + c[2]) / 6;
    b[1] = (2 * c[1] + c[2]) / 3;
    b[2] = (c[1] + 2 * c[2]) / 3;
    b[3] = (c[1] + 4 * c[2] + c[3]) / 6;
}

} // namespace

HeightSurface::HeightSurface(const HeightMap& map, Interpolant interpolant) : map_(map), interpolant_(interpolant)
{
    if (map.columns < 2 || map.rows < 2)
        throw Error::Input(fmt::format("a height map of {} x {} samples has no area; it needs 2 x 2", map.columns, map.rows));
    if (interpolant == Interpolant::c2)
        coefficients_ = spline_coefficients(map);
}

HeightPatch HeightSurface::patch(const ivec2& cell) const
{
    if (missing_corner([&](const ivec2& corner) { return map_.has_data(cell.x + corner.x, cell.y + corner.y); }) == -2) {
        HeightPatch nothing;
        std::fill_n(&nothing.b[0][0], 16, no_height);
        return nothing;
    }
    return interpolant_ == Interpolant::c1 ? hermite_patch(cell) : spline_patch(cell);
}

bool HeightSurface::is_whole(const ivec2& cell) const
{
    return cell.x < map_.columns - 1 && cell.y < map_.rows - 1 && missing_corner([&](const ivec2& corner) { return map_.has_data(cell.x + corner.x, cell.y + corner.y); }) == -1;
}

HeightPatch HeightSurface::hermite_patch(const ivec2& cell) const
{
    const SlopeRule rule(map_);
    SampleJet corners[4];
    for (int k = 0; k < 4; ++k)
        corners[k] = rule.at(cell + ivec2(k % 2, k / 2));
    // A corner without data is on the plane of the others; nothing of what it changes is on an edge of another cell.
    const int missing = missing_corner([&](const ivec2& corner) { return !std::isnan(corners[corner.x + 2 * corner.y].h); });
    if (missing >= 0) {
        const SampleJet &beside = corners[missing ^ 1], &above = corners[missing ^ 2], &across = corners[missing ^ 3];
        const double along = (missing & 1) != 0 ? 1 : -1, down = (missing & 2) != 0 ? 1 : -1;
        corners[missing] = {beside.h + above.h - across.h, along * (above.h - across.h), down * (beside.h - across.h), 0};
    }
    HeightPatch patch;
    for (int k = 0; k < 4; ++k)
        set_corner(patch, {k % 2, k / 2}, corners[k]);
    return patch;
}

/// Of the B-spline, on a line beyond the border.
double HeightSurface::coefficient(int column, int row) const
{
    const auto beyond = [&](int i, int last) { return i < 0 ? -1 : i > last ? 1 : 0; };
    const auto at = [&](int c, int r) { return coefficients_[map_.index(c, r)]; };
    const auto in_row = [&](int c, int r) {
        const int side = beyond(c, map_.columns - 1);
        return side == 0 ? at(c, r) : 2 * at(c - side, r) - at(c - 2 * side, r);
    };
    const int side = beyond(row, map_.rows - 1);
    return side == 0 ? in_row(column, row) : 2 * in_row(column, row - side) - in_row(column, row - 2 * side);
}

HeightPatch HeightSurface::spline_patch(const ivec2& cell) const
{
    double half[4][4]; // Bernstein along rows of the map, coefficients of the spline across
    for (int j = 0; j < 4; ++j) {
        double c[4], b[4];
        for (int i = 0; i < 4; ++i)
            c[i] = coefficient(cell.x - 1 + i, cell.y - 1 + j);
        to_bernstein(c, b);
        for (int i = 0; i < 4; ++i)
            half[i][j] = b[i];
    }
    HeightPatch patch;
    for (int i = 0; i < 4; ++i)
        to_bernstein(half[i], patch.b[i]);
    for (int k = 0; k < 4; ++k) // but for rounding it goes through these
        if (map_.has_data(cell.x + k % 2, cell.y + k / 2))
            patch.b[3 * (k % 2)][3 * (k / 2)] = double(map_.height(cell.x + k % 2, cell.y + k / 2));
    return patch;
}

/// Whether a place in a cell is on the surface: not in the half around a missing sample, whose border is.
bool HeightSurface::is_known(const ivec2& cell, const dvec2& in_cell) const
{
    const int missing = missing_corner([&](const ivec2& corner) { return map_.has_data(cell.x + corner.x, cell.y + corner.y); });
    if (missing < 0)
        return missing == -1;
    const double u = missing & 1 ? in_cell.x : 1 - in_cell.x, v = missing & 2 ? in_cell.y : 1 - in_cell.y; // 1 at the missing one
    return u + v <= 1;
}

/// A cell that knows the place; of several, which agree there, the first.
bool HeightSurface::find(const dvec2& place, Spot& spot) const
{
    if (!(place.x >= 0 && place.y >= 0 && place.x <= map_.columns - 1 && place.y <= map_.rows - 1))
        return false;
    const ivec2 first(place); // rounds down
    for (const ivec2& step : {ivec2(0, 0), ivec2(-1, 0), ivec2(0, -1), ivec2(-1, -1)}) {
        const ivec2 cell = first + step;
        const dvec2 in_cell = place - dvec2(cell);
        const bool inside = cell.x >= 0 && cell.y >= 0 && cell.x < map_.columns - 1 && cell.y < map_.rows - 1 && in_cell.x <= 1 && in_cell.y <= 1;
        if (inside && is_known(cell, in_cell)) {
            spot = {cell, in_cell};
            return true;
        }
    }
    return false;
}

double HeightSurface::height(const dvec2& place) const
{
    Spot spot;
    return find(place, spot) ? patch(spot.cell).height(spot.in_cell.x, spot.in_cell.y) : no_height;
}

double HeightSurface::height(const ivec2& p, int levels) const
{
    const int mask = (1 << levels) - 1;
    if ((p.x & mask) == 0 && (p.y & mask) == 0)
        return double(map_.height(p.x >> levels, p.y >> levels));
    return height(dvec2(p) / double(1 << levels));
}

HeightJet HeightSurface::jet(const dvec2& metres) const
{
    const dvec2 place(metres.x / map_.spacing.x, double(map_.rows - 1) - metres.y / map_.spacing.y);
    Spot spot;
    if (!find(place, spot))
        return {no_height, no_height, no_height, no_height, no_height, no_height, no_height, no_height, no_height, no_height};
    HeightJet j = patch(spot.cell).jet(spot.in_cell.x, spot.in_cell.y);
    const double x = 1 / map_.spacing.x, y = -1 / map_.spacing.y; // rows run south
    j.x *= x, j.y *= y;
    j.xx *= x * x, j.xy *= x * y, j.yy *= y * y;
    j.xxx *= x * x * x, j.xxy *= x * x * y, j.xyy *= x * y * y, j.yyy *= y * y * y;
    return j;
}

dvec3 HeightSurface::normal(const dvec2& metres) const
{
    const HeightJet j = jet(metres);
    return std::isnan(j.height) ? dvec3(0, 0, 1) : glm::normalize(dvec3(-j.x, -j.y, 1));
}

HeightMap resampled(const HeightSurface& surface, int levels)
{
    const HeightMap& map = surface.map();
    if (levels < 0 || levels > 16)
        throw Error::Input(fmt::format("a lattice 2^{} finer than the samples: 0 to 16 can be", levels));
    const std::int64_t columns = (std::int64_t(map.columns - 1) << levels) + 1, rows = (std::int64_t(map.rows - 1) << levels) + 1;
    if (columns * rows > std::int64_t(1) << 30)
        throw Error::Input(fmt::format("{} x {} samples are too many", columns, rows));
    HeightMap out = map;
    out.columns = int(columns), out.rows = int(rows);
    out.spacing = map.spacing / double(1 << levels);
    out.heights.resize(std::size_t(columns) * std::size_t(rows));
    const int n = 1 << levels;
    // Each cell has the points at its northern and western sides and inside; the last column and row belong to nobody.
    parallel_each(std::size_t(map.rows), 1, [&](std::size_t row) {
        for (int column = 0; column < map.columns; ++column) {
            const ivec2 cell(column, int(row));
            const bool whole = surface.is_whole(cell);
            const HeightPatch patch = whole ? surface.patch(cell) : HeightPatch();
            for (int y = cell.y * n; y < std::min((cell.y + 1) * n, out.rows); ++y)
                for (int x = cell.x * n; x < std::min((cell.x + 1) * n, out.columns); ++x)
                    out.heights[out.index(x, y)] = float(whole ? patch.height(double(x - cell.x * n) / n, double(y - cell.y * n) / n) : surface.height(ivec2(x, y), levels));
        }
    });
    return out;
}

} // namespace limn
