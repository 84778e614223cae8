// Checklists 10 and 20 of the terrain specification: what cannot be seen is not worked on, and nothing seen changes.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/raycast/ray_scene.h"
#include "limn/scene/terrain_picture.h"
#include "limn/terrain/terrain_mesh.h"
#include "terrain/par_support.h"

namespace limn::test {
namespace {

/// The light of the ground at each pixel, from 0 to 255; -1 where there is none.
std::vector<int> picture(const HeightMap& map, const Lattice& lattice, const std::vector<BisectionTriangle>& triangles,
                         const Camera& camera)
{
    const Mesh mesh = terrain_mesh(map, lattice, triangles);
    std::vector<vec3> positions(mesh.positions.begin(), mesh.positions.end());
    positions.emplace_back(0); // the spare one
    const RayTriangles rays = {std::span(positions).first(positions.size() - 1), mesh.triangles};
    const RayScene scene(std::span(&rays, 1));
    std::vector<int> pixels;
    for (int y = 0; y < camera.size.y; ++y)
        for (int x = 0; x < camera.size.x; ++x) {
            const Camera::Ray ray = camera.ray(dvec2(x + 0.5, y + 0.5));
            const Hit hit = scene.closest({vec3(ray.origin), vec3(ray.direction)});
            const dvec3 normal = hit ? terrain_normal(map, dvec2(ray.origin + double(hit.distance) * ray.direction)) : dvec3(0);
            pixels.push_back(hit ? int(255 * std::clamp(glm::dot(normal, dvec3(-0.5, 0.5, 0.7071)), 0.0, 1.0)) : -1);
        }
    return pixels;
}

std::size_t differing(const std::vector<int>& a, const std::vector<int>& b)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += a[i] != b[i];
    return count;
}

/// A view without culling.
struct View {
    ParResult result;     ///< every triangle is tested, but edges count only where they may be seen
    ParResult everywhere; ///< edges count everywhere, also behind the eye
    View(const HeightMap& map, const NestedErrors& ranges, const Camera& camera, double pixels)
    {
        const SeenTerrain seen(map, ranges, camera);
        const EdgeTest off = screen_height_test(map, camera, pixels);
        result = refine_in_parallel(ranges.lattice, root_triangles(ranges.lattice),
                                    [&](const ivec2& a, const ivec2& b) { return seen.edge(a, b) && off(a, b); });
        everywhere = refine_in_parallel(ranges.lattice, root_triangles(ranges.lattice), off);
    }
    static std::size_t tested(const ParResult& par)
    {
        std::size_t sum = 0;
        for (const ParStep& step : par.steps)
            sum += step.tested;
        return sum;
    }
};

void expect_same_pictures(int views)
{
    const HeightMap map = rough_terrain(129, 100);
    const NestedErrors ranges = nest_errors(map, {.ranges = true});
    ParView view(map, ranges, root_triangles(ranges.lattice));
    std::size_t tested = 0, all_tested = 0, drawn = 0, all = 0, ground = 0, moved = 0;
    for (int i = 0; i < views; ++i) {
        const Camera camera = any_camera(map, std::uint64_t(i));
        const double pixels = std::exp(Random(44, std::uint64_t(i)).uniform(-1.5, 2));
        const View whole(map, ranges, camera, pixels);
        tested += view.update(camera, pixels);
        EXPECT_LE(View::tested(view.result()), View::tested(whole.result));
        all_tested += View::tested(whole.everywhere);
        EXPECT_EQ(view.result().triangles, whole.result.triangles);
        EXPECT_TRUE(is_watertight(ranges.lattice, view.result().triangles)) << "view " << i;
        const std::vector<BisectionTriangle> seen = view.seen();
        drawn += seen.size();
        all += whole.everywhere.triangles.size();
        const std::vector<int> wanted = picture(map, ranges.lattice, whole.result.triangles, camera);
        ground += std::size_t(std::count_if(wanted.begin(), wanted.end(), [](int pixel) { return pixel >= 0; }));
        EXPECT_EQ(differing(picture(map, ranges.lattice, seen, camera), wanted), 0u) << "view " << i;
        moved += differing(wanted, picture(map, ranges.lattice, whole.everywhere.triangles, camera));
    }
    fmt::print("[ culling  ] {} of {} triangles tested, {} of {} drawn; splits outside the picture that force others in it change {} of {} "
               "pixels\n",
               tested, all_tested, drawn, all, moved, ground);
    EXPECT_LT(double(tested), 0.5 * double(all_tested));
    EXPECT_LT(double(drawn), 0.5 * double(all));
    EXPECT_GT(ground, std::size_t(views) * 1000);
}

TEST(ParCulling, ChangesNothingSeen) { expect_same_pictures(100); }

/// The seed's test: a sphere around the triangle as it is.
bool is_in_flat_sphere(const HeightMap& map, const Camera& camera, const BisectionTriangle& t)
{
    const auto corner = [&](const ivec2& p) { return map.position(std::min(p.x, map.columns - 1), std::min(p.y, map.rows - 1)); };
    const dvec3 middle = 0.5 * (corner(t.a) + corner(t.b)) - camera.eye;
    const double radius =
        std::max(glm::distance(corner(t.a), corner(t.b)), glm::distance(corner(t.apex), 0.5 * (corner(t.a) + corner(t.b))) * 2) / 2;
    const dvec2 across = 0.5 * dvec2(camera.size) / camera.pixels_per_unit(1);
    const dvec3 f = camera.forward();
    if (glm::dot(f, middle) < -radius)
        return false;
    for (const dvec3& plane :
         {f * across.x + camera.right(), f * across.x - camera.right(), f * across.y + camera.above(), f * across.y - camera.above()})
        if (glm::dot(glm::normalize(plane), middle) < -radius)
            return false;
    return true;
}

/// Peaks on a plain that lies below the picture: coarse triangles do not know of them yet. What is between them is flat, so that the picture has to be
/// the same as that of a mesh which is refined everywhere, whether it is seen or not.
TEST(ParCulling, SeesPeaksThatComeIntoThePictureFromBelow)
{
    const HeightMap map = map_of(129, 129, [](int x, int y) { return x % 32 == 8 && y % 16 == 8 ? 60 : 0; });
    const Lattice lattice = make_lattice(129, 129, 4);
    const NestedErrors ranges = nest_errors(map, lattice, {.ranges = true});
    const EdgeTest off = middle_height_test(map, 0.5);
    const std::vector<BisectionTriangle> everywhere = refine_in_parallel(lattice, root_triangles(lattice), off).triangles;
    std::size_t lost = 0, shown = 0;
    for (int i = 0; i < 20; ++i) {
        Camera camera;
        camera.eye = {-20.0 - 3 * i, 64, 55}, camera.look = {64, 64.0 + 2 * (i - 10), 56}, camera.up = {0, 0, 1};
        camera.fov_degrees = 4, camera.size = {96, 64};
        const SeenTerrain seen(map, ranges, camera);
        const auto refined = [&](const TriangleTest& visible) {
            const EdgeTest test = [&](const ivec2& a, const ivec2& b) { return seen.edge(a, b) && off(a, b); };
            std::vector<BisectionTriangle> drawn;
            for (const BisectionTriangle& t : refine_in_parallel(lattice, root_triangles(lattice), test, {.visible = visible}).triangles)
                if (visible(t))
                    drawn.push_back(t);
            return picture(map, lattice, drawn, camera);
        };
        const std::vector<int> wanted = picture(map, lattice, everywhere, camera);
        EXPECT_EQ(differing(refined([&](const BisectionTriangle& t) { return seen.triangle(t); }), wanted), 0u) << "view " << i;
        lost += std::size_t(differing(refined([&](const BisectionTriangle& t) { return is_in_flat_sphere(map, camera, t); }), wanted) > 0);
        shown += std::size_t(std::any_of(wanted.begin(), wanted.end(), [](int pixel) { return pixel >= 0; }));
    }
    EXPECT_EQ(shown, 20u);
    EXPECT_GE(lost, 15u) << "the seed's spheres keep these peaks, so that the test shows nothing";
}

TEST(ParCulling, DoesNothingWhereNothingMoves)
{
    const HeightMap map = rough_terrain(90, 90);
    const NestedErrors ranges = nest_errors(map, {.ranges = true});
    ParView view(map, ranges, root_triangles(ranges.lattice));
    const Camera camera = any_camera(map, 3);
    EXPECT_GT(view.update(camera, 2), 0u);
    EXPECT_EQ(view.update(camera, 2), 0u);
    EXPECT_GT(view.update(camera, 1), 0u);
    Camera moved = camera;
    moved.eye.x += 1e-3;
    EXPECT_GT(view.update(moved, 1), 0u);
    EXPECT_EQ(view.update(moved, 1), 0u);
    EXPECT_THROW(view.update(moved, -1), Error::Input);
    EXPECT_THROW(SeenTerrain(map, nest_errors(map), camera), Error::Input);
}

} // namespace
} // namespace limn::test
