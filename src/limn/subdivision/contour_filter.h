#pragma once

#include <cstdint>

#include "limn/subdivision/control_edges.h"
#include "limn/subdivision/silhouette_mesh.h"

namespace limn {

/// The points of some regular edges (RegularEdge), beside each other.
inline constexpr std::size_t edge_lanes = 8;
struct EdgeLanes {
    double points[regular_edge_support][3][edge_lanes] = {};
    void set(std::size_t lane, std::size_t point, const dvec3& position)
    {
        for (int i = 0; i < 3; ++i)
            points[point][i][lane] = position[i];
    }
};

/// A bit for each edge.
struct SignLanes {
    std::uint8_t change;   ///< the coefficients of the contour's polynomial along it (contour_along of regular_side_net) are not all of one sign
    std::uint8_t negative; ///< the first of them is negative
};

/// By vectors of the machine's best instruction set; the same bits for all.
SignLanes contour_signs(const EdgeLanes& edges, const Eye& eye);

} // namespace limn
