#pragma once

#include "limn/geometry/mesh.h"
#include "limn/surface/jet_fit.h"
#include "limn/surface/neighbours.h"
#include "limn/surface/surface.h"

namespace limn {

/// What jet fits read of a mesh: its positions, who is beside whom, and which side is out.
struct JetContext {
    std::span<const dvec3> positions;
    Neighbours neighbours;
    std::vector<dvec3> normals; ///< area-weighted, unit; zero where no face has area
};
JetContext make_jet_context(const Mesh& mesh, const VertexFaces& faces);

/// A model and the neighbourhoods it is fitted to.
struct JetSetting {
    JetModel model;
    int rings = 2;
};

/// How many vertices needed another setting than the first, and for how many none was left.
struct JetCounts {
    std::size_t refitted = 0, failed = 0;
};

/// Fits every vertex. A vertex whose fit fails, or finds a normal more than 37 degrees from the faces', is fitted again with
/// one more ring, with two more, with degree 3, and with degree 2 (its derivative is then 0); after that it keeps the
/// area-weighted normal and is flagged as unreliable. Neighbours whose normals are turned by more than 60 degrees are left
/// out, but for the last attempt.
/// @param need  curvature leaves Surface::derivative empty
JetCounts fit_surface(const JetContext& context, const JetSetting& setting, Need need, Surface& surface);

} // namespace limn
