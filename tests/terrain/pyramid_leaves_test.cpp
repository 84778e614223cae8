#include "limn/terrain/pyramid_leaves.h"

#include <gtest/gtest.h>

#include "limn/base/parallel.h"
#include "limn/terrain/bisection.h"
#include "limn/terrain/length_test.h"
#include "limn/terrain/measure_terrain.h"
#include "limn/terrain/terrain_mesh.h"
#include "terrain/pyramid_support.h"

namespace limn::test {
namespace {

constexpr std::size_t plenty = std::size_t(1) << 30;

/// A camera above the map that looks across it.
Camera camera_over(const HeightMap& map)
{
    Camera camera;
    camera.eye = {-0.1 * map.columns * map.spacing.x, -0.2 * map.rows * map.spacing.y, 90};
    camera.look = {0.7 * map.columns * map.spacing.x, 0.5 * map.rows * map.spacing.y, 0};
    camera.up = {0, 0, 1};
    camera.size = {640, 400};
    return camera;
}

void expect_same_mesh(const Mesh& found, const Mesh& wanted)
{
    EXPECT_EQ(found.positions, wanted.positions);
    EXPECT_EQ(found.triangles, wanted.triangles);
}

class PyramidLeaves : public testing::TestWithParam<int> {
protected:
    PyramidLeaves()
        : map_(GetParam() == 0   ? rough_terrain(1025, 1025)
               : GetParam() == 1 ? holey_terrain(1000, 700)
                                 : rough_terrain(130, 77))
    {
        map_.spacing = {1, 1.25};
        build_pyramid(rows_of(map_), folder_.path() / "t.pyramid");
        pyramid_ = std::make_unique<TerrainPyramid>(folder_.path() / "t.pyramid");
    }
    HeightMap map_;
    std::unique_ptr<TerrainPyramid> pyramid_;

private:
    TemporaryFolder folder_;
};

TEST_P(PyramidLeaves, MakeTheMeshesOfTheWholeMapTriangleForTriangle)
{
    const NestedErrors errors = nest_errors(map_, {.ranges = true});
    TileCache tiles(*pyramid_, plenty);
    for (const double tolerance : {3.0, 20.0, 1000.0}) {
        SCOPED_TRACE(tolerance);
        expect_same_mesh(pyramid_mesh(*pyramid_, pyramid_leaves(tiles, metric_test(*pyramid_, tolerance))),
                         terrain_mesh(map_, errors.lattice, triangles_within(errors, tolerance)));
        const LengthTest is_too_long(map_, 40);
        expect_same_mesh(pyramid_mesh(*pyramid_, pyramid_leaves(tiles, metric_test(*pyramid_, tolerance, 40))),
                         terrain_mesh(map_, errors.lattice, find_leaves(errors.lattice, [&](const BisectionTriangle& t) {
                                          return double(errors.error(t.middle())) > tolerance || is_too_long(t);
                                      })));
    }
    for (const double pixels : {3.0, 20.0}) {
        SCOPED_TRACE(pixels);
        const Mesh mesh = pyramid_mesh(*pyramid_, pyramid_leaves(tiles, view_test(*pyramid_, camera_over(map_), {.pixels = pixels})));
        expect_same_mesh(mesh, terrain_mesh(map_, errors.lattice, triangles_in_view(map_, errors, camera_over(map_), {.pixels = pixels})));
        EXPECT_EQ(measure_terrain(map_, mesh, pixels, camera_over(map_)).over, 0u);
    }
}

TEST_P(PyramidLeaves, AreTheSameForAnyNumberOfThreadsAndAnyBudget)
{
    TileCache all(*pyramid_, plenty), none(*pyramid_, 0), few(*pyramid_, 3 << 20);
    const PyramidTest test = view_test(*pyramid_, camera_over(map_), {.pixels = 4});
    const Mesh wanted = pyramid_mesh(*pyramid_, pyramid_leaves(all, test));
    for (TileCache* tiles : {&none, &few})
        for (const int threads : {1, 2}) {
            with_threads(threads, [&] { expect_same_mesh(pyramid_mesh(*pyramid_, pyramid_leaves(*tiles, test)), wanted); });
            EXPECT_LE(tiles->most_bytes(), tiles->budget());
        }
}

TEST_P(PyramidLeaves, KeepTheBoundWithExaggeratedHeights)
{
    HeightMap taller = map_;
    for (float& height : taller.heights)
        height = float(2.3 * double(height));
    TileCache tiles(*pyramid_, plenty);
    const MeasuredTerrain metres =
        measure_terrain(taller, pyramid_mesh(*pyramid_, pyramid_leaves(tiles, metric_test(*pyramid_, 8, 0, 2.3)), 2.3), 8);
    EXPECT_EQ(metres.over, 0u);
    EXPECT_GT(metres.maximum, 6);
    const Mesh mesh = pyramid_mesh(*pyramid_, pyramid_leaves(tiles, view_test(*pyramid_, camera_over(map_), {.pixels = 4}, 0, 2.3)), 2.3);
    EXPECT_EQ(measure_terrain(taller, mesh, 4, camera_over(map_)).over, 0u);
}

/// Of a coarse view, and of one of a corner.
TEST_P(PyramidLeaves, ReadOnlyTilesThatMayMatter)
{
    if (GetParam() == 2)
        GTEST_SKIP() << "has few tiles";
    const std::size_t all = pyramid_->layout().tile_count();
    for (const bool corner : {false, true}) {
        TileCache tiles(*pyramid_, plenty);
        Camera camera = camera_over(map_);
        if (corner)
            camera.eye = {30, 30, 60}, camera.look = {0, 0, 0};
        const std::size_t before = pyramid_->tiles_read();
        pyramid_leaves(tiles, view_test(*pyramid_, camera, {.pixels = corner ? 1.0 : 40.0}));
        EXPECT_LE(pyramid_->tiles_read() - before, all / 2) << corner;
    }
}

INSTANTIATE_TEST_SUITE_P(Maps, PyramidLeaves, testing::Values(0, 1, 2));

} // namespace
} // namespace limn::test
