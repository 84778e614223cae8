#pragma once

#include <array>
#include <span>
#include <vector>

#include "limn/subdivision/edge_tables.h"

namespace limn {

/// What the seed's contour search knows of a control mesh before anything is posed: made once, it holds for every position of the vertices
/// (silhouette-loop specification, 2.5 and 2.6). By OpenSubdiv's rule for creases.
///
/// Each sector of a vertex (the faces from one infinitely sharp edge to the next; all of them where there are fewer than two) has a normal of
/// its own. Along an infinitely sharp edge, the faces on its two sides therefore have different ends, and the edge has two sides; all other
/// edges have one, which both faces share.
struct SeedSurface {
    LoopTopology topology;
    int levels = 0;       ///< every half of an edge has 2^levels pieces: the greatest depth of a search
    /// Of the mesh refined once: half 2e leads from the start of edge e (of its half-edge) to its middle, half 2e + 1 from its end.
    EdgeStencils halves;
    std::vector<std::uint32_t> sector;        ///< per half-edge: that at its start and in its face
    std::vector<std::uint32_t> sector_corner; ///< per sector: a half-edge in it. The first sector of vertex v is v (`none` without faces)
    std::vector<std::uint32_t> sector_vertex; ///< per sector
    std::vector<std::uint32_t> side;          ///< per half-edge: the side of its edge that its face sees
    /// The edges with a second side, that of their half-edge's twin. Side e is the first of edge e, side edge_count() + k the second of two_sided[k].
    std::vector<std::uint32_t> two_sided;
    std::vector<std::array<std::uint32_t, 2>> ends; ///< per side: the sectors at the start and the end of its edge
    std::vector<std::uint32_t> sharp;        ///< the edges that are infinitely sharp, borders among them
    std::vector<std::uint32_t> sharp_number; ///< per edge: which of these it is, or `none`; empty where there are none

    std::size_t side_count() const { return ends.size(); }
    bool is_second(std::uint32_t s) const { return s >= topology.edge_count(); }
    std::uint32_t edge_of(std::uint32_t s) const { return is_second(s) ? two_sided[s - topology.edge_count()] : s; }
};

/// @param levels  0 to 12
/// @throws Error::Input for other levels.
SeedSurface make_seed_surface(LoopTopology topology, int levels = 5);

/// One position of all vertices.
struct SeedPose {
    std::vector<dvec3> fine;      ///< of the mesh refined once: what the halves' supports refer to
    std::vector<dvec3> positions; ///< of the vertices on the limit surface
    std::vector<dvec3> normals;   ///< per sector: of the limit surface, unit length
};
/// @param positions  of the control mesh's vertices
SeedPose make_seed_pose(const SeedSurface& surface, std::span<const dvec3> positions);

} // namespace limn
