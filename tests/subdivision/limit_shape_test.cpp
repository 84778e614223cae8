#include <gtest/gtest.h>

#include "limn/subdivision/limit_shape.h"
#include "subdivision/control_meshes.h"

namespace limn::test {
namespace {

double degrees_between(const dvec3& a, const dvec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi; }

/// A control mesh with all that its limit surface needs.
struct Shape {
    ControlMesh control;
    PatchTable table;
    LimitShape limit;
    explicit Shape(const Mesh& mesh) : control(make_control_mesh(mesh)), table(control.topology), limit(table, control.positions) {}
};

/// The parameters, in its control face, of corner k of a face some levels down.
dvec2 corner_parameters(std::uint32_t face, int k, int levels)
{
    dvec3 corners[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = levels - 1; i >= 0; --i) {
        const dvec3 middle[3] = {0.5 * (corners[0] + corners[1]), 0.5 * (corners[1] + corners[2]), 0.5 * (corners[2] + corners[0])};
        const int child = int(face >> (2 * i)) & 3;
        if (child == 3) {
            std::copy(middle, middle + 3, corners);
        } else {
            const dvec3 own = corners[child], next = middle[child], last = middle[(child + 2) % 3];
            corners[0] = own, corners[1] = next, corners[2] = last;
        }
    }
    return {corners[k].y, corners[k].z};
}

/// At the corners of a mesh some levels down: the same position, and the same normal on each side of creases.
TEST(LimitShape, IsWhatAFinerMeshIsPushedTo)
{
    const int levels = 4;
    for (const auto& [name, mesh] : various_meshes()) {
        const Shape shape(mesh);
        const Refined fine = refined({shape.control.topology, shape.control.positions}, levels, CreaseRule::opensubdiv);
        const LimitSurface limit = limit_surface(fine.topology, fine.positions);
        for (std::uint32_t f = 0; f < fine.topology.triangles.size(); ++f)
            for (int k = 0; k < 3; ++k) {
                const dvec2 at = corner_parameters(f, k, levels);
                const PatchPoint point{f >> (2 * levels), at.x, at.y};
                ASSERT_LT(glm::distance(shape.limit.position(point), limit.positions[fine.topology.triangles[f][k]]), 1e-7)
                    << name << ", face " << f << ", corner " << k << ", at " << at.x << ", " << at.y;
                ASSERT_LT(degrees_between(shape.limit.normal(point), limit.normals[3 * f + std::uint32_t(k)]), 1e-4)
                    << name << ", face " << f << ", corner " << k << ", at " << at.x << ", " << at.y;
            }
    }
}

} // namespace
} // namespace limn::test
