#pragma once

#include <vector>

#include "limn/terrain/height_map.h"
#include "limn/terrain/height_patch.h"

namespace limn {

/// What a height map is between its samples; both go through all samples and are bicubic in each cell between four of them.
enum class Interpolant {
    c1, ///< slopes are continuous: those at samples are central differences (Catmull & Rom 1974); what is near a sample depends on 16 around it
    c2, ///< curvature is continuous too: the cubic B-spline through the samples (Unser 1999) with no curvature across the map's border
};

/// The surface of a height map. At the border, and beside samples without data, slopes of c1 are one-sided differences; c2 is that of the map with
/// its holes filled. There is no surface where a cell misses more than one sample, nor in the half of one around a missing sample.
class HeightSurface {
public:
    /// @param map  has to outlive the surface. @throws Error::Input where it has fewer than 2 x 2 samples
    HeightSurface(const HeightMap& map, Interpolant interpolant);

    const HeightMap& map() const { return map_; }
    /// Of the cell whose north-western sample is (cell.x, cell.y); NaN where it misses more than one sample.
    HeightPatch patch(const ivec2& cell) const;
    /// Whether there is a cell, and all its samples have data.
    bool is_whole(const ivec2& cell) const;
    /// At a column and a row and parts of them: the sample's own height at samples, NaN where there is no surface or the place is outside the map.
    double height(const dvec2& place) const;
    /// The height of lattice point `p` of a lattice 2^levels finer than the samples.
    double height(const ivec2& p, int levels) const;
    /// The surface at a place in the map's own coordinates, in metres, and its derivatives along x (east) and y (north). NaN as for height().
    HeightJet jet(const dvec2& metres) const;
    /// Upward unit normal; straight up where there is no surface.
    dvec3 normal(const dvec2& metres) const;

private:
    struct Spot {
        ivec2 cell;
        dvec2 in_cell;
    };
    bool find(const dvec2& place, Spot& spot) const;
    bool is_known(const ivec2& cell, const dvec2& in_cell) const;
    HeightPatch hermite_patch(const ivec2& cell) const;
    HeightPatch spline_patch(const ivec2& cell) const;
    double coefficient(int column, int row) const;

    const HeightMap& map_;
    Interpolant interpolant_;
    std::vector<double> coefficients_; ///< of the B-spline; empty for c1
};

/// The surface's heights on a lattice 2^levels finer than the samples, as a map of its own, rounded to floats; samples stay what they are. NaN where
/// there is no surface. In parallel. @throws Error::Input for levels outside 0..16 or more than 2^30 samples
HeightMap resampled(const HeightSurface& surface, int levels);

} // namespace limn
