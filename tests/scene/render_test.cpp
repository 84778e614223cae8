#include <gtest/gtest.h>

#include "limn/scene/render.h"

#include <cmath>
#include <cstring>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/geometry/read_mesh.h"
#include "limn/geometry/write_mesh.h"
#include "limn/scene/scene_json.h"
#include "limn/surface/shapes.h"
#include "support/support.h"

namespace limn {
namespace {

std::shared_ptr<const Mesh> mesh(const std::string& name, std::size_t triangles)
{
    return std::make_shared<const Mesh>(make_shape({.name = name, .triangles = triangles}).mesh);
}

SceneObject object(std::shared_ptr<const Mesh> of, const dmat4& transform = dmat4(1))
{
    SceneObject result;
    result.mesh = std::move(of);
    result.transform = transform;
    return result;
}

/// Turned by `degrees` around the z axis, scaled, and moved.
dmat4 placed(double degrees, double scale, const dvec3& to)
{
    const double c = scale * std::cos(glm::radians(degrees)), s = scale * std::sin(glm::radians(degrees));
    return dmat4(dvec4(c, s, 0, 0), dvec4(-s, c, 0, 0), dvec4(0, 0, scale, 0), dvec4(to, 1));
}

std::shared_ptr<const Mesh> transformed(const Mesh& mesh, const dmat4& transform)
{
    Mesh copy = mesh;
    for (dvec3& p : copy.positions)
        p = dvec3(transform * dvec4(p, 1));
    return std::make_shared<const Mesh>(copy);
}

Camera front_camera(ivec2 size = {200, 150})
{
    Camera camera;
    camera.eye = {0, 0, 20};
    camera.size = size;
    camera.orthographic = true;
    camera.ortho_height = 6;
    return camera;
}

/// A knot and a torus, apart and at an angle.
Scene two_objects()
{
    Scene scene;
    scene.objects = {object(mesh("torus", 5000), placed(30, 0.7, {-2, 0.5, 0})), object(mesh("blob", 5000), placed(-50, 1.3, {1.7, -0.2, -1}))};
    scene.lines = LineOptions();
    return scene;
}

double visible_length(const Drawing& drawing, LineType type)
{
    double length = 0;
    for (const Stroke& stroke : drawing.strokes)
        for (std::size_t i = 1; i < stroke.points.size() && stroke.type == type; ++i)
            length += glm::distance(stroke.points[i - 1], stroke.points[i]);
    return length;
}

/// Part of the samples that differ by more than a hundredth.
double difference(const Image& a, const Image& b)
{
    EXPECT_EQ(a.samples.size(), b.samples.size());
    std::size_t differ = 0;
    for (std::size_t i = 0; i < std::min(a.samples.size(), b.samples.size()); ++i)
        differ += std::abs(a.samples[i] - b.samples[i]) > 0.01f;
    return double(differ) / double(a.samples.size());
}

bool same_bytes(const Image& a, const Image& b)
{
    return a.samples.size() == b.samples.size() && std::memcmp(a.samples.data(), b.samples.data(), a.samples.size() * sizeof(float)) == 0;
}

TEST(SceneRender, TransformedObjectsAreTheTransformedMeshes)
{
    Scene scene = two_objects();
    scene.lines.suggestive_limit = scene.lines.min_length = 0; // a stroke near its limit may stay or go
    Scene moved = scene;
    for (SceneObject& o : moved.objects)
        o = object(transformed(*o.mesh, o.transform));
    const Camera camera = front_camera();
    EXPECT_LT(difference(render(scene, camera), render(moved, camera)), 0.005);
    const Drawing a = draw(scene, camera), b = draw(moved, camera);
    for (const LineType type : scene.lines.lines)
        EXPECT_NEAR(visible_length(a, type), visible_length(b, type), 0.02 * visible_length(a, type)) << line_type_name(type);
    EXPECT_GT(visible_length(a, LineType::contour), 300);
    EXPECT_GT(visible_length(a, LineType::suggestive), 200);
    const Bounds box = prepare_scene(scene).bounds, other = prepare_scene(moved).bounds;
    EXPECT_LT(glm::distance(box.low, other.low), 1e-12);
    EXPECT_LT(glm::distance(box.high, other.high), 1e-12);
}

TEST(SceneRender, ATransformTellsTheCreasesAndCurvatureOfItsModel)
{
    // A model of millimetres shown in metres: every limit must follow.
    Scene scene = two_objects();
    const auto length_of = [](const Drawing& d) { return visible_length(d, LineType::contour) + visible_length(d, LineType::suggestive); };
    const double length = length_of(draw(scene, front_camera()));
    for (SceneObject& o : scene.objects)
        o.transform = placed(0, 0.001, dvec3(0)) * o.transform;
    Camera camera = front_camera();
    camera.eye *= 0.001;
    camera.ortho_height *= 0.001;
    EXPECT_NEAR(length_of(draw(scene, camera)), length, 0.01 * length);
}

TEST(SceneRender, ObjectsHideEachOthersLines)
{
    Scene scene;
    scene.lines = LineOptions();
    scene.lines.lines = {LineType::contour};
    scene.objects = {object(mesh("sphere", 5000)), object(mesh("sphere", 5000), placed(0, 2, {0, 0, -5}))};
    const auto count_of = [](const Drawing& drawing, std::uint32_t index) {
        return std::count_if(drawing.strokes.begin(), drawing.strokes.end(), [&](const Stroke& stroke) { return stroke.object == index; });
    };
    EXPECT_GT(count_of(draw(scene, front_camera()), 0), 0);
    EXPECT_GT(count_of(draw(scene, front_camera()), 1), 0);
    scene.objects[1].transform = placed(0, 2, {0, 0, 5}); // now before the small one
    EXPECT_EQ(count_of(draw(scene, front_camera()), 0), 0);
    EXPECT_GT(count_of(draw(scene, front_camera()), 1), 0);
}

vec3 colour_at(const Image& image, int x, int y) { return {image.at(x, y)[0], image.at(x, y)[1], image.at(x, y)[2]}; }

TEST(SceneRender, EachObjectHasItsMaterial)
{
    Scene scene;
    const auto sphere = mesh("sphere", 5000);
    scene.objects = {object(sphere, placed(0, 0.5, {-2, 0, 0})), object(sphere, placed(0, 0.5, {0, 0, 0})), object(sphere, placed(0, 0.5, {2, 0, 0}))};
    scene.materials["clay"] = {vec3(1, 0.5f, 0), 1};
    scene.objects[0].material = "clay";
    scene.objects[1].material = Material{vec3(0, 0, 1), 1};
    scene.render.shade = 1;
    const Image image = render(scene, front_camera());
    EXPECT_EQ(colour_at(image, 50, 75), vec3(1, 0.5f, 0));
    EXPECT_EQ(colour_at(image, 100, 75), vec3(0, 0, 1));
    EXPECT_EQ(colour_at(image, 150, 75), scene.render.colour);
    scene.objects[0].material = "cley";
    EXPECT_THROW(render(scene, front_camera()), Error::Input);
}

TEST(SceneRender, LightComesFromTheScene)
{
    Scene scene;
    scene.objects = {object(mesh("sphere", 5000))};
    scene.lights = {DistantLight{{1, 0, 0}}};
    const Image lit = render(scene, front_camera());
    EXPECT_GT(lit.at(120, 75)[0], lit.at(80, 75)[0] + 0.2f);
    scene.lights = {Lamp{{-9, 0, 0}}};
    const Image lamp = render(scene, front_camera());
    EXPECT_GT(lamp.at(80, 75)[0], lamp.at(120, 75)[0] + 0.2f);
    scene.lights.emplace_back(Headlight());
    EXPECT_THROW(render(scene, front_camera()), Error::Input);
}

TEST(SceneRender, AFileThatIsReadBackGivesTheSamePicture)
{
    const test::TemporaryFolder folder;
    Scene scene = two_objects();
    for (std::size_t i = 0; i < 2; ++i) {
        scene.objects[i].file = folder / ("model" + std::to_string(i) + ".obj");
        write_mesh(*scene.objects[i].mesh, scene.objects[i].file);
        scene.objects[i].mesh.reset();
    }
    scene.objects[0].material = "clay";
    scene.materials["clay"] = {vec3(1, 0.6f, 0), 0.3f};
    scene.lights = {DistantLight{{1, 2, 3}}};
    scene.render.ground = true;
    const Scene again = scene_from_json(scene_to_json(scene, folder.path()), folder / "scene.json");
    EXPECT_TRUE(same_bytes(render(scene, front_camera()), render(again, front_camera())));
}

TEST(SceneRender, IsTheSameForAnyNumberOfThreads)
{
    const Scene scene = two_objects();
    const Image one = with_threads(1, [&] { return render(scene, front_camera()); }), four = with_threads(4, [&] { return render(scene, front_camera()); });
    EXPECT_TRUE(same_bytes(one, four));
}

TEST(SceneRender, LinesArePartOfThePictureWhereTheSceneAsksForThem)
{
    Scene scene = two_objects();
    const Image with_lines = render(scene, front_camera());
    scene.lines = no_lines();
    const Image bare = render(scene, front_camera());
    EXPECT_GT(difference(bare, with_lines), 0.01);
    scene.image_lines.method = ImageMethod::depth;
    EXPECT_GT(difference(bare, render(scene, front_camera())), 0.005);
}

TEST(SceneRender, RefusesAnEmptySceneAndABadTransform)
{
    Scene scene;
    EXPECT_THROW(render(scene, front_camera()), Error::Input);
    scene.objects = {object(mesh("sphere", 200))};
    scene.objects[0].transform[0][0] = 2;
    EXPECT_THROW(render(scene, front_camera()), Error::Input);
    scene.objects[0].transform = dmat4(std::nan(""));
    EXPECT_THROW(render(scene, front_camera()), Error::Input);
}

TEST(SceneRender, TheExampleOfTheManualCompilesAndShowsSomething)
{
    const test::TemporaryFolder folder;
    write_mesh(*mesh("knot", 2000), folder / "knot.ply");
    const std::string knot = (folder / "knot.ply").string();
    // docs/scene.md
    limn::Scene scene;
    const auto model = std::make_shared<const limn::Mesh>(limn::read_mesh(knot));
    scene.objects.emplace_back().mesh = model;
    scene.objects.back().material = limn::Material{.colour = {0.78f, 0.5f, 0.35f}};
    scene.lights = {limn::DistantLight{{1, 2, 3}}};
    scene.lines.lines = {limn::LineType::contour, limn::LineType::suggestive};
    const limn::SceneModel ready = limn::prepare_scene(scene);
    const limn::Camera camera = limn::Camera::framing(ready.bounds, {.view = "30,20", .size = {160, 120}});
    const limn::Image image = limn::render(scene, ready, camera);
    EXPECT_LT(*std::min_element(image.samples.begin(), image.samples.end()), 0.1f);
    EXPECT_EQ(image.size(), ivec2(160, 120));
}

} // namespace
} // namespace limn
