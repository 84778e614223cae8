#include "limn/terrain/terrain_surface.h"

#include <cmath>

#include <gtest/gtest.h>

#include "limn/surface/surface_point.h"
#include "limn/terrain/terrain_mesh.h"

namespace limn {
namespace {

constexpr double width = 120, depth = 80; ///< of a wave, metres: long against the spacing of 5 and 8 m

template <class T> T wave(const T& x, const T& y)
{
    using std::cos, std::sin;
    return 30.0 * sin((1 / width) * x) * cos((1 / depth) * y);
}

HeightMap wavy_map()
{
    HeightMap map;
    map.columns = 60, map.rows = 50, map.spacing = {5, 8};
    map.heights.resize(60 * 50);
    for (int row = 0; row < map.rows; ++row)
        for (int column = 0; column < map.columns; ++column) {
            const dvec3 p = map.position(column, row);
            map.heights[map.index(column, row)] = float(wave(p.x, p.y));
        }
    return map;
}

TEST(TerrainSurface, HasTheCurvaturesOfTheHeightsAndTheirDerivative)
{
    const HeightMap map = wavy_map();
    const Mesh mesh = terrain_mesh_within(map, 0);
    const Surface surface = terrain_surface(map, mesh, Need::derivative);
    int inner = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const dvec3& p = mesh.positions[i];
        if (p.x < 15 || p.y < 20 || p.x > 280 || p.y > 370)
            continue;
        ++inner;
        const Taylor u = Taylor::u(p.x), v = Taylor::v(p.y);
        const SurfacePoint truth = surface_point({u, v, wave(u, v)});
        ASSERT_LT(glm::distance(dvec3(surface.normals[i]), truth.normal), 2e-3);
        const dmat3 shape = double(surface.k1[i]) * glm::outerProduct(dvec3(surface.e1[i]), dvec3(surface.e1[i])) +
                            double(surface.k2[i]) * glm::outerProduct(dvec3(surface.e2[i]), dvec3(surface.e2[i]));
        const dmat3 off = shape - truth.shape_operator();
        for (int c = 0; c < 3; ++c)
            ASSERT_LT(glm::length(off[c]), 1e-4) << "of curvatures up to 0.005";
        SurfacePoint found;
        found.e1 = dvec3(surface.e1[i]), found.e2 = dvec3(surface.e2[i]), found.derivative = dvec4(surface.derivative[i]);
        for (const dvec3& w : {truth.e1, truth.e2})
            ASSERT_NEAR(found.derivative_along(w, w, w), truth.derivative_along(w, w, w), 4e-6) << "of derivatives up to 6e-5";
    }
    EXPECT_GT(inner, 1500);
}

TEST(TerrainSurface, IsExactOnPlanesUpToBordersAndHoles)
{
    HeightMap map = wavy_map();
    for (int row = 0; row < map.rows; ++row)
        for (int column = 0; column < map.columns; ++column)
            map.heights[map.index(column, row)] = float(3 * column - 8 * row); // whole numbers: no rounding
    const Mesh whole = terrain_mesh_within(map, 0);
    const Surface surface = terrain_surface(map, whole, Need::curvature);
    const dvec3 normal = glm::normalize(dvec3(-3.0 / 5, -1, 1));
    for (std::size_t i = 0; i < whole.positions.size(); ++i) {
        EXPECT_LT(glm::distance(dvec3(surface.normals[i]), normal), 1e-6);
        EXPECT_LT(std::abs(surface.k1[i]), 1e-9f);
    }
    EXPECT_TRUE(surface.derivative.empty());
    map.heights[map.index(20, 20)] = std::nanf("");
    const Mesh holed = terrain_mesh_within(map, 0);
    for (const vec3& n : terrain_surface(map, holed, Need::normals).normals)
        EXPECT_LT(glm::distance(dvec3(n), normal), 1e-2); // the hole's membrane is nearly the plane
}

} // namespace
} // namespace limn
