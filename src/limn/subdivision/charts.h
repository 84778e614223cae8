#pragma once

#include <span>
#include <vector>

#include "limn/subdivision/loop_topology.h"

namespace limn {

/// How faces are laid out flat for a texture.
enum class ChartKind : std::uint8_t {
    triangles, ///< each on its own, on its longest side: fills half of its box
    pairs,     ///< most of them two by two, unfolded along a smooth edge into the smallest box
};

/// One face or two, flat, isometric: every edge is as long as in space. In a box from (0,0) to `size` that it touches on all sides.
struct Chart {
    std::uint32_t faces[2] = {none, none}; ///< the second is `none` where it stands alone
    dvec2 corners[2][3];                   ///< of the faces' corners, counter-clockwise, in units of length
    dvec2 size = dvec2(0);

    int face_count() const { return faces[1] == none ? 1 : 2; }
    double area() const; ///< of the faces
};

/// Charts for all faces of a mesh, in the order of their first faces. (Silhouette-loop specification, 2.10.) Pairs are chosen greedily: those
/// whose box is filled best first; never across edges that are sharp, where normals jump. Deterministic.
/// @param positions  on the limit surface
std::vector<Chart> make_charts(const LoopTopology& topology, std::span<const dvec3> positions, ChartKind kind);

} // namespace limn
