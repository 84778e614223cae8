#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "limn/base/error.h"
#include "limn/base/random.h"
#include "limn/raycast/depth_edges.h"
#include "limn/raycast/nearest_sample.h"
#include "limn/raycast/outline_error.h"

namespace limn {
namespace {

/// 100 x 100 pixels, ten for a unit; the middle of the picture is the origin.
Camera small_camera()
{
    Camera camera;
    camera.orthographic = true;
    camera.ortho_height = 10;
    camera.size = {100, 100};
    return camera;
}

/// A little within the given sides, which may lie between samples.
void add_rectangle(Mesh& mesh, dvec2 low, dvec2 high, double z = 0)
{
    low += 1e-6, high -= 1e-6;
    const std::uint32_t a = std::uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{low.x, low.y, z}, {high.x, low.y, z}, {high.x, high.y, z}, {low.x, high.y, z}});
    mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, a + 2}, {a, a + 2, a + 3}});
}

Mesh rectangle(const dvec2& low, const dvec2& high)
{
    Mesh mesh;
    add_rectangle(mesh, low, high);
    return mesh;
}

Mesh disc(double radius, std::uint32_t corners)
{
    Mesh mesh;
    mesh.positions.push_back(dvec3(0));
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners;
        mesh.positions.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
        mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % corners});
    }
    return mesh;
}

TEST(OutlineMask, CoversWhatLiesInside)
{
    const OutlineMask mask = outline_mask(rectangle({-2, -1}, {3, 2}), small_camera(), 8);
    EXPECT_EQ(mask.size, ivec2(800, 800));
    EXPECT_EQ(mask.covered(), 50u * 30 * 64);
    for (const auto& [x, y, covered] : {std::tuple(240, 479, true), {239, 479, false}, {639, 240, true}, {640, 240, false}, {300, 480, false}, {300, 239, false}}) {
        EXPECT_EQ(mask.covers(x, y), covered) << x << " " << y;
    }
    EXPECT_NEAR(double(outline_mask(disc(4, 1000), small_camera(), 8, MaskFaces::front).covered()) / 64, std::numbers::pi * 1600, 1);
}

TEST(OutlineMask, ShowsWhatIsThinnerThanSamples)
{
    Mesh needles;
    needles.positions = {{-3, 0.001, 0}, {3, 0.002, 0}, {3, 0.0025, 0}, {0.001, -3, 0}, {0.0015, -3, 0}, {0.002, 3, 0}};
    needles.triangles = {{0, 1, 2}, {3, 4, 5}};
    EXPECT_EQ(outline_mask(needles, small_camera(), 8, MaskFaces::front).covered(), 0u);
    const OutlineMask mask = outline_mask(needles, small_camera(), 8);
    EXPECT_EQ(mask.covered(), 480u + 480 - 1);
    EXPECT_TRUE(mask.covers(160, 399) && mask.covers(639, 399) && mask.covers(400, 160) && mask.covers(400, 639));
}

/// Triangles that share sides cover each sample between them, wherever their corners are.
TEST(OutlineMask, HasNoGapsBetweenTriangles)
{
    Mesh mesh;
    constexpr std::uint32_t n = 30;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t k = 0; k <= n; ++k) {
            Random random(5, i * (n + 1) + k);
            const bool inside = i > 0 && i < n && k > 0 && k < n;
            const double x = random.uniform(-0.4, 0.4), y = random.uniform(-0.4, 0.4);
            mesh.positions.push_back({8.0 / n * (k + (inside ? x : 0)) - 4, 8.0 / n * (i + (inside ? y : 0)) - 4, 0});
        }
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t a = i * (n + 1) + k;
            mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, a + n + 2}, {a, a + n + 2, a + n + 1}});
        }
    const OutlineMask whole = outline_mask(rectangle({-4, -4}, {4, 4}), small_camera());
    EXPECT_EQ(uncovered(outline_mask(mesh, small_camera(), 8, MaskFaces::front), whole), 0);
    mesh.positions[n + 3].x += 1e-9; // still shared: nothing opens
    EXPECT_EQ(uncovered(outline_mask(mesh, small_camera(), 8, MaskFaces::front), whole), 0);
    mesh.triangles.erase(mesh.triangles.begin() + 700);
    EXPECT_GT(uncovered(outline_mask(mesh, small_camera(), 8, MaskFaces::front), whole), 1);
}

