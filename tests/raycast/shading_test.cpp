#include <gtest/gtest.h>

#include "limn/raycast/shading.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <set>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/raycast/mapped_normals.h"
#include "raycast/scene.h"

namespace limn {
namespace {

ShadeOptions grey(Shading shading)
{
    ShadeOptions options;
    options.shading = shading;
    options.dark = vec3(0);
    return options;
}

TEST(Shade, SmoothHeadlightOnASphereIsTheCosine)
{
    test::ShapeScene scene;
    scene.add(test::shape("sphere", 50000));
    const Image image = shade(scene.finish(), test::orthographic_camera(120), grey(Shading::smooth));
    ASSERT_EQ(image.channels, 3);
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 120; ++x) {
            const double r2 = (std::pow(x - 59.5, 2) + std::pow(y - 59.5, 2)) / 2500;
            if (r2 < 0.9) {
                ASSERT_NEAR(image.at(x, y)[1], std::sqrt(1 - r2), 2e-3);
            } else if (r2 > 1.1) {
                ASSERT_EQ(image.at(x, y)[1], 1.0f);
            }
        }
}

TEST(Shade, ADirectionalLightDoesNotTurnWithTheCamera)
{
    test::ShapeScene scene;
    scene.add(test::shape("sphere", 50000));
    const SeenScene& seen = scene.finish();
    ShadeOptions options = grey(Shading::smooth);
    options.to_light = dvec3(0, 3, 0);
    Camera camera = test::orthographic_camera(60);
    for (const dvec3& eye : {dvec3(0, 0, 5), dvec3(5, 0, 0)}) {
        camera.eye = eye;
        const Image image = shade(seen, camera, options);
        for (int y = 8; y < 52; ++y)
            EXPECT_NEAR(image.at(30, y)[0], std::max(0.0, (29.5 - y) / 25), 0.01) << y;
    }
}

TEST(Shade, GouraudIsLinearBetweenTheVerticesTones)
{
    test::ShapeScene scene;
    scene.add(test::shape("sphere", 200));
    ShadeOptions options = grey(Shading::gouraud);
    options.samples = 1; // the pixel's middle
    options.to_light = dvec3(1, 2, 2);
    Camera perspective;
    perspective.eye = dvec3(0, 0, 4);
    perspective.fov_degrees = 30;
    perspective.size = {100, 100};
    scene.finish();
    for (const bool headlight : {false, true})
        for (const Camera& camera : {test::orthographic_camera(100), perspective}) {
            if (headlight)
                options.to_light.reset();
            const Image image = shade(scene.seen, camera, options);
            const FragmentTracer tracer(scene.seen, camera);
            for (int y = 25; y < 75; ++y)
                for (int x = 25; x < 75; ++x) {
                    const Fragment fragment = tracer.at({x + 0.5, y + 0.5});
                    ASSERT_TRUE(fragment.hit());
                    const dvec3 weights = {1 - fragment.u - fragment.v, fragment.u, fragment.v};
                    double tone = 0;
                    vec3 place = vec3(0);
                    for (int k = 0; k < 3; ++k) {
                        const std::uint32_t vertex = scene.triangles[0][fragment.triangle][k];
                        const vec3 p = scene.positions[0][vertex], n = scene.normals[0][vertex];
                        const dvec3 to_eye = camera.orthographic ? dvec3(0, 0, 1) : glm::normalize(camera.eye - dvec3(p));
                        tone += weights[k] * std::max(0.0, glm::dot(dvec3(n), headlight ? to_eye : dvec3(1, 2, 2) / 3.0));
                        place += float(weights[k]) * p;
                    }
                    ASSERT_LT(glm::distance(place, fragment.position), 1e-5f);
                    ASSERT_NEAR(image.at(x, y)[0], tone, 1e-4) << x << "," << y;
                }
        }
}

TEST(Shade, NormalsAreColoursOfTheInterpolatedNormals)
{
    test::ShapeScene scene;
    scene.add(test::shape("sphere", 50000));
    ShadeOptions options = grey(Shading::normals);
    options.lamp = dvec3(3, 3, 3);
    const Image image = shade(scene.finish(), test::orthographic_camera(120), options);
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 120; ++x) {
            const vec3 n = {(float(x) - 59.5f) / 50, (59.5f - float(y)) / 50, 0};
            const float r2 = glm::dot(n, n);
            if (r2 < 0.9f) {
                const float* pixel = image.at(x, y);
                ASSERT_LT(glm::distance(vec3(pixel[0], pixel[1], pixel[2]), 0.5f + 0.5f * (n + vec3(0, 0, std::sqrt(1 - r2)))), 2e-3f);
            }
        }
}

