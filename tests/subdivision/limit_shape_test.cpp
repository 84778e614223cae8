#include <gtest/gtest.h>

#include "limn/subdivision/limit_shape.h"
#include "limn/subdivision/patch_neighbourhood.h"
#include "limn/subdivision/refined_place.h"
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
                const PatchPoint point = corner_place(f, k, levels);
                ASSERT_LT(glm::distance(shape.limit.position(point), limit.positions[fine.topology.triangles[f][k]]), 1e-7)
                    << name << ", face " << f << ", corner " << k << ", at " << point.v << ", " << point.w;
                ASSERT_LT(degrees_between(shape.limit.normal(point), limit.normals[3 * f + std::uint32_t(k)]), 1e-4)
                    << name << ", face " << f << ", corner " << k << ", at " << point.v << ", " << point.w;
            }
    }
}

/// A place `levels` steps down, found by following only the faces around it: parameters are multiples of 2^-levels.
struct Followed {
    dvec3 position, normal;
};
Followed followed(const Shape& shape, std::uint32_t face, const dvec2& at, int levels)
{
    LoopTopology t = shape.control.topology;
    std::vector<dvec3> positions = shape.control.positions;
    dvec3 place(1 - at.x - at.y, at.x, at.y);
    for (int i = 0; i < levels; ++i) {
        const Neighbourhood around = neighbourhood_of(t, face);
        std::vector<dvec3> local;
        for (const std::uint32_t v : around.vertices)
            local.push_back(positions[v]);
        positions = refine_positions(around.topology, local);
        t = refine(around.topology);
        const int k = place.x >= 0.5 ? 0 : place.y >= 0.5 ? 1 : place.z >= 0.5 ? 2 : 3;
        const dvec3 p = place;
        place = k == 3 ? dvec3(1) - 2.0 * dvec3(p.z, p.x, p.y) : dvec3(2 * p[k] - 1, 2 * p[(k + 1) % 3], 2 * p[(k + 2) % 3]);
        face = std::uint32_t(k);
    }
    const std::uint32_t corner = place.x > 0.5 ? 0 : place.y > 0.5 ? 1 : 2;
    EXPECT_NEAR(place[int(corner)], 1, 1e-9);
    const LimitPoint limit = limit_point(t, positions, 3 * face + corner);
    return {limit.position, limit.normal};
}

/// Against twelve levels of subdivision around the place, with limit masks: within 1e-6 of an edge and 1e-4 degrees.
TEST(LimitShape, IsWhatTwelveLevelsOfSubdivisionArePushedTo)
{
    const int levels = 12;
    const double steps = std::exp2(levels);
    for (std::uint32_t n = 3; n <= 12; ++n)
        for (const std::uint32_t sharp : {0u, 1u, 2u, 3u})
            for (const float sharpness : {10.0f, 2.3f}) {
                const Shape shape(shaken(tagged_pyramid(n, sharp, sharpness), 0.05, n));
                const double edge = glm::distance(shape.control.positions[0], shape.control.positions[2]);
                for (std::uint32_t i = 0; i < 40; ++i) {
                    Random random(n, i);
                    const double reach = i % 4 == 0 ? 1 : std::exp2(-double(i % 4) * 3);
                    double v = std::floor(random.uniform(0, reach) * steps) / steps, w = i % 5 == 0 ? 0 : std::floor(random.uniform(0, reach) * steps) / steps;
                    if (v + w > 1)
                        v = 1 - v, w = 1 - w;
                    const std::uint32_t face = i % std::uint32_t(shape.control.topology.triangles.size());
                    const Followed truth = followed(shape, face, {v, w}, levels);
                    ASSERT_LT(glm::distance(shape.limit.position({face, v, w}), truth.position), 1e-6 * edge) << n << ", " << sharp << " sharp, at " << v << ", " << w;
                    ASSERT_LT(degrees_between(shape.limit.normal({face, v, w}), truth.normal), 1e-4) << n << ", " << sharp << " sharp, at " << v << ", " << w;
                }
            }
}