TEST(OutlineMask, LeavesOutWhatFacesAwayOrLiesBehind)
{
    Mesh mesh = rectangle({-2, -1}, {3, 2});
    EXPECT_GT(outline_mask(mesh, small_camera(), 8, MaskFaces::front).covered(), 0u);
    std::swap(mesh.triangles[0].x, mesh.triangles[0].y);
    EXPECT_NEAR(double(outline_mask(mesh, small_camera(), 8, MaskFaces::front).covered()), 50 * 30 * 32, 80); // half, and its side
    EXPECT_EQ(outline_mask(mesh, small_camera(), 8).covered(), 50u * 30 * 64);
    Camera inside = small_camera();
    inside.orthographic = false;
    inside.eye = {0, 0, -1};
    inside.look = {0, 0, -2};
    EXPECT_EQ(outline_mask(mesh, inside).covered(), 0u);
}

TEST(OutlineMask, IsErodedByStepsButNotAtThePicturesEdge)
{
    const OutlineMask mask = outline_mask(rectangle({-20, -1}, {3, 2}), small_camera(), 2);
    EXPECT_EQ(mask.covered(), 160u * 60);
    EXPECT_EQ(eroded(mask, 3).covered(), (160u - 3) * (60 - 6));
    EXPECT_EQ(eroded(mask, 30).covered(), 0u);
}

TEST(OutlineError, IsThatOfAShiftAndOfASpike)
{
    const OutlineMask wanted = outline_mask(rectangle({-2, -1}, {3, 2}), small_camera());
    const OutlineError same = compare_outlines(wanted, wanted);
    EXPECT_EQ(same.difference, 0);
    EXPECT_EQ(same.most(), 0);
    EXPECT_NEAR(same.length, 160, 1);
    const OutlineError shifted = compare_outlines(outline_mask(rectangle({-1.75, -1}, {3.25, 2}), small_camera()), wanted); // 2.5 px to the right
    EXPECT_NEAR(shifted.difference, 2 * 2.5 * 30, 1e-9);
    EXPECT_NEAR(shifted.beyond, 2.5, 1e-9);
    EXPECT_NEAR(shifted.short_of, 2.5, 1e-9);
    EXPECT_NEAR(shifted.mean(), 150.0 / 160, 0.01);
    Mesh spiked = rectangle({-2, -1}, {3, 2});
    add_rectangle(spiked, {0, 2}, {0.1, 3}); // 10 px up
    const OutlineError spike = compare_outlines(outline_mask(spiked, small_camera()), wanted);
    EXPECT_NEAR(spike.beyond, 10, 1e-9);
    EXPECT_NEAR(spike.short_of, std::hypot(0.375, 0.125), 0.01); // from the middle under it to a sample of its sides
    EXPECT_NEAR(spike.difference, 10, 1e-9);
    EXPECT_NEAR(area_distance(outline_mask(spiked, small_camera()), wanted), 10, 1e-9);
    EXPECT_NEAR(area_distance(wanted, outline_mask(spiked, small_camera())), 10, 1e-9);
    EXPECT_EQ(area_distance(wanted, wanted), 0);
}

/// A gap in the middle is as far off as half of its width for areas, but as far as it is from the outline for outlines.
TEST(OutlineError, OfAreasIsHalfOfAGap)
{
    const OutlineMask wanted = outline_mask(rectangle({-2, -1}, {3, 2}), small_camera());
    Mesh gaping = rectangle({-2, -1}, {0.5, 2});
    add_rectangle(gaping, {0.6, -1}, {3, 2}); // 1 px
    add_rectangle(gaping, {0.4, -1}, {0.7, 0});
    add_rectangle(gaping, {0.4, 1}, {0.7, 2});
    const OutlineMask found = outline_mask(gaping, small_camera());
    EXPECT_NEAR(area_distance(found, wanted), 0.5, 0.01);
    EXPECT_NEAR(compare_outlines(found, wanted).beyond, 15, 0.2);
    EXPECT_EQ(area_distance(outline_mask({}, small_camera()), wanted), HUGE_VAL);
}

