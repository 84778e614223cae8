// Checklist 28 of the procedural structures specification, and pictures of patterns as a whole.

#include "limn/scene/pattern_picture.h"

#include <cmath>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/lines/regions.h"
#include "limn/scene/render.h"
#include "limn/surface/shapes.h"

namespace limn {
namespace {

Scene scene_of(const std::string& shape, PatternKind kind, const dmat4& transform = dmat4(1))
{
    Scene scene;
    SceneObject object;
    object.mesh = std::make_shared<const Mesh>(make_shape({.name = shape, .triangles = 4000}).mesh);
    object.transform = transform;
    scene.objects = {object};
    scene.pattern.kind = kind;
    scene.render.samples = 4;
    return scene;
}

Camera front_camera(int edge = 120)
{
    Camera camera;
    camera.eye = {0, 0, 20};
    camera.size = {edge, edge};
    camera.orthographic = true;
    camera.ortho_height = 2.4;
    return camera;
}

dmat4 turned(double degrees)
{
    const double c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
    return dmat4(dvec4(c, s, 0, 0), dvec4(-s, c, 0, 0), dvec4(0, 0, 1, 0), dvec4(0, 0, 0, 1));
}

/// The direction in which a picture changes most in its middle, degrees from upright: of the bands of layers.
double band_direction(const Image& image)
{
    dvec2 twice(0); // of the doubled angle, so that both ways agree
    for (int y = image.height / 4; y < 3 * image.height / 4; ++y)
        for (int x = image.width / 4; x < 3 * image.width / 4; ++x) {
            const double gx = double(image.at(x + 1, y)[1] - image.at(x - 1, y)[1]),
                         gy = double(image.at(x, y + 1)[1] - image.at(x, y - 1)[1]);
            twice += dvec2(gy * gy - gx * gx, 2 * gx * gy);
        }
    return 0.5 * glm::degrees(std::atan2(twice.y, twice.x));
}

TEST(Checklist28, PatternsStayWithTheWorldOrTurnWithTheirObject)
{
    // A wall seen from the front: it is flat, so the bands are those of the layers alone.
    for (const double angle : {0.0, 20.0, 35.0}) {
        Scene scene = scene_of("plane", PatternKind::layers, turned(angle));
        scene.pattern.layer_height = 6; // of 100 mm
        scene.pattern.filter_width = 3; // so smooth that differences between pixels tell directions
        scene.pattern.variety = 0;
        Camera camera = front_camera(240);
        EXPECT_NEAR(band_direction(render(scene, camera)), 0, 1) << "in the world, bands stay level";
        scene.pattern.with_object = true;
        EXPECT_NEAR(std::abs(band_direction(render(scene, camera))), angle, 1.5) << "with the object, they turn";
    }
}

TEST(Checklist28, APatternThatTurnsWithItsObjectIsTheTurnedPicture)
{
    Scene straight = scene_of("cube", PatternKind::bricks), quarter = scene_of("cube", PatternKind::bricks, turned(90));
    for (Scene* scene : {&straight, &quarter}) {
        scene->pattern.with_object = true;
        scene->pattern.variety = 0;
        scene->render.light = dvec3(0, 0, 1);
    }
    const Image a = render(straight, front_camera()), b = render(quarter, front_camera());
    int differ = 0, all = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x, ++all) // a quarter turn against the clock
            differ += std::abs(a.at(x, y)[0] - b.at(y, a.width - 1 - x)[0]) > 0.06f;
    EXPECT_LT(differ, all / 100);
}

TEST(PatternPicture, ThreadShowsItsFarSideAndTheBackgroundThroughItsHoles)
{
    Scene scene = scene_of("sphere", PatternKind::thread);
    scene.pattern.hole = 0.06;
    scene.pattern.thread = 0.04;
    scene.render.background = vec3(1, 0, 1);
    const Image image = render(scene, front_camera());
    int clear = 0, thread = 0;
    for (int y = 40; y < 80; ++y)
        for (int x = 40; x < 80; ++x) {
            const vec3 c(image.at(x, y)[0], image.at(x, y)[1], image.at(x, y)[2]);
            clear += glm::length(c - vec3(1, 0, 1)) < 0.02f;
            thread += c.y > 0.15f;
        }
    EXPECT_GT(clear, 60);
    EXPECT_GT(thread, 400);
}

TEST(PatternPicture, OverhangsAreMarkedAndLevelPartsAreNot)
{
    Scene scene = scene_of("sphere", PatternKind::layers);
    scene.pattern.layer_height = 1;
    const Image plain = render(scene, front_camera());
    scene.pattern.overhang = 45;
    const Image marked = render(scene, front_camera());
    EXPECT_EQ(marked.at(60, 30)[1], plain.at(60, 30)[1]);
    EXPECT_GT(marked.at(60, 105)[0], marked.at(60, 105)[1] + 0.15f) << "red under 45 degrees";
}

TEST(PatternPicture, HidesLightByRaysWhereThatIsAskedFor)
{
    Scene scene = scene_of("knot", PatternKind::layers);
    scene.pattern.layer_height = 1;
    scene.render.light = dvec3(1, 1, 0.2);
    Camera camera = front_camera();
    camera.ortho_height = 8;
    const Image open = render(scene, camera);
    scene.render.shadow = ShadowMethod::rays;
    scene.render.shadow_samples = 8;
    const Image hidden = render(scene, camera);
    int darker = 0, lighter = 0;
    for (std::size_t i = 0; i < open.samples.size(); ++i) {
        darker += hidden.samples[i] < open.samples[i] - 0.1f;
        lighter += hidden.samples[i] > open.samples[i] + 0.02f;
    }
    EXPECT_GT(darker, 300);
    EXPECT_EQ(lighter, 0);
}

TEST(PrintCusps, OfABallAreThoseOfItsFormula)
{
    const Scene scene = scene_of("sphere", PatternKind::layers);
    const SceneModel model = prepare_scene(scene);
    PatternOptions options = scene.pattern;
    options.layer_height = 1;
    PatternPlace place;
    place.up = {0, 1, 0};
    const CuspHistogram cusps = print_cusps(seen_scene(model.lines, model.rays), options, place);
    // Over a ball the cosine is spread evenly.
    EXPECT_NEAR(cusps.mean, 0.5, 0.01);
    EXPECT_NEAR(cusps.middle, 0.5, 0.02);
    for (const double share : cusps.shares)
        EXPECT_NEAR(share, 0.05, 0.025) << "triangles lie in rings";
    options.layer_height = 101;
    EXPECT_THROW(print_cusps(seen_scene(model.lines, model.rays), options, place), Error::Input);
}

TEST(MmPerUnit, FollowsTheFormatUnlessItIsSaid)
{
    EXPECT_EQ(mm_per_unit('a', "stl"), 1.0);
    EXPECT_EQ(mm_per_unit('a', "glb"), 1000.0);
    EXPECT_EQ(mm_per_unit('a', "obj"), std::nullopt);
    EXPECT_EQ(mm_per_unit('i', "stl"), 25.4);
}

} // namespace
} // namespace limn
