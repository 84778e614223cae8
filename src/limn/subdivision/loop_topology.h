#pragma once

#include <span>
#include <string>
#include <vector>

#include "limn/base/vec.h"
#include "limn/geometry/adjacency.h"
#include "limn/geometry/mesh.h"

namespace limn {

/// How sharp edges and what lies next to them are subdivided (silhouette-loop specification, 2.3).
enum class CreaseRule : std::uint8_t {
    opensubdiv, ///< sharp edges 1/2, 1/2; smooth edges as everywhere: what tagged files are made for
    hoppe,      ///< Hoppe et al. 1994: 5/8, 3/8 where a regular crease vertex meets another
    biermann,   ///< Biermann et al. 2000: smooth edges at creases depend on the angle of their sector
};

/// An edge of this sharpness or more stays sharp at every level.
inline constexpr float infinitely_sharp = 10;

/// The edges that leave a vertex, counter-clockwise seen from outside; at borders from border to border.
struct Spokes {
    std::vector<std::uint32_t> neighbours, edges;
    std::vector<std::uint32_t> half_edges; ///< those that leave the vertex: face i lies between spokes i and i + 1
    std::vector<float> sharpness;          ///< of the edges
    bool closed = true;                    ///< no border: as many faces as spokes, else one less
    std::size_t size() const { return edges.size(); }
};

/// Triangles that are subdivided: an oriented 2-manifold, open or closed. Half-edges are those of Adjacency. Subdivision keeps every vertex's
/// number, and gives the point of edge e the number vertex_count() + e.
struct LoopTopology {
    std::vector<uvec3> triangles;
    std::vector<std::uint32_t> twin;      ///< per half-edge; `none` at borders
    std::vector<std::uint32_t> edge;      ///< per half-edge: the number of its edge
    std::vector<std::uint32_t> half_edge; ///< per edge: one of its half-edges; at borders the only one
    std::vector<float> sharpness;         ///< per edge: 0 smooth; borders are infinitely sharp
    /// Per vertex: a half-edge that leaves it; at borders the one that runs along the border. `none` for a vertex without faces.
    std::vector<std::uint32_t> leaving;

    std::size_t vertex_count() const { return leaving.size(); }
    std::size_t edge_count() const { return half_edge.size(); }
    std::uint32_t start(std::uint32_t h) const { return triangles[h / 3][int(h % 3)]; }
    std::uint32_t end(std::uint32_t h) const { return start(next_half_edge(h)); }
    std::uint32_t opposite(std::uint32_t h) const { return start(next_half_edge(next_half_edge(h))); }
    bool is_border(std::uint32_t e) const { return twin[half_edge[e]] == none; }

    /// Empty for a vertex without faces. @param spokes  is filled; what it held goes
    void gather(std::uint32_t vertex, Spokes& spokes) const;
    Spokes gather(std::uint32_t vertex) const;
    /// Whether an edge around the vertex is sharp; the same as its spokes tell, but quicker.
    bool is_at_sharp_edge(std::uint32_t vertex) const;
};

/// Per vertex: 1 where one of its edges is sharp or a border, else 0. Parallel; one look at every edge, where asking each vertex looks at its ring.
std::vector<std::uint8_t> creased_vertices(const LoopTopology& topology);

/// What is made of a mesh before it is subdivided.
struct ControlOptions {
    bool tags = true;        ///< creases as the file tags them
    double crease_angle = 0; ///< degrees: edges where the faces turn by more are sharp; 0: none
};

/// What was not as it should be, counted.
struct ControlNotes {
    std::size_t non_manifold_edges = 0;  ///< more than two faces, or two that run the same way: a border for each of them
    std::size_t split_vertices = 0;      ///< where several fans of faces met, each got a vertex of its own
    std::size_t isolated_vertices = 0;
    std::size_t ignored_tags = 0;        ///< crease tags for edges that there are none of
    std::size_t contradicting_tags = 0;  ///< edges tagged more than once with different sharpness; the sharper one holds
};

/// A control mesh: where its vertices are and how they hang together.
struct ControlMesh {
    std::vector<dvec3> positions;      ///< one per vertex; those of split vertices are repeated behind the mesh's own
    LoopTopology topology;
    std::vector<std::uint32_t> source; ///< per vertex: the vertex of the mesh
    ControlNotes notes;
};

/// @throws Error::Input for a mesh without faces, or with a face that uses a vertex twice.
ControlMesh make_control_mesh(const Mesh& mesh, const ControlOptions& options = {});

/// "2 non-manifold edges" and so on; empty for a clean mesh.
std::vector<std::string> notes_of(const ControlNotes& notes);

} // namespace limn
