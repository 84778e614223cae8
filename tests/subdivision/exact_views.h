#pragma once

#include <memory>

#include "limn/base/parallel.h"
#include "limn/subdivision/contour_cells.h"
#include "limn/subdivision/control_samples.h"
#include "limn/subdivision/exact_silhouette.h"
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

/// The limit surface as triangles that are nearer to it than a part of a pixel in pictures like a camera's: each face is cut in four until the
/// middles of the edges and of the triangle are that near to it. Triangles share no vertices; they gape by less than that.
class ReferenceMesh {
public:
    ReferenceMesh(const ExactSubject& subject, const Camera& camera, double pixels = 0.03) : shape_(subject.pose().shape)
    {
        double nearest = HUGE_VAL; // eye to surface, about
        for (const dvec3& p : subject.pose().corners.positions)
            nearest = std::min(nearest, camera.project(p).depth);
        near_ = pixels / camera.pixels_per_unit(nearest);
        rounded_ = beside_semi_sharp(subject.topology());
        std::vector<std::vector<dvec3>> corners(subject.topology().triangles.size());
        parallel_each(corners.size(), 4, [&](std::size_t f) { append(std::uint32_t(f), {dvec2(0, 0), dvec2(1, 0), dvec2(0, 1)}, 0, corners[f]); });
        for (const std::vector<dvec3>& of_face : corners)
            for (std::size_t i = 0; i < of_face.size(); i += 3) {
                const std::uint32_t first = std::uint32_t(mesh.positions.size());
                mesh.positions.insert(mesh.positions.end(), &of_face[i], &of_face[i] + 3);
                mesh.triangles.push_back({first, first + 1, first + 2});
            }
    }
    Mesh mesh;

private:
    void append(std::uint32_t face, const ParameterTriangle& at, int level, std::vector<dvec3>& out) const
    {
        const int least = rounded_[face] ? 5 : 3, most = 12;
        const auto position = [&](const dvec2& p) { return shape_.position({face, p.x, p.y}); };
        const dvec3 p[3] = {position(at[0]), position(at[1]), position(at[2])};
        double off = glm::distance(position((at[0] + at[1] + at[2]) / 3.0), (p[0] + p[1] + p[2]) / 3.0);
        for (std::size_t k = 0; k < 3; ++k)
            off = std::max(off, glm::distance(position(0.5 * (at[k] + at[(k + 1) % 3])), 0.5 * (p[k] + p[(k + 1) % 3])));
        if (level >= least && (off <= near_ || level == most)) {
            out.insert(out.end(), p, p + 3);
            return;
        }
        for (const ParameterTriangle& quarter : quarters(at))
            append(face, quarter, level + 1, out);
    }

    /// Per face: whether an edge at one of its corners is semi-sharp, beside which the surface has narrow features.
    static std::vector<bool> beside_semi_sharp(const LoopTopology& t)
    {
        std::vector<bool> vertex(t.vertex_count()), face(t.triangles.size());
        for (std::uint32_t e = 0; e < t.edge_count(); ++e)
            if (t.sharpness[e] > 0 && t.sharpness[e] < infinitely_sharp)
                vertex[t.start(t.half_edge[e])] = vertex[t.end(t.half_edge[e])] = true;
        for (std::size_t f = 0; f < face.size(); ++f)
            face[f] = vertex[t.triangles[f].x] || vertex[t.triangles[f].y] || vertex[t.triangles[f].z];
        return face;
    }

    const LimitShape& shape_;
    double near_ = 0;
    std::vector<bool> rounded_;
};

} // namespace limn::test
