#pragma once

#include <vector>

#include "limn/subdivision/charts.h"

namespace limn {

/// Where charts lie in a square texture, in texels; rows count down. Each lies in a cell of its own: its box and half a gap around, where the
/// cell's sides are at multiples of the gap. So in the mip levels up to log2(gap) no texel mixes two cells, and bilinear filtering within a
/// chart stays in its cell (where the texture's side is a multiple of the gap, so that levels halve evenly).
struct Atlas {
    /// A rectangle of texels [low, high).
    struct Cell {
        ivec2 low, high;
    };

    int size = 0;                ///< texels along a side
    int gap = 0;                 ///< texels between charts at least
    double scale = 0;            ///< texels per unit of length, the same for all charts
    std::vector<dvec2> origins;  ///< per chart: where (0,0) of it lies, its lower left corner
    std::vector<Cell> cells;     ///< per chart
    double fill = 0;             ///< share of the texture that charts cover, from their areas

    /// Where a point of a chart lies; (0,0) is the upper left corner of the upper left texel.
    dvec2 texel(std::size_t chart, const dvec2& p) const { return origins[chart] + scale * dvec2(p.x, -p.y); }
    /// The other way: the point of a chart's plane.
    dvec2 chart_point(std::size_t chart, const dvec2& p) const { return dvec2(p.x - origins[chart].x, origins[chart].y - p.y) / scale; }
    int mip_levels() const; ///< levels below the finest that are clean
};

/// Places boxes in rows, the highest first, at the largest scale at which they fit (within 0.1 %).
/// @param size  1 to 8192
/// @param gap   a power of two, 2 to 64
/// @throws Error::Input for numbers out of range, for charts without extent, and where even cells of 1 texel and the gap do not fit.
Atlas pack_charts(const std::vector<Chart>& charts, int size, int gap);

/// Texture coordinates of the faces' corners, 3 per face: (0,0) is the lower left corner of the texture.
std::vector<vec2> atlas_uvs(const Atlas& atlas, const std::vector<Chart>& charts, std::size_t faces);

} // namespace limn
