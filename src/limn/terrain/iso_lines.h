#pragma once

#include <span>
#include <vector>

#include "limn/terrain/height_map.h"

namespace limn {

/// A line of one height on a map.
struct IsoLine {
    std::size_t level = 0;     ///< which of the levels asked for
    bool closed = false;       ///< the last point joins the first, which is not repeated
    std::vector<dvec3> points; ///< in the map's coordinates, z the level; at least 2, of closed ones 3, no two neighbours the same
};

/// The lines along which a map, linear between neighbours in its rows and columns, has given heights. Each runs with the higher ground on its
/// left, seen from above, and is closed or ends at the map's border or at a cell (four samples) with a corner that has no data. Samples of
/// exactly a level count as higher, so that lines pass them on their lower side: no line crosses or ends at another, and level ground at a
/// level is surrounded, not filled. In a cell with two opposite corners higher, the mean of the four decides which are joined. What shrinks
/// to a point (a summit at a level) is left out. Multi-threaded; the same for any number of threads.
/// @param levels  metres, in any order; no number twice
/// @return ordered by level, open lines before closed ones, each in the order in which it is met from the north-west, row by row
std::vector<IsoLine> iso_lines(const HeightMap& map, std::span<const double> levels);

/// The multiples of `step` metres, from the lowest to the highest height of the map, by their factors: first, and one past the last.
/// @throws Error::Input for a step that is not above 0, and for more than 10,000 levels
struct IsoFactors {
    long long first = 0, end = 0;
};
IsoFactors iso_factors(const HeightMap& map, double step);

} // namespace limn
