#pragma once

#include <limits>
#include <vector>

#include "limn/terrain/height_map.h"
#include "limn/terrain/height_window.h"
#include "limn/terrain/lattice.h"

namespace limn {

/// What is known of the surroundings of a lattice point.
struct PointBounds {
    float error = 0, low = 0, high = 0; ///< metres; see NestedErrors
};

/// For each lattice point, how wrong a mesh may be around it that does not have it as a corner, and between which heights its samples are.
///
/// A point is the middle of one hypotenuse, of the two triangles that it splits. Its error is the greatest distance, in metres along z, of any
/// sample of these two triangles from their planes, and is at least that of every point that cannot be there without it. So the points with
/// an error above a tolerance make a conforming mesh in which no sample is further off than that (Duchaineau et al. 1997 and Lindstrom &
/// Pascucci 2002; the terrain specification, section 7.1). Triangles with samples without data have an infinite error, unless all are.
struct NestedErrors {
    Lattice lattice;
    std::vector<float> errors;     ///< metres, rounded up; 0 at points that split nothing
    std::vector<float> low, high;  ///< metres: all samples of the two triangles and of those of all points below are between; empty if not asked for

    float error(const ivec2& p) const { return errors[lattice.index(p)]; }
    PointBounds bounds(const ivec2& p) const
    {
        const std::size_t i = lattice.index(p);
        return {errors[i], low[i], high[i]};
    }
};

struct NestedErrorOptions {
    bool ranges = false; ///< fill `low` and `high`, which errors on the screen need
};

/// @throws Error::Input where the map is too small or not as large as it says
NestedErrors nest_errors(const HeightMap& map, const Lattice& lattice, const NestedErrorOptions& options = {});
/// With the lattice of make_lattice().
NestedErrors nest_errors(const HeightMap& map, const NestedErrorOptions& options = {});

/// How far the samples of a triangle are from its plane, in metres: the part inside the map, in the polygon's triangles as meshes have them.
/// Infinite where some but not all samples have no data, 0 where all have none.
double triangle_error(const HeightMap& map, const Lattice& lattice, const BisectionTriangle& triangle);
/// @param window  with all samples of the triangle
double triangle_error(const HeightWindow& window, const Lattice& lattice, const BisectionTriangle& triangle);

/// How far the box around a point's two triangles, and those of all points that need it, reaches from the point, in cells.
/// @param half_hypotenuse  of the hypotenuse that the point splits, in cells along a row or column: 1, 2, 4 ...
/// @param diagonal         whether that hypotenuse is diagonal
int reach_of_point(int half_hypotenuse, bool diagonal);

} // namespace limn
