#include "limn/scene/terrain_picture.h"

#include <cmath>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/terrain/terrain_mesh.h"

namespace limn {
namespace {

HeightMap plane(double east, double north)
{
    HeightMap map;
    map.columns = 40, map.rows = 30;
    map.spacing = {10, 20};
    for (int row = 0; row < map.rows; ++row)
        for (int column = 0; column < map.columns; ++column)
            map.heights.push_back(float(east * 10 * column + north * 20 * (map.rows - 1 - row)));
    return map;
}

Camera from_above(const HeightMap& map)
{
    const Mesh mesh = terrain_mesh_within(map, 0);
    return Camera::framing(mesh.bounds(), {.view = "top", .up_axis = 'z', .size = {64, 64}, .orthographic = true});
}

TEST(TerrainPicture, HasTheNormalsOfPlanes)
{
    const HeightMap map = plane(0.5, -0.25);
    for (const dvec2& place : {dvec2(0, 0), dvec2(33, 47), dvec2(390, 580), dvec2(-50, 1e6)})
        EXPECT_LT(glm::distance(terrain_normal(map, place), glm::normalize(dvec3(-0.5, 0.25, 1))), 1e-6);
}

/// Ground that turns to the sun is brighter than level ground, and that than ground which turns away.
TEST(TerrainPicture, IsBrighterTowardsTheSun)
{
    const TerrainPictureOptions options = {.colours = TerrainPictureOptions::Colours::plain, .sun_azimuth = 90, .samples = 1};
    const auto middle = [&](double slope) {
        const HeightMap map = plane(slope, 0);
        return *paint_terrain(map, terrain_mesh_within(map, 0), from_above(map), options).at(32, 32);
    };
    EXPECT_LT(middle(0.3), middle(0) - 0.1); // rises to the east, where the sun is: turned away from it
    EXPECT_GT(middle(-0.3), middle(0) + 0.05);
}

TEST(TerrainPicture, ShowsTheBackgroundThroughHolesOnly)
{
    HeightMap map = plane(0.1, 0);
    for (int row = 10; row < 20; ++row)
        for (int column = 15; column < 25; ++column)
            map.heights[map.index(column, row)] = std::numeric_limits<float>::quiet_NaN();
    const TerrainPictureOptions options = {.samples = 1, .background = vec3(1, 0, 1)};
    const Image image = paint_terrain(map, terrain_mesh_within(map, 0), from_above(map), options);
    const auto is_background = [&](int x, int y) { return image.at(x, y)[1] == 0.0f; };
    EXPECT_TRUE(is_background(32, 32));
    EXPECT_TRUE(is_background(0, 0));
    EXPECT_FALSE(is_background(32, 12));
    const Image whole = paint_terrain(plane(0.1, 0), terrain_mesh_within(plane(0.1, 0), 0), from_above(map), options);
    for (int y = 14; y < 50; ++y)
        for (int x = 14; x < 50; ++x)
            EXPECT_NE(whole.at(x, y)[1], 0.0f);
}

/// A drape of four fields: each shows in its own quarter, and the ground's colour where it is transparent.
TEST(TerrainPicture, ShowsADrapeWhereItIsNotTransparent)
{
    const HeightMap map = plane(0, 0);
    Image drape(ivec2(2, 2), 4, 1.0f);
    const vec4 fields[] = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 0, 1, 0}};
    for (int i = 0; i < 4; ++i)
        std::copy(&fields[i].x, &fields[i].x + 4, drape.at(i % 2, i / 2));
    EXPECT_LT(glm::distance(draped_at(map, drape, {0, 580}), fields[0]), 1e-6f) << "north-west";
    EXPECT_LT(glm::distance(draped_at(map, drape, {390, 580}), fields[1]), 1e-6f) << "north-east";
    EXPECT_LT(glm::distance(draped_at(map, drape, {0, 0}), fields[2]), 1e-6f) << "south-west";
    EXPECT_LT(glm::distance(drape_place(map, {-5, 590}), dvec2(0)), 1e-12) << "half a cell outside of the first sample";
    const TerrainPictureOptions options = {.colours = TerrainPictureOptions::Colours::plain, .samples = 1};
    const Mesh mesh = terrain_mesh_within(map, 0);
    const Image bare = paint_terrain(map, mesh, from_above(map), options), draped = paint_terrain(map, mesh, from_above(map), options, &drape);
    const auto pixel = [](const Image& image, int x, int y) { return vec3(image.at(x, y)[0], image.at(x, y)[1], image.at(x, y)[2]); };
    EXPECT_GT(pixel(draped, 16, 10).r, 0.9f);
    EXPECT_LT(pixel(draped, 16, 10).g, 0.1f);
    EXPECT_GT(pixel(draped, 46, 10).g, 0.9f);
    EXPECT_GT(pixel(draped, 16, 54).b, 0.9f);
    EXPECT_LT(glm::distance(pixel(draped, 46, 54), pixel(bare, 46, 54)), 1e-6f);
}

TEST(TerrainPicture, IsTheSameForAnyNumberOfThreads)
{
    const HeightMap map = plane(0.2, 0.1);
    const Mesh mesh = terrain_mesh_within(map, 0);
    const auto painted = [&](int threads) { return with_threads(threads, [&] { return paint_terrain(map, mesh, from_above(map)).samples; }); };
    EXPECT_EQ(painted(1), painted(2));
}

TEST(TerrainPicture, RefusesNumbersOutOfRange)
{
    const HeightMap map = plane(0, 0);
    const Mesh mesh = terrain_mesh_within(map, 0);
    EXPECT_THROW(paint_terrain(map, mesh, from_above(map), {.samples = 0}), Error::Input);
    EXPECT_THROW(paint_terrain(map, mesh, from_above(map), {.sun_height = 91}), Error::Input);
}

} // namespace
} // namespace limn
