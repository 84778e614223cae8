#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limn/geometry/mesh.h"

namespace limn {

/// What a mesh is made of and what is wrong with it. Lengths in the mesh's units. Edges, shells, area and volume are those
/// of the faces with three distinct, finite vertices; the other faces are only counted.
struct Diagnosis {
    std::size_t vertices = 0, triangles = 0, edges = 0;
    std::size_t border_edges = 0;          ///< with one face
    std::size_t non_manifold_edges = 0;    ///< with more than two faces
    std::size_t misoriented_edges = 0;     ///< whose two faces run along them in the same direction
    std::size_t non_manifold_vertices = 0; ///< where parts of the surface touch in nothing but that point
    std::size_t degenerate_faces = 0;      ///< a vertex used twice, or no area
    std::size_t duplicate_faces = 0;       ///< an earlier face has the same vertices in the same direction
    std::size_t not_finite_vertices = 0;   ///< NaN or infinite
    std::size_t not_finite_faces = 0;      ///< that use one of those
    std::size_t unreferenced_vertices = 0; ///< that no face uses
    std::size_t shells = 0;                ///< parts joined by edges
    std::int64_t euler = 0;                ///< used vertices - edges + faces
    bool closed = false;                   ///< every edge has two faces, and there is one
    bool manifold = false;                 ///< no non-manifold edge or vertex
    bool oriented = false;                 ///< no edge is misoriented, or has more than two faces
    std::optional<std::int64_t> genus;     ///< handles, summed over the shells; where closed, manifold and oriented
    double area = 0;
    std::optional<double> volume;          ///< negative where the faces are inside out; where closed and oriented
    Bounds bounds;
    double shortest_edge = 0, median_edge = 0, longest_edge = 0;
    std::size_t memory = 0;                ///< bytes of the mesh's arrays
};

/// Looks at a mesh as it is (read it with weld on, clean off, to see what a file holds). Parallel in part; deterministic.
Diagnosis diagnose(const Mesh& mesh);

/// What is unclean, one short phrase each with its count ("12 border edges"); empty for a closed, clean mesh.
std::vector<std::string> complaints(const Diagnosis& diagnosis);

/// A table for a person, one line a fact, ending in a line feed.
std::string diagnosis_text(const Diagnosis& diagnosis);
/// One JSON object with a member for each fact; `genus` and `volume` are null where they have no meaning.
std::string diagnosis_json(const Diagnosis& diagnosis);

} // namespace limn
