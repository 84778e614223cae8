#pragma once

#include <functional>
#include <vector>

#include "limn/terrain/split_point.h"
#include "limn/terrain/triangle_scan.h"

namespace limn {

/// Own errors of triangles too large for all their samples to be in memory at once: grown window by window.
class CoarseErrors {
public:
    /// The points that split hypotenuses of 2^(first + 1) cells along a row or column, or diagonals of as many, and all larger ones.
    /// @param height  of a sample that is a corner of such a triangle, or in the last column or row; NaN where it has no data
    CoarseErrors(const Lattice& lattice, int first, std::function<float(const ivec2&)> height);

    /// Adds the samples of some whole rows, each of which has to be in one window at least. In parallel.
    void add(const HeightWindow& window);
    /// The error of both triangles of a point, legs apart, once all their samples are there; see error_beside_legs().
    /// @param power  2^(power + 1) cells: its hypotenuse
    double error(int power, const ivec2& middle) const;

private:
    struct Triangle {
        BisectionTriangle t;
        CornerHeights corners;
        bool is_cut; ///< by the map's border
        ScanResult found;
    };
    std::size_t slot(int power, const ivec2& middle) const;

    Lattice lattice_;
    int first_;
    std::function<float(const ivec2&)> height_;
    std::vector<Triangle> triangles_; ///< the largest first
    std::vector<std::size_t> before_; ///< slots of the points of each power, from `first_` on
    std::vector<std::vector<std::size_t>> of_slot_;
};

} // namespace limn