/// A polygon of n sides in a circle of radius r is short of it by r (1 - cos(pi / n)).
TEST(OutlineError, IsTheHeightOfArcs)
{
    const OutlineMask circle = outline_mask(disc(4, 3000), small_camera());
    for (const std::uint32_t n : {6u, 12u, 24u}) {
        const OutlineError error = compare_outlines(outline_mask(disc(4, n), small_camera()), circle);
        const double height = 40 * (1 - std::cos(std::numbers::pi / n));
        EXPECT_NEAR(error.most(), height, 0.2) << n;
        EXPECT_NEAR(error.difference, std::numbers::pi * 1600 - 800 * n * std::sin(2 * std::numbers::pi / n), 6) << n; // a fifth of a sample all around
    }
    EXPECT_THROW(compare_outlines(outline_mask(disc(4, 6), small_camera(), 4), circle), Error::Input);
    EXPECT_EQ(compare_outlines(outline_mask({}, small_camera()), circle).short_of, HUGE_VAL);
}

TEST(NearestSample, IsThatOfAll)
{
    const ivec2 size(300, 200);
    std::vector<ivec2> marked;
    Random random(9);
    const auto any = [&] {
        const int x = int(random.uniform(0, size.x)), y = int(random.uniform(0, size.y));
        return ivec2(x, y);
    };
    for (int i = 0; i < 60; ++i)
        marked.push_back(any());
    const NearestSample nearest(marked, size);
    for (int i = 0; i < 500; ++i) {
        const ivec2 from = any();
        double least = HUGE_VAL;
        for (const ivec2& p : marked)
            least = std::min(least, std::hypot(p.x - from.x, p.y - from.y));
        EXPECT_NEAR(nearest.distance(from), least, 1e-12);
    }
    EXPECT_EQ(NearestSample({}, size).distance({5, 5}), HUGE_VAL);
    EXPECT_EQ(NearestSample({{299, 199}}, size).distance({0, 0}), std::hypot(299, 199));
}

TEST(DepthMap, IsThatOfPlanes)
{
    for (const bool orthographic : {true, false}) {
        Camera camera = small_camera();
        camera.orthographic = orthographic;
        Mesh mesh; // a plane that leans back, over the whole picture
        mesh.positions = {{-9, -9, 1}, {9, -9, 1}, {0, 9, -1}};
        mesh.triangles = {{0, 1, 2}};
        const DepthMap map = depth_map(mesh, camera, 2);
        for (const ivec2& at : {ivec2(100, 100), ivec2(60, 120), ivec2(140, 70)}) {
            const Camera::Ray ray = camera.ray((dvec2(at) + 0.5) / 2.0);
            const dvec3 n = glm::normalize(dvec3(0, 2, 18));
            const double t = glm::dot(mesh.positions[0] - ray.origin, n) / glm::dot(ray.direction, n);
            EXPECT_NEAR(map.at(at.x, at.y), glm::dot(ray.origin + t * ray.direction - camera.eye, camera.forward()), 1e-5);
        }
    }
}

TEST(DepthEdges, AreWhereOneSurfaceIsInFrontOfAnother)
{
    const auto scene = [](double shift) {
        Mesh mesh;
        add_rectangle(mesh, {-4, -4}, {4, 4}, 0);
        add_rectangle(mesh, {-1 + shift, -1}, {1 + shift, 1}, 0.5);
        add_rectangle(mesh, {-3, -3}, {-2, -2}, 0.15); // by less than twice the step
        return depth_map(mesh, small_camera(), 4);
    };
    const DepthMap wanted = scene(0);
    EXPECT_EQ(depth_edges(wanted, 0.2, true).size(), 4u * 80 - 4);
    EXPECT_EQ(depth_edges(wanted, 0.1, true).size(), 4u * 80 - 4 + 4 * 40 - 4);
    EXPECT_EQ(depth_edges(wanted, 0.1, false).size(), 4u * 80 - 4 + 4 * 40 - 4 + 4 * 320 - 4);
    const DepthEdgeError same = compare_depth_edges(wanted, wanted, 0.1);
    EXPECT_EQ(same.wanted, 316u);
    EXPECT_EQ(same.beyond, 0);
    const DepthEdgeError shifted = compare_depth_edges(scene(0.3), wanted, 0.1); // 3 px
    EXPECT_EQ(shifted.beyond, 3);
    EXPECT_EQ(shifted.short_of, 3);
    EXPECT_GT(shifted.mean_short_of, 1);
    EXPECT_LT(shifted.mean_short_of, 2);
}

} // namespace
} // namespace limn
