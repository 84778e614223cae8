#pragma once

#include "limn/geometry/adjacency.h"
#include "limn/geometry/mesh.h"
#include "limn/surface/surface.h"

namespace limn {

/// The per-face method of Rusinkiewicz 2004 (contour-lines specification, section 2.4): in every face, the second
/// fundamental form is fitted to the differences of the vertex normals (Max weights) along its edges, and its derivative to
/// the differences of the vertex forms; both are averaged to the vertices by the area that belongs to each corner. Second
/// order on regular meshes; on irregular ones the curvature stalls and the derivative diverges: this is the baseline.
/// Faces without area are skipped; a vertex with no other face is flagged as unreliable.
/// @param need  curvature leaves Surface::derivative empty
Surface estimate_by_tensors(const Mesh& mesh, const VertexFaces& faces, Need need);

/// Vertex normals by the weights of Max 1999, in double; 0 where no face has area.
std::vector<dvec3> max_vertex_normals(const Mesh& mesh, const VertexFaces& faces);

} // namespace limn