TEST(MappedNormal, IsMixedBetweenTheMiddlesOfTexelsAndCountsFromBelow)
{
    Image map({2, 2}, 3, 0.5f); // +x and +y above, +z and -x below
    map.at(0, 0)[0] = 1, map.at(1, 0)[1] = 1, map.at(0, 1)[2] = 1, map.at(1, 1)[0] = 0;
    const auto expect = [&](const vec2& uv, const vec3& normal) { EXPECT_LT(glm::distance(mapped_normal(map, uv), glm::normalize(normal)), 1e-6f) << uv.x << "," << uv.y; };
    expect({0.25f, 0.75f}, {1, 0, 0});
    expect({0.75f, 0.75f}, {0, 1, 0});
    expect({0.25f, 0.25f}, {0, 0, 1});
    expect({0.75f, 0.25f}, {-1, 0, 0});
    expect({0.5f, 0.75f}, {1, 1, 0});
    expect({0.25f, 0.375f}, {1, 0, 3});
    expect({0, 1}, {1, 0, 0}); // the border goes on
    expect({0.5f, 0.5f}, {0, 1, 1});
    EXPECT_EQ(mapped_normal(Image({2, 2}, 3, 0.5f), {0.5f, 0.5f}), vec3(0, 0, 1)) << "no direction at all";
}

TEST(Shade, FlatGivesEachTriangleOneTone)
{
    test::ShapeScene scene;
    scene.add(test::shape("sphere", 80));
    Camera camera = test::orthographic_camera(100);
    const Image image = shade(scene.finish(), camera, grey(Shading::flat));
    const FragmentTracer tracer(scene.seen, camera);
    std::set<std::uint32_t> triangles;
    int seen = 0, even = 0;
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x) {
            const Fragment fragment = tracer.at({x + 0.5, y + 0.5});
            if (!fragment.hit())
                continue;
            triangles.insert(fragment.triangle);
            ++seen;
            even += std::abs(image.at(x, y)[0] - fragment.face_normal.z) < 1e-5f; // the others blend at edges
        }
    EXPECT_GT(triangles.size(), 20u);
    EXPECT_GT(even, seen * 6 / 10);
}

TEST(Shade, ToonHasItsTonesAndBlendsOnlyOnEdges)
{
    test::ShapeScene scene;
    scene.add(test::shape("sphere", 50000));
    ShadeOptions options = grey(Shading::toon);
    options.toon_limit = 0.5f;
    options.toon_levels = 3;
    options.background = vec3(1, 0, 0);
    const Image image = shade(scene.finish(), test::orthographic_camera(120), options);
    int blended = 0;
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 120; ++x) {
            const double r = std::hypot(x - 59.5, y - 59.5) / 50;
            const double edges[] = {std::sqrt(1 - 0.75 * 0.75), std::sqrt(0.75), 1.0};
            bool near_edge = false;
            for (const double edge : edges)
                near_edge = near_edge || std::abs(r - edge) < 0.02;
            const float* p = image.at(x, y);
            const vec3 colour = {p[0], p[1], p[2]};
            const vec3 expected = r < edges[0] ? vec3(1) : r < edges[1] ? vec3(0.5f) : r < 1 ? vec3(0) : vec3(1, 0, 0);
            ASSERT_TRUE(near_edge || colour == expected) << x << " " << y;
            blended += colour != vec3(1) && colour != vec3(0.5f) && colour != vec3(0) && colour != vec3(1, 0, 0);
        }
    EXPECT_GT(blended, 400);
}