/// Derivatives are those of differences, also across the patches of a tree.
TEST(LimitShape, HasTheDerivativesOfItsPositions)
{
    const double step = 1e-3;
    for (const auto& [name, mesh] : various_meshes()) {
        const Shape shape(mesh);
        for (const dvec2& at : {dvec2(0.13, 0.19), dvec2(0.81, 0.07), dvec2(0.11, 0.83), dvec2(0.30, 0.37), dvec2(0.04, 0.03)}) {
            const PatchPoint point{2 % std::uint32_t(mesh.triangles.size()), at.x, at.y};
            const LimitJet jet = shape.limit.jet(point);
            const auto near = [&](double dv, double dw) { return shape.limit.jet({point.face, at.x + dv, at.y + dw}); };
            const auto after_v = [&](dvec3 LimitJet::*of) { return (near(step, 0).*of - near(-step, 0).*of) / (2 * step); };
            const auto after_w = [&](dvec3 LimitJet::*of) { return (near(0, step).*of - near(0, -step).*of) / (2 * step); };
            const double third = glm::length(jet.dvvv) + glm::length(jet.dvvw) + glm::length(jet.dvww) + glm::length(jet.dwww);
            const double rounding = 1e-9, within = rounding + 2e-5 * (1 + third);
            EXPECT_LT(glm::distance(jet.dv, after_v(&LimitJet::position)), within) << name;
            EXPECT_LT(glm::distance(jet.dw, after_w(&LimitJet::position)), within) << name;
            EXPECT_LT(glm::distance(jet.dvv, after_v(&LimitJet::dv)), within * 100) << name;
            EXPECT_LT(glm::distance(jet.dvw, after_v(&LimitJet::dw)), within * 100) << name;
            EXPECT_LT(glm::distance(jet.dww, after_w(&LimitJet::dw)), within * 100) << name;
            EXPECT_LT(glm::distance(jet.dvvv, after_v(&LimitJet::dvv)), within * 1000) << name;
            EXPECT_LT(glm::distance(jet.dvvw, after_w(&LimitJet::dvv)), within * 1000) << name;
            EXPECT_LT(glm::distance(jet.dvww, after_v(&LimitJet::dww)), within * 1000) << name;
            EXPECT_LT(glm::distance(jet.dwww, after_w(&LimitJet::dww)), within * 1000) << name;
            EXPECT_LT(degrees_between(jet.normal, glm::cross(jet.dv, jet.dw)), 1e-6) << name;
        }
    }
}

/// Near extraordinary vertices derivatives are held, in the direction of the place.
TEST(LimitShape, HoldsItsDerivativesNearExtraordinaryVertices)
{
    const Shape shape(shaken(double_pyramid(9), 0.05));
    const double reach = std::exp2(-LimitShape::held_at);
    const LimitJet held = shape.limit.jet({0, 0.25 * reach, 0.75 * reach}), nearer = shape.limit.jet({0, 0.25e-9, 0.75e-9});
    EXPECT_LT(glm::distance(held.dvv, nearer.dvv), 1e-9 * glm::length(held.dvv));
    EXPECT_LT(glm::distance(held.dv, nearer.dv), 1e-9 * glm::length(held.dv));
    EXPECT_GT(degrees_between(held.normal, nearer.normal), 0.01);
    EXPECT_TRUE(std::isfinite(glm::length(shape.limit.jet({0, 0, 0}).dvv)));
}

/// One table serves every pose.
TEST(LimitShape, OfAnotherPoseIsThatOfANewTable)
{
    const Mesh mesh = shaken(tagged_pyramid(7, 2), 0.05, 1), moved = shaken(tagged_pyramid(7, 2), 0.3, 2);
    const Shape first(mesh), second(moved);
    const LimitShape posed(first.table, moved.positions);
    for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f)
        EXPECT_EQ(posed.position({f, 0.2, 0.3}), second.limit.position({f, 0.2, 0.3}));
}

} // namespace
} // namespace limn::test
