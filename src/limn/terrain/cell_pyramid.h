#pragma once

#include <vector>

#include "limn/terrain/height_surface.h"

namespace limn {

/// What is known of the surface over some cells.
struct CellBounds {
    float bend = 0; ///< metres: HeightPatch::bend() of the most bent
    float low = std::numeric_limits<float>::infinity(), high = -std::numeric_limits<float>::infinity(); ///< metres: all heights are between

    void add(const CellBounds& other)
    {
        bend = std::max(bend, other.bend);
        low = std::min(low, other.low), high = std::max(high, other.high);
    }
};

/// Bounds of squares of 2^k cells: 16 bytes for each sample of the map.
class CellPyramid {
public:
    explicit CellPyramid(const HeightSurface& surface);
    /// Of squares that cover the part of a box in the map, in columns and rows; never narrower for a box around another.
    CellBounds over(const dvec2& low, const dvec2& high) const;
    /// Of the whole map.
    CellBounds whole() const { return levels_.back().cells.front(); }

private:
    struct Level {
        ivec2 size;
        std::vector<CellBounds> cells;
    };
    std::vector<Level> levels_; ///< from single cells to one square
};

} // namespace limn