TEST(Shade, AntiAliasedEdgesKeepTheAreaOfADisc)
{
    test::ShapeScene scene;
    scene.add(test::shape("sphere", 100000));
    ShadeOptions options;
    options.dark = options.light = vec3(0);
    const Image image = shade(scene.finish(), test::orthographic_camera(60), options);
    double area = 0;
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 60; ++x)
            area += 1 - double(image.at(x, y)[0]);
    EXPECT_NEAR(area, std::numbers::pi * 625, 0.002 * std::numbers::pi * 625);
}

TEST(Shade, LightsTheBackOfAnOpenSheet)
{
    test::ShapeScene scene;
    scene.add(test::shape("plane", 200));
    Camera camera = test::orthographic_camera(20);
    camera.eye = {0, 0, -5};
    EXPECT_NEAR(shade(scene.finish(), camera, grey(Shading::smooth)).at(10, 10)[0], 1, 1e-6);
}

TEST(Shade, AMaterialForEachObjectIsTheOneThatAPictureOfItHas)
{
    test::ShapeScene scene;
    scene.add(test::shape("sphere", 20000), {-0.6, 0, 0});
    scene.add(test::shape("sphere", 20000), {0.6, 0, 0});
    const SeenScene& seen = scene.finish();
    const Camera camera = test::orthographic_camera(100);
    ShadeOptions options = grey(Shading::smooth);
    options.materials = {{vec3(1, 0.5f, 0), 0.2f}, {vec3(0, 0.25f, 1), 0.4f}};
    const Image both = shade(seen, camera, options);
    std::vector<Image> alike;
    for (const Material& material : options.materials) {
        ShadeOptions of_one = grey(Shading::smooth);
        of_one.dark = material.dark(), of_one.light = material.colour;
        alike.push_back(shade(seen, camera, of_one));
    }
    const FragmentTracer tracer(seen, camera);
    std::size_t of_object[2] = {};
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x) {
            std::set<std::uint32_t> around;
            for (int k = 0; k < 9; ++k)
                around.insert(tracer.at({x + k % 3 - 0.5, y + k / 3 - 0.5}).object);
            if (around.size() > 1 || *around.begin() == none)
                continue;
            ++of_object[*around.begin()];
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(both.at(x, y)[c], alike[*around.begin()].at(x, y)[c], 0.02) << x << " " << y; // either may have taken more rays
        }
    EXPECT_GT(of_object[0], 1000u);
    EXPECT_GT(of_object[1], 1000u);
}

TEST(Shade, PartsOfOneObjectHaveMaterialsOfTheirOwn)
{
    test::ShapeScene scene;
    const Shape plane = test::shape("plane", 2000);
    scene.add(plane);
    SeenScene seen = scene.finish();
    const std::uint32_t faces = std::uint32_t(plane.mesh.triangles.size()), first_face[] = {0, 0, faces / 2, faces}; // the first part is empty
    seen.first_face = first_face;
    ASSERT_EQ(seen.part_count(), 3u);
    ShadeOptions options;
    options.materials = {{vec3(1, 0, 0), 1}, {vec3(0, 1, 0), 1}, {vec3(0, 0, 1), 1}};
    options.samples = 1;
    const Camera camera = test::orthographic_camera(60);
    const Image image = shade(seen, camera, options);
    const FragmentTracer tracer(seen, camera);
    std::size_t found[3] = {};
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 60; ++x) {
            const Fragment fragment = tracer.at({x + 0.5, y + 0.5});
            if (!fragment.hit())
                continue;
            const std::size_t part = fragment.triangle < faces / 2 ? 1 : 2;
            ++found[part];
            const vec3 colour = {image.at(x, y)[0], image.at(x, y)[1], image.at(x, y)[2]};
            ASSERT_EQ(colour, options.materials[part].colour) << x << " " << y;
        }
    EXPECT_GT(found[1], 500u);
    EXPECT_GT(found[2], 500u);
}

