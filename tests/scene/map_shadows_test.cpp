#include <gtest/gtest.h>

#include "limn/scene/map_shadows.h"

#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/scene/render.h"
#include "limn/shadow/bake_shadow_maps.h"
#include "limn/surface/shapes.h"
#include "support/support.h"

namespace limn {
namespace {

std::shared_ptr<const Mesh> mesh(const std::string& name, std::size_t triangles)
{
    return std::make_shared<const Mesh>(make_shape({.name = name, .triangles = triangles}).mesh);
}

double difference(const Image& a, const Image& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.samples.size(); ++i)
        sum += std::pow(double(a.samples[i] - b.samples[i]), 2);
    return std::sqrt(sum / double(a.samples.size()));
}

struct MapShadows : testing::Test {
    test::TemporaryFolder folder;
    Scene scene;
    Camera camera;

    /// A knot with maps, on a ground.
    void SetUp() override
    {
        SceneObject knot;
        knot.mesh = mesh("knot", 4000);
        knot.shadow_maps = folder / "knot.csm";
        BakeOptions bake;
        bake.maps = 1024, bake.resolution = 64;
        write_csm(bake_shadow_maps(*knot.mesh, bake), knot.shadow_maps);
        scene.objects = {knot};
        scene.render.ground = true;
        scene.render.samples = 4;
        scene.view.up_axis = 'y';
        camera = Camera::framing(prepare_scene(scene).bounds, {.view = "30,25", .size = {120, 90}});
    }
    Image picture(ShadowMethod method)
    {
        scene.render.shadow = method;
        return render(scene, camera);
    }
};

/// Checklist 23: soft shadows by maps are as near to those by rays as hard ones, and nearer to them than none.
TEST_F(MapShadows, AreThoseOfRays)
{
    double of_lamp = 0;
    scene.render.shadow_samples = 64;
    for (const Light& light : {Light(DistantLight{{1, 2, 0.5}}), Light(Lamp{{2, 4, 3}}), Light(SphereLight{{2, 4, 3}, 0.8}), Light(RectangleLight{{-2, 4, 3}, {1.5, 1}, {}})}) {
        scene.lights = {light};
        const Image rays = picture(ShadowMethod::rays), maps = picture(ShadowMethod::maps), none = picture(ShadowMethod::nothing);
        const double error = difference(rays, maps);
        fmt::print("light {}: maps differ from rays by {:.4f}, no shadows by {:.4f}\n", light.index(), error, difference(rays, none));
        EXPECT_LT(error, 0.3 * difference(rays, none));
        if (std::holds_alternative<Lamp>(light))
            of_lamp = error;
        if (light.index() > 2) {
            EXPECT_LT(error, 2 * of_lamp);
        }
        EXPECT_EQ(difference(picture(ShadowMethod::automatic), maps), 0) << "maps are taken where there are any";
    }
}

TEST_F(MapShadows, TakeRaysForObjectsWithoutMaps)
{
    SceneObject torus;
    torus.mesh = mesh("torus", 2000);
    torus.transform[3] = dvec4(2.5, 0.5, 0, 1);
    scene.objects.push_back(torus);
    scene.lights = {SphereLight{{4, 5, 1}, 0.5}};
    const Image rays = picture(ShadowMethod::rays), maps = picture(ShadowMethod::maps), none = picture(ShadowMethod::nothing);
    EXPECT_LT(difference(rays, maps), 0.3 * difference(rays, none));
    const Image dimmed = [&] { // openness asks both kinds, near and far
        scene.render.openness = 0.5;
        return picture(ShadowMethod::maps);
    }();
    EXPECT_LT(difference(dimmed, picture(ShadowMethod::rays)), 0.05);
}

TEST_F(MapShadows, RefuseWhatDoesNotFit)
{
    scene.objects.front().mesh = mesh("torus", 2000);
    EXPECT_THROW(prepare_scene(scene), Error::Read) << "of another mesh";
    scene.objects.front().shadow_maps.clear();
    EXPECT_THROW(picture(ShadowMethod::maps), Error::Input) << "no maps";
    const std::filesystem::path file = folder / "knot.csm";
    const std::uint64_t other = 1, own = read_csm(file).info().shape;
    EXPECT_THROW(match_maps({&file, 1}, {&other, 1}), Error::Read);
    const std::uint64_t both[] = {other, own, own};
    const ObjectMaps matched = match_maps({&file, 1}, both);
    EXPECT_EQ(matched[0], nullptr);
    EXPECT_NE(matched[1], nullptr);
    EXPECT_EQ(matched[1], matched[2]) << "copies share their maps";
    scene.objects.front().shadow_maps = file;
    scene.subdivision.scheme = SubdivisionOptions::Scheme::loop;
    EXPECT_THROW(prepare_scene(scene), Error::Input);
}

} // namespace
} // namespace limn
