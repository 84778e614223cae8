#include "limn/terrain/fill_no_data.h"

#include <array>
#include <cstdint>
#include <limits>

#include "limn/base/parallel.h"

namespace limn {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t grain_rows = 16, grain_holes = 1 << 12;
/// Sweeps over the holes of each grid: they smooth what is as wide as some of its cells, and coarser grids have smoothed the rest. The first
/// ones go further than Laplace's equation asks (successive over-relaxation; Young 1954), which brings wide holes nearer to it sooner; the
/// last ones do not, and leave no height outside those around it.
constexpr int far_sweeps = 100, sweeps = far_sweeps + 20;
constexpr double over_relaxation = 1.85;

/// Heights on one of ever coarser grids.
struct Grid {
    int columns = 0, rows = 0;
    std::vector<float> heights;
    float& at(int x, int y) { return heights[std::size_t(y) * std::size_t(columns) + std::size_t(x)]; }
    float at(int x, int y) const { return const_cast<Grid*>(this)->at(x, y); }
};

/// Means of what is known in blocks of 2 x 2.
Grid halved(const Grid& fine)
{
    Grid coarse = {(fine.columns + 1) / 2, (fine.rows + 1) / 2, {}};
    coarse.heights.resize(std::size_t(coarse.columns) * std::size_t(coarse.rows));
    parallel_each(std::size_t(coarse.rows), grain_rows, [&](std::size_t row) {
        const int y = int(row);
        for (int x = 0; x < coarse.columns; ++x) {
            double sum = 0;
            int known = 0;
            for (int fy = 2 * y; fy < std::min(2 * y + 2, fine.rows); ++fy)
                for (int fx = 2 * x; fx < std::min(2 * x + 2, fine.columns); ++fx)
                    if (const float h = fine.at(fx, fy); !std::isnan(h)) {
                        sum += double(h);
                        ++known;
                    }
            coarse.at(x, y) = known > 0 ? float(sum / known) : nan;
        }
    });
    return coarse;
}

/// The samples without data, those whose column and row have an even sum before the others.
std::array<std::vector<std::size_t>, 2> holes_of(const Grid& grid)
{
    std::array<std::vector<std::size_t>, 2> holes;
    for (std::size_t colour = 0; colour < 2; ++colour)
        holes[colour] =
            parallel_collect<std::size_t>(std::size_t(grid.rows), grain_rows, [&](std::size_t begin, std::size_t end, auto& out) {
                for (std::size_t y = begin; y < end; ++y)
                    for (std::size_t x = (y + colour) % 2; x < std::size_t(grid.columns); x += 2)
                        if (const std::size_t i = y * std::size_t(grid.columns) + x; std::isnan(grid.heights[i]))
                            out.push_back(i);
            });
    return holes;
}

/// A coarser grid's height at a sample of the finer one, between the coarse cells' centres.
float interpolated(const Grid& coarse, int x, int y)
{
    const double cx = std::clamp(0.5 * x - 0.25, 0.0, double(coarse.columns - 1)),
                 cy = std::clamp(0.5 * y - 0.25, 0.0, double(coarse.rows - 1));
    const int left = std::min(int(cx), std::max(0, coarse.columns - 2)), top = std::min(int(cy), std::max(0, coarse.rows - 2));
    const int right = std::min(left + 1, coarse.columns - 1), bottom = std::min(top + 1, coarse.rows - 1);
    const double u = cx - left, v = cy - top;
    const auto along = [&](int row) { return (1 - u) * double(coarse.at(left, row)) + u * double(coarse.at(right, row)); };
    return float((1 - v) * along(top) + v * along(bottom));
}

/// The height that makes Laplace's equation hold at a sample: the mean of its neighbours, weighted by the inverse squares of the spacing;
/// `strength` times as far from the present height as that.
float relaxed(const Grid& grid, std::size_t i, const dvec2& weight, double strength)
{
    const int x = int(i % std::size_t(grid.columns)), y = int(i / std::size_t(grid.columns));
    double sum = 0, weights = 0;
    const auto add = [&](int nx, int ny, double w) {
        if (nx < 0 || ny < 0 || nx >= grid.columns || ny >= grid.rows)
            return;
        sum += w * double(grid.at(nx, ny));
        weights += w;
    };
    add(x - 1, y, weight.x);
    add(x + 1, y, weight.x);
    add(x, y - 1, weight.y);
    add(x, y + 1, weight.y);
    const double now = double(grid.heights[i]);
    return float(strength == 1 ? sum / weights : now + strength * (sum / weights - now));
}

/// Fills the holes from a coarser grid without any, and smooths. Samples of one colour have neighbours of the other only, so that the order
/// within a colour does not matter.
void fill_from(const Grid& coarse, Grid& fine, const dvec2& weight)
{
    const std::array<std::vector<std::size_t>, 2> holes = holes_of(fine);
    for (const std::vector<std::size_t>& of_colour : holes)
        parallel_each(of_colour.size(), grain_holes, [&](std::size_t k) {
            const std::size_t i = of_colour[k];
            fine.heights[i] = interpolated(coarse, int(i % std::size_t(fine.columns)), int(i / std::size_t(fine.columns)));
        });
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for (const std::vector<std::size_t>& of_colour : holes)
            parallel_each(of_colour.size(), grain_holes, [&](std::size_t k) {
                fine.heights[of_colour[k]] = relaxed(fine, of_colour[k], weight, sweep < far_sweeps ? over_relaxation : 1);
            });
}

std::size_t count_holes(const std::vector<float>& heights)
{
    return std::size_t(std::count_if(heights.begin(), heights.end(), [](float h) { return std::isnan(h); }));
}

} // namespace

std::size_t fill_no_data(HeightMap& map)
{
    const std::size_t missing = count_holes(map.heights);
    if (missing == 0 || missing == map.heights.size())
        return 0;
    std::vector<Grid> grids = {{map.columns, map.rows, std::move(map.heights)}};
    while (count_holes(grids.back().heights) > 0)
        grids.push_back(halved(grids.back()));
    const dvec2 weight = 1.0 / (map.spacing * map.spacing);
    for (std::size_t level = grids.size() - 1; level > 0; --level)
        fill_from(grids[level], grids[level - 1], weight);
    map.heights = std::move(grids.front().heights);
    return missing;
}

} // namespace limn