TEST(Shade, IsTheSameForAnyNumberOfThreads)
{
    test::ShapeScene scene;
    scene.add(test::shape("blob", 20000));
    const SeenScene& seen = scene.finish();
    const Camera camera = test::orthographic_camera(150);
    const Image one = with_threads(1, [&] { return shade(seen, camera); }), two = with_threads(2, [&] { return shade(seen, camera); });
    ASSERT_EQ(one.samples.size(), two.samples.size());
    EXPECT_EQ(std::memcmp(one.samples.data(), two.samples.data(), one.samples.size() * sizeof(float)), 0);
}

TEST(Shade, RefusesNumbersOutOfRange)
{
    test::ShapeScene scene;
    scene.add(test::shape("plane", 2));
    const SeenScene& seen = scene.finish();
    const Camera camera = test::orthographic_camera(4);
    ShadeOptions options;
    options.toon_levels = 1;
    EXPECT_THROW(shade(seen, camera, options), Error::Input);
    options = {};
    options.toon_limit = 1;
    EXPECT_THROW(shade(seen, camera, options), Error::Input);
    options = {};
    options.samples = 0;
    EXPECT_THROW(shade(seen, camera, options), Error::Input);
    options = {};
    options.to_light = dvec3(0);
    EXPECT_THROW(shade(seen, camera, options), Error::Input);
    options = {};
    options.materials.resize(2); // of one object
    EXPECT_THROW(shade(seen, camera, options), Error::Input);
}

TEST(Shade, GroundLiesUnderTheModelsAndFadesIntoTheBackground)
{
    test::ShapeScene scene;
    scene.add(test::shape("sphere", 5000));
    const SeenScene& seen = scene.finish();
    ShadeOptions options;
    options.background = vec3(0, 0, 1);
    options.to_light = dvec3(0, 1, 0);
    options.ground = ground_under(seen, dvec3(0, 1, 0));
    options.ground->material = {.colour = vec3(0.5f, 0.25f, 0.125f)};
    EXPECT_NEAR(options.ground->middle.y, -1, 1e-3);
    Camera camera;
    camera.eye = dvec3(0, 8, 8);
    camera.fov_degrees = 80;
    camera.size = {121, 121};
    const Image image = shade(seen, camera, options);
    const auto pixel_of = [&](const dvec3& p) {
        const dvec2 at = camera.project(p).pixel;
        const float* sample = image.at(int(at.x), int(at.y));
        return vec3(sample[0], sample[1], sample[2]);
    };
    EXPECT_LE(glm::distance(pixel_of(dvec3(1.3, -1, 0)), options.ground->material.colour), 1e-6f); // fully lit from above
    EXPECT_EQ(pixel_of(dvec3(5, -1, 0)), options.background);
    const vec3 between = pixel_of(dvec3(2.75, -1, 0));
    EXPECT_NEAR(between.x, 0.25f, 0.05f);
    EXPECT_NEAR(between.z, 0.5f * (0.125f + 1), 0.06f);
    camera.eye = dvec3(0, -6, 8); // from below there is none
    options.samples = 4;
    const Image below = shade(seen, camera, options);
    EXPECT_EQ(vec3(below.at(2, 2)[0], below.at(2, 2)[1], below.at(2, 2)[2]), options.background);
    EXPECT_EQ(vec3(below.at(60, 118)[0], below.at(60, 118)[1], below.at(60, 118)[2]), options.background);
}

} // namespace
} // namespace limn
