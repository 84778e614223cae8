#pragma once

#include <algorithm>

#include "limn/subdivision/seed_silhouette.h"
#include "subdivision/control_meshes.h"

namespace limn::test {

inline Mesh icosahedron()
{
    const double g = (1 + std::sqrt(5.0)) / 2;
    Mesh mesh;
    mesh.positions = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g}, {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
    mesh.triangles = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                      {3, 9, 4}, {3, 4, 2}, {3, 2, 6}, {3, 6, 8}, {3, 8, 9}, {4, 9, 5}, {2, 4, 11}, {6, 2, 10}, {8, 6, 7}, {9, 8, 1}};
    for (dvec3& p : mesh.positions)
        p = glm::normalize(p);
    return mesh;
}

/// A mesh refined once, as a control mesh of its own.
inline Mesh subdivided(const Mesh& mesh)
{
    const Refined once = refined(mesh, 1);
    Mesh out;
    out.positions = once.positions;
    out.triangles = once.topology.triangles;
    return out;
}

/// A place at a distance from the origin, or for parallel projection a direction.
inline Eye random_eye(std::uint64_t seed, std::uint64_t number, double distance = 5, bool parallel = false)
{
    Random random(seed, number);
    const double z = random.uniform(-1, 1), angle = random.uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
    const dvec3 direction(r * std::cos(angle), r * std::sin(angle), z);
    return parallel ? Eye{dvec4(direction, 0)} : Eye{dvec4(distance * direction, 1)};
}

/// A control mesh with all that a search needs.
struct Posed {
    SeedSurface surface;
    SeedPose at;
};
inline Posed posed(const Mesh& mesh, int levels = 5)
{
    ControlMesh control = make_control_mesh(mesh);
    Posed out{make_seed_surface(std::move(control.topology), levels), {}};
    out.at = make_seed_pose(out.surface, control.positions);
    return out;
}

/// Of the box around the vertices on the limit surface.
inline double largest_side(const Posed& p)
{
    Mesh mesh;
    mesh.positions = p.at.positions;
    mesh.triangles = p.surface.topology.triangles;
    const dvec3 size = mesh.bounds().size();
    return std::max({size.x, size.y, size.z});
}

/// |cos| of the angle between a crossing's normal and the direction to the eye.
inline double off_contour(const Eye& eye, const SeedCrossing& c)
{
    return std::abs(glm::dot(glm::normalize(eye.from(c.position)), c.normal));
}

/// The meshes of the table in section 4 of the specification.
struct Measured {
    std::string name;
    Mesh mesh;
    std::vector<double> error; ///< the largest of crossings at depth 1 to 6, in percent of the limit surface's largest side; over 6 views
};
inline std::vector<Measured> measured_meshes()
{
    return {{"octahedron", octahedron(), {1.74, .42, .13, .038, .009, .003}},
            {"icosahedron", icosahedron(), {1.00, .30, .094, .014, .006, .001}},
            {"torus 8x6", torus(8, 6, 1, 0.45), {1.00, .21, .060, .012, .004, .0008}},
            {"torus 12x8", torus(12, 8, 1, 0.45), {.80, .14, .038, .014, .003, .0007}},
            {"torus 8x6 once subdivided", subdivided(torus(8, 6, 1, 0.45)), {.58, .050, .017, .008, .003, .0002}}};
}

} // namespace limn::test
