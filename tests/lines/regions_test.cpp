#include <gtest/gtest.h>

#include "limn/lines/regions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limn/base/parallel.h"
#include "limn/drawing/trace.h"
#include "limn/lines/draw.h"
#include "limn/surface/shapes.h"

namespace limn {
namespace {

struct Seen {
    Shape shape;
    LineModel model;
    RayScene rays;

    Seen(const std::string& name, std::size_t triangles)
        : shape(make(name, triangles)), model(build(shape)), rays(build_ray_scene(model))
    {
    }
    SeenScene scene() const { return seen_scene(model, rays); }

private:
    static Shape make(const std::string& name, std::size_t triangles)
    {
        ShapeOptions options;
        options.name = name, options.triangles = triangles;
        return make_shape(options);
    }
    static LineModel build(const Shape& shape)
    {
        const PlacedSurface placed = {&shape.mesh, &shape.exact};
        return build_line_model({&placed, 1});
    }
};

/// Looks along -z, 100 pixels per unit; the origin is in the middle.
Camera along_axis(int size)
{
    Camera camera;
    camera.orthographic = true;
    camera.size = {size, size};
    camera.ortho_height = size / 100.0;
    return camera;
}

/// Largest deviation of a ring from the circle of that radius around the picture's centre; its points' chords included.
double deviation(const std::vector<dvec2>& ring, const Camera& camera, double radius)
{
    const dvec2 centre = 0.5 * dvec2(camera.size);
    double worst = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
        worst = std::max({worst, std::abs(glm::distance(a, centre) - radius), std::abs(glm::distance(0.5 * (a + b), centre) - radius)});
    }
    return worst;
}

TEST(SilhouetteRegion, OfASphereIsItsOutlineWithinATenthOfAPixel)
{
    const Seen seen("sphere", 200000);
    RegionOptions options;
    options.tolerance = 0.05;
    for (const double distance : {1.5, 4.0, 20.0}) {
        Camera camera;
        camera.eye = {0, 0, distance};
        camera.size = {400, 400};
        camera.fov_degrees = 2.6 * glm::degrees(std::asin(1 / distance));
        camera.fov_degrees = std::min(camera.fov_degrees, 120.0);
        const Region region = silhouette_region(seen.scene(), camera, options);
        const double radius = camera.pixels_per_unit(distance) * distance / std::sqrt(distance * distance - 1);
        EXPECT_EQ(region.name, "silhouette");
        ASSERT_EQ(region.rings.size(), 1u);
        EXPECT_LT(deviation(region.rings[0], camera, radius), 0.1) << distance;
        EXPECT_NEAR(std::sqrt(rings_area(region.rings) / std::numbers::pi), radius, 0.05) << distance;
    }
}

TEST(SilhouetteRegion, OfATorusSeenAlongItsAxisHasItsHole)
{
    const Seen seen("torus", 200000);
    const Camera camera = along_axis(320);
    const Region region = silhouette_region(seen.scene(), camera);
    ASSERT_EQ(region.rings.size(), 2u);
    EXPECT_GT(rings_area({region.rings[0]}), 0);
    EXPECT_LT(rings_area({region.rings[1]}), 0);
    EXPECT_LT(deviation(region.rings[0], camera, 140), 0.15); // 0.1 px of it is the simplification
    EXPECT_LT(deviation(region.rings[1], camera, 60), 0.15);
}

TEST(SilhouetteRegion, IsCutOffAtTheBorderOfThePicture)
{
    const Seen seen("sphere", 5000);
    const Camera camera = along_axis(100); // half a unit to each side: all of it inside the sphere
    const Region region = silhouette_region(seen.scene(), camera);
    ASSERT_EQ(region.rings.size(), 1u);
    EXPECT_NEAR(rings_area(region.rings), 10000, 1);
}

TEST(ToonRegion, OfASphereWithAHeadlightIsTheRimBelowTheLimit)
{
    const Seen seen("sphere", 200000);
    const Camera camera = along_axis(240);
    const Region region = toon_region(seen.scene(), camera, 0.5f);
    EXPECT_EQ(region.name, "toon");
    ASSERT_EQ(region.rings.size(), 2u);
    EXPECT_LT(deviation(region.rings[0], camera, 100), 0.15);
    EXPECT_LT(deviation(region.rings[1], camera, 100 * std::sqrt(0.75)), 0.15);
}

TEST(ToonRegion, WithALightFromAboveIsTheLowerPartOfASphere)
{
    const Seen seen("sphere", 200000);
    const Camera camera = along_axis(240);
    const Region region = toon_region(seen.scene(), camera, 0.001f, dvec3(0, 1, 0));
    ASSERT_EQ(region.rings.size(), 1u);
    EXPECT_NEAR(rings_area(region.rings), std::numbers::pi * 5000, 60);
    for (const dvec2& p : region.rings[0])
        EXPECT_GT(p.y, 119.5);
}

TEST(ToonRegion, LeavesTheBackOfAnOpenSheetOut)
{
    const Seen seen("plane", 2000);
    Camera camera = along_axis(220);
    camera.eye = {0, 0, -5};
    EXPECT_TRUE(toon_region(seen.scene(), camera, 0.5f, dvec3(0, 1, 0.1)).rings.empty());
    camera.eye = {0, 0, 5};
    EXPECT_NEAR(rings_area(toon_region(seen.scene(), camera, 0.5f, dvec3(0, 1, 0.1)).rings), 40000, 10);
}

TEST(Regions, AreTheSameForAnyNumberOfThreads)
{
    const Seen seen("blob", 20000);
    Camera camera = along_axis(300);
    const Region one = with_threads(1, [&] { return toon_region(seen.scene(), camera, 0.4f); });
    const Region two = with_threads(2, [&] { return toon_region(seen.scene(), camera, 0.4f); });
    EXPECT_GT(one.rings.size(), 1u);
    EXPECT_EQ(one.rings, two.rings);
}

} // namespace
} // namespace limn
