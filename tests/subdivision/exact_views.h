#pragma once

#include <memory>

#include "limn/subdivision/control_samples.h"
#include "limn/subdivision/exact_silhouette.h"
#include "limn/subdivision/limit_triangles.h"
#include "subdivision/control_meshes.h"

namespace limn::test {

/// A mesh with all that its exact silhouettes need.
class ExactSubject {
public:
    explicit ExactSubject(const Mesh& mesh) : ExactSubject(make_control_mesh(mesh)) {}
    explicit ExactSubject(const ControlMesh& control) : table_(std::make_unique<PatchTable>(control.topology)), pose_(pose_silhouette(*table_, control.positions)) {}

    const PatchTable& table() const { return *table_; }
    const LoopTopology& topology() const { return table_->control(); }
    const SilhouettePose& pose() const { return pose_; }
    void move_to(std::span<const dvec3> positions) { pose_ = pose_silhouette(*table_, positions); }
    /// The vertices on the limit surface.
    Bounds bounds() const
    {
        Bounds bounds;
        for (const dvec3& p : pose_.corners.positions)
            bounds.add(p);
        return bounds;
    }

private:
    std::unique_ptr<PatchTable> table_;
    SilhouettePose pose_;
};

/// Cameras all around a box, every other one of parallel projection; they have nothing to do with the axes.
inline Camera any_view(const Bounds& bounds, int number, int pixels = 1024)
{
    constexpr double golden = 137.50776405;
    const double height = std::fmod(0.5 + number * 0.6180339887, 1.0) * 1.9 - 0.95;
    Framing framing;
    framing.view = fmt::format("{},{}", std::fmod(17 + golden * number, 360), std::asin(height) * 180 / std::numbers::pi);
    framing.size = {pixels, pixels};
    framing.orthographic = number % 2 == 1;
    return Camera::framing(bounds, framing);
}

/// Straight along the axes and half-way between two of them, in parallel and in perspective: symmetrical meshes then have contours along edges
/// and through vertices.
inline std::vector<Camera> symmetric_views(const Bounds& bounds, int pixels = 1024)
{
    std::vector<Camera> cameras;
    for (const char* view : {"front", "right", "back", "top", "bottom", "45,0", "0,45", "30,0", "iso"})
        for (const bool orthographic : {true, false}) {
            Framing framing;
            framing.view = view;
            framing.size = {pixels, pixels};
            framing.orthographic = orthographic;
            cameras.push_back(Camera::framing(bounds, framing));
        }
    return cameras;
}

struct NamedMesh {
    std::string name;
    Mesh mesh;
};

/// The models that outlines are measured on.
inline std::vector<NamedMesh> outline_models()
{
    std::vector<NamedMesh> models;
    for (const std::string& name : control_sample_names())
        models.push_back({name, make_control_sample(name)});
    models.push_back({"octahedron", octahedron()});
    models.push_back({"torus", torus(8, 6, 1, 0.45)});
    return models;
}

/// The limit surface as triangles that are nearer to it than a part of a pixel in a camera's picture.
inline Mesh reference_mesh(const ExactSubject& subject, const Camera& camera, double pixels = 0.03)
{
    double nearest = HUGE_VAL;
    for (const dvec3& p : subject.pose().corners.positions)
        nearest = std::min(nearest, camera.project(p).depth);
    return limit_triangles(subject.pose().shape, pixels / camera.pixels_per_unit(nearest));
}

} // namespace limn::test
