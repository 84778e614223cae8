#include "limn/subdivision/atlas.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

constexpr int most_size = 8192, most_gap = 64;

/// A chart's cell, in gaps.
ivec2 cell_of(const Chart& chart, double scale, int gap)
{
    const auto side = [&](double length) { return int(std::ceil((std::max(1.0, std::ceil(length * scale)) + gap) / gap)); };
    return {side(chart.size.x), side(chart.size.y)};
}

/// Row by row; false where the last row ends below the texture. @param places  per chart, in gaps; may be null
bool place(const std::vector<Chart>& charts, const std::vector<std::uint32_t>& order, double scale, int gap, int across, std::vector<ivec2>* places)
{
    ivec2 at(0);
    int row_height = 0;
    for (const std::uint32_t i : order) {
        const ivec2 cell = cell_of(charts[i], scale, gap);
        if (at.x + cell.x > across) {
            at = {0, at.y + row_height};
            row_height = 0;
        }
        if (at.x + cell.x > across || at.y + cell.y > across)
            return false;
        if (places != nullptr)
            (*places)[i] = at;
        at.x += cell.x;
        row_height = std::max(row_height, cell.y);
    }
    return true;
}

void check(const std::vector<Chart>& charts, int size, int gap)
{
    if (size < 1 || size > most_size)
        throw Error::Input(fmt::format("a map of {} texels a side is outside 1..{}", size, most_size));
    if (gap < 2 || gap > most_gap || !std::has_single_bit(unsigned(gap)))
        throw Error::Input(fmt::format("a gap of {} texels is no power of two in 2..{}", gap, most_gap));
    const bool extended = std::any_of(charts.begin(), charts.end(), [](const Chart& c) { return c.size.x > 0; });
    const bool finite = std::all_of(charts.begin(), charts.end(), [](const Chart& c) { return std::isfinite(c.size.x) && std::isfinite(c.size.y); });
    if (!extended || !finite)
        throw Error::Input("the mesh has no extent that a map could cover");
}

/// The largest scale at which all fits.
double fitting_scale(const std::vector<Chart>& charts, const std::vector<std::uint32_t>& order, int size, int gap)
{
    const auto fits = [&](double scale) { return place(charts, order, scale, gap, size / gap, nullptr); };
    double longest = 0;
    for (const Chart& chart : charts)
        longest = std::max({longest, chart.size.x, chart.size.y});
    double low = 0, high = size / longest;
    while (high - low > 0.001 * high) {
        const double middle = (low + high) / 2;
        (fits(middle) ? low : high) = middle;
    }
    if (low == 0)
        throw Error::Input(fmt::format("{} charts with gaps of {} texels do not fit into a map of {} x {}; make it larger", charts.size(), gap, size, size));
    return low;
}

} // namespace

int Atlas::mip_levels() const { return std::bit_width(unsigned(gap)) - 1; }

Atlas pack_charts(const std::vector<Chart>& charts, int size, int gap)
{
    check(charts, size, gap);
    std::vector<std::uint32_t> order(charts.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return charts[a].size.y != charts[b].size.y ? charts[a].size.y > charts[b].size.y : charts[a].size.x > charts[b].size.x;
    });
    Atlas atlas;
    atlas.size = size;
    atlas.gap = gap;
    atlas.scale = fitting_scale(charts, order, size, gap);
    std::vector<ivec2> places(charts.size());
    place(charts, order, atlas.scale, gap, size / gap, &places);
    for (std::size_t i = 0; i < charts.size(); ++i) {
        const ivec2 low = places[i] * gap, high = low + cell_of(charts[i], atlas.scale, gap) * gap;
        atlas.cells.push_back({low, high});
        atlas.origins.push_back(dvec2(low) + gap / 2.0 + dvec2(0, atlas.scale * charts[i].size.y));
        atlas.fill += charts[i].area() * atlas.scale * atlas.scale / (double(size) * size);
    }
    return atlas;
}

std::vector<vec2> atlas_uvs(const Atlas& atlas, const std::vector<Chart>& charts, std::size_t faces)
{
    std::vector<vec2> uvs(3 * faces);
    for (std::size_t i = 0; i < charts.size(); ++i)
        for (int f = 0; f < charts[i].face_count(); ++f)
            for (std::size_t k = 0; k < 3; ++k) {
                const dvec2 p = atlas.texel(i, charts[i].corners[f][k]) / double(atlas.size);
                uvs[3 * charts[i].faces[f] + k] = vec2(dvec2(p.x, 1 - p.y));
            }
    return uvs;
}

} // namespace limn
