#include "limn/terrain/shading_tiles.h"

#include <set>

#include <gtest/gtest.h>

#include "limn/terrain/terrain_pyramid.h"
#include "terrain/pyramid_support.h"

namespace limn::test {
namespace {

Camera low_camera(const HeightMap& map)
{
    Camera camera;
    camera.eye = {0.2 * map.columns, 0.1 * map.rows, 90};
    camera.look = {0.5 * map.columns, 0.8 * map.rows, 0};
    camera.up = {0, 0, 1};
    camera.size = {400, 300};
    return camera;
}

dvec2 heights_in(const HeightMap& map, const PyramidLayout& layout, const TileId& id)
{
    const ivec2 first = layout.first_sample(id);
    dvec2 heights(1e300, -1e300);
    for (int y = first.y; y <= first.y + layout.tile_samples(id.level); ++y)
        for (int x = first.x; x <= first.x + layout.tile_samples(id.level); ++x)
            if (map.contains(x, y))
                heights = {std::min(heights.x, double(map.height(x, y))), std::max(heights.y, double(map.height(x, y)))};
    return heights;
}

// For every sample that is seen there is a tile whose points are near enough in the picture, or the finest one.
TEST(ShadingTiles, AreFineEnoughWhereverSomethingIsSeen)
{
    const HeightMap map = rough_terrain(1300, 1100);
    const PyramidLayout layout(make_lattice(map.columns, map.rows));
    ASSERT_GE(layout.levels(), 2);
    for (const bool orthographic : {false, true}) {
        Camera camera = low_camera(map);
        camera.orthographic = orthographic;
        camera.ortho_height = 350;
        const std::vector<TileId> tiles =
            shading_tiles(map, layout, camera, 1.5, [&](const TileId& id) { return heights_in(map, layout, id); });
        std::set<std::size_t> there;
        for (const TileId& id : tiles)
            there.insert(layout.index(id));
        EXPECT_EQ(there.size(), tiles.size());
        EXPECT_LT(tiles.size(), layout.tile_count());
        std::size_t seen = 0;
        int finest = layout.top();
        for (int y = 0; y < map.rows; y += 7)
            for (int x = 0; x < map.columns; x += 7) {
                const Projected p = camera.project(map.position(x, y));
                if ((!orthographic && p.depth < 1) || p.pixel.x < 0 || p.pixel.y < 0 || p.pixel.x >= camera.size.x ||
                    p.pixel.y >= camera.size.y)
                    continue;
                ++seen;
                int level = layout.top();
                const auto has = [&](int l) {
                    return there.contains(layout.index({l, glm::min(ivec2(x, y) / layout.tile_samples(l), layout.tiles(l) - 1)}));
                };
                ASSERT_TRUE(has(level));
                while (level > 0 && has(level - 1))
                    --level;
                finest = std::min(finest, level);
                EXPECT_TRUE(level == 0 || (1 << level) * camera.pixels_per_unit(p.depth) <= 1.5) << x << ' ' << y << " at level " << level;
            }
        EXPECT_GT(seen, 300u);
        EXPECT_LT(finest, layout.top());
    }
}

TEST(ShadingTiles, LeaveOutWhatIsBehindTheEyeAndWhatHasNoData)
{
    const HeightMap map = rough_terrain(1300, 1100);
    const PyramidLayout layout(make_lattice(map.columns, map.rows));
    Camera camera = low_camera(map);
    const std::size_t tops = std::size_t(layout.tiles(layout.top()).x) * std::size_t(layout.tiles(layout.top()).y);
    const auto count = [&](const TileHeights& heights) { return shading_tiles(map, layout, camera, 0.1, heights).size(); };
    const std::size_t whole = count([](const TileId&) { return dvec2(-50, 50); });
    EXPECT_EQ(count([](const TileId&) { return dvec2(1, -1); }), tops);
    camera.eye = {-100, -100, 90}, camera.look = {-500, -500, 0};
    EXPECT_EQ(count([](const TileId&) { return dvec2(-50, 50); }), tops);
    EXPECT_GT(whole, tops);
}

TEST(TileNormals, AreThoseOfCentralDifferencesOnTheirLevel)
{
    HeightMap map = holey_terrain(300, 280);
    map.spacing = {2, 3};
    const PyramidLayout layout(make_lattice(map.columns, map.rows));
    for (const int level : {0, layout.top()}) {
        const TileId id = {level, {0, 0}};
        const TerrainTile tile = tile_of_map(map, layout, id);
        const std::vector<std::uint32_t> normals = tile_normals(tile, map.spacing, 1.5);
        ASSERT_EQ(normals.size(), std::size_t(tile.points) * std::size_t(tile.points));
        std::size_t compared = 0;
        const auto has = [&](int x, int y) { return map.contains(x, y) && map.has_data(x, y); };
        for (int y = 1; y < tile.points - 1; ++y)
            for (int x = 1; x < tile.points - 1; ++x) {
                const int s = tile.stride, c = s * x, r = s * y;
                if (!has(c - s, r) || !has(c + s, r) || !has(c, r - s) || !has(c, r + s))
                    continue;
                const double east = 1.5 * (double(map.height(c + s, r)) - double(map.height(c - s, r))) / (2 * s * 2);
                const double north = 1.5 * (double(map.height(c, r - s)) - double(map.height(c, r + s))) / (2 * s * 3);
                const dvec3 n = glm::normalize(dvec3(-east, -north, 1));
                const std::uint32_t packed = normals[std::size_t(y) * std::size_t(tile.points) + std::size_t(x)];
                EXPECT_NEAR(std::int16_t(packed & 0xffff) / 32767.0, n.x, 2e-5);
                EXPECT_NEAR(std::int16_t(packed >> 16) / 32767.0, n.y, 2e-5);
                ++compared;
            }
        EXPECT_GT(compared, 100u);
    }
}

TEST(TileNormals, OfAMapAreThoseOfItsPyramid)
{
    const HeightMap map = holey_terrain(700, 560);
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "t.pyramid";
    build_pyramid(rows_of(map), path);
    const TerrainPyramid pyramid(path);
    const PyramidLayout& layout = pyramid.layout();
    for (int level = 0; level < layout.levels(); ++level) {
        const TileId id = {level, layout.tiles(level) / 2};
        EXPECT_EQ(tile_normals(tile_of_map(map, layout, id), map.spacing, 1), tile_normals(pyramid.read(id), map.spacing, 1)) << level;
    }
}

} // namespace
} // namespace limn::test
