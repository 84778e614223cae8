#include "silhouette_subject.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "limn/subdivision/control_samples.h"
#include "limn/surface/shapes.h"

using namespace limn;

namespace {

constexpr std::size_t torus_triangles = 96;

Mesh octahedron()
{
    Mesh mesh;
    mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    return mesh;
}

bool is_control_sample(const std::string& name)
{
    const std::vector<std::string>& names = control_sample_names();
    return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

SilhouetteSubject::SilhouetteSubject(const Mesh& mesh)
    : control_(make_control_mesh(mesh)), table_(control_.topology), exact_(pose_silhouette(table_, control_.positions)),
      seed_surface_(make_seed_surface(control_.topology, 8)), seed_(make_seed_pose(seed_surface_, control_.positions))
{
    for (const dvec3& p : exact_.corners.positions)
        bounds_.add(p);
}

const std::vector<std::string>& silhouette_model_names()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all = control_sample_names();
        all.insert(all.end(), {"octahedron", "torus"});
        return all;
    }();
    return names;
}

Mesh silhouette_model(const std::string& name, std::size_t triangles)
{
    if (is_control_sample(name))
        return make_control_sample(name);
    if (name == "octahedron")
        return octahedron();
    return make_shape({.name = name, .triangles = name == "torus" && triangles == 0 ? torus_triangles : triangles}).mesh;
}

std::vector<Camera> silhouette_views(const Bounds& bounds, int count, int pixels)
{
    constexpr double golden = 137.50776405, golden_part = 0.6180339887;
    std::vector<Camera> cameras;
    for (int i = 0; i < count; ++i) {
        const double height = std::fmod(0.5 + i * golden_part, 1.0) * 1.9 - 0.95;
        Framing framing;
        framing.view = fmt::format("{},{}", std::fmod(17 + golden * i, 360), std::asin(height) * 180 / std::numbers::pi);
        framing.size = {pixels, pixels};
        cameras.push_back(Camera::framing(bounds, framing));
    }
    return cameras;
}

Eye eye_of(const Camera& camera) { return {camera.orthographic ? dvec4(-camera.forward(), 0) : dvec4(camera.eye, 1)}; }
