#pragma once

#include <memory>
#include <string>
#include <vector>

#include "limn/camera/camera.h"
#include "limn/subdivision/exact_silhouette.h"
#include "limn/subdivision/seed_silhouette.h"

/// A control mesh with all that its silhouettes need, of both kinds.
class SilhouetteSubject {
public:
    explicit SilhouetteSubject(const limn::Mesh& mesh);
    SilhouetteSubject(const SilhouetteSubject&) = delete;
    SilhouetteSubject& operator=(const SilhouetteSubject&) = delete;

    const limn::ControlMesh& control() const { return control_; }
    const limn::PatchTable& table() const { return table_; }
    const limn::SilhouettePose& exact() const { return exact_; }
    const limn::SeedSurface& seed_surface() const { return seed_surface_; }
    const limn::SeedPose& seed() const { return seed_; }
    const limn::Bounds& bounds() const { return bounds_; } ///< of the vertices on the limit surface

private:
    limn::ControlMesh control_;
    limn::PatchTable table_;
    limn::SilhouettePose exact_;
    limn::SeedSurface seed_surface_;
    limn::SeedPose seed_;
    limn::Bounds bounds_;
};

/// The control meshes of `limn sample`, an octahedron and a torus of 96 triangles.
const std::vector<std::string>& silhouette_model_names();
/// One of them, or a shape of `limn sample` of about so many triangles.
/// @throws limn::Error::Input for an unknown name
limn::Mesh silhouette_model(const std::string& name, std::size_t triangles);

/// Views all around, square pictures in perspective, that have nothing to do with the axes.
std::vector<limn::Camera> silhouette_views(const limn::Bounds& bounds, int count, int pixels);
/// The eye of a camera as the seed's search takes it.
limn::Eye eye_of(const limn::Camera& camera);
