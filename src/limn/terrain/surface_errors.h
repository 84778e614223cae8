#pragma once

#include "limn/terrain/cell_pyramid.h"
#include "limn/terrain/nested_errors.h"

namespace limn {

/// How far meshes of a lattice finer than the samples are from the surface between them, everywhere and not only at samples.
///
/// The lattice is that of the map's hierarchy, 2^levels finer. On a part of it, 2^base finer than the samples, errors at the points of the
/// surface are nested as those of samples are; below, and between these points, the surface's second derivatives bound them (HeightPatch::bend()). Sums
/// and maxima of what nests do nest, so triangles still decide alone, and meshes have no cracks.
class SurfaceErrors {
public:
    /// @param surface  has to outlive the errors
    /// @param levels   0 to 16
    SurfaceErrors(const HeightSurface& surface, int levels);

    const HeightSurface& surface() const { return surface_; }
    /// The fine lattice as an empty height map: its size and spacing.
    const HeightMap& frame() const { return frame_; }
    const Lattice& lattice() const { return lattice_; }
    int levels() const { return levels_; }
    /// Of the point that would split a triangle of the fine lattice.
    PointBounds bounds(const BisectionTriangle& t) const;
    /// Whether a triangle is a part of the surface: all corners that are points of the base have data.
    bool is_on_surface(const BisectionTriangle& t) const;
    /// Whether a point of the fine lattice is known to be on it. Points between those of the base are, in triangles that are.
    bool has_data(const ivec2& p) const;

private:
    bool is_of_base(const ivec2& p) const { return ((p.x | p.y) & (base_step() - 1)) == 0; }
    int base_step() const { return 1 << (levels_ - base_); }

    const HeightSurface& surface_;
    int levels_, base_;
    HeightMap frame_, base_map_;
    Lattice lattice_;
    NestedErrors nested_;
    CellPyramid cells_;
    double rounding_ = 0; ///< metres that heights of the base map are off
};

/// How many levels below the samples a bound in metres needs: 0 to 12, fewer where the lattice would get too large.
int levels_for(const HeightSurface& surface, double tolerance);

} // namespace limn
