#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/drawing/agreement.h"
#include "limn/scene/overlay.h"
#include "limn/scene/render.h"
#include "limn/scene/scene_json.h"
#include "limn/subdivision/control_samples.h"
#include "limn/subdivision/loop_refine.h"
#include "limn/subdivision/subdivide.h"
#include "support/support.h"

namespace limn {
namespace {

using Silhouette = SubdivisionOptions::Silhouette;
using Normals = SubdivisionOptions::Normals;

Scene scene_of(const Mesh& mesh, const dmat4& transform = dmat4(1))
{
    Scene scene;
    scene.objects.emplace_back().mesh = std::make_shared<const Mesh>(mesh);
    scene.objects.back().transform = transform;
    return scene;
}

Scene loop_scene(const Mesh& control, const SubdivisionOptions& options = {}, const dmat4& transform = dmat4(1))
{
    Scene scene = scene_of(control, transform);
    scene.subdivision = options;
    scene.subdivision.scheme = SubdivisionOptions::Scheme::loop;
    return scene;
}

Mesh limit_mesh(const Mesh& control, int levels)
{
    SubdivideOptions options;
    options.levels = levels;
    options.limit = true;
    return subdivide(control, options).mesh;
}

Camera camera_for(const Mesh& mesh, const std::string& view, ivec2 size = {300, 240})
{
    Framing framing;
    framing.view = view;
    framing.size = size;
    return Camera::framing(mesh.bounds(), framing);
}

/// The share of samples that differ by more than so many steps of 1/255.
double share_beyond(const Image& a, const Image& b, double steps)
{
    EXPECT_EQ(a.samples.size(), b.samples.size());
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < a.samples.size(); ++i)
        beyond += std::abs(double(a.samples[i]) - double(b.samples[i])) > steps / 255;
    return double(beyond) / double(a.samples.size());
}

/// What turns by n . v turns by the shape operator: against normals a little further on the surface.
TEST(LoopModel, FineMeshesHaveTheCurvatureOfTheLimitSurface)
{
    const Mesh control = make_control_sample("bent-cylinder");
    const LoopModel model(control, {});
    const PreparedMesh fine = model.fine_mesh(3, Need::derivative);
    const Surface& s = fine.surface;
    std::size_t checked = 0;
    for (const uvec3& t : fine.mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            const dvec3 along = fine.mesh.positions[b] - fine.mesh.positions[a];
            const auto turned = [&](std::uint32_t v) {
                return dvec3(s.k1[v] * s.e1[v]) * glm::dot(dvec3(s.e1[v]), along) + dvec3(s.k2[v] * s.e2[v]) * glm::dot(dvec3(s.e2[v]), along);
            };
            const dvec3 wanted = dvec3(s.normals[b]) - dvec3(s.normals[a]), found = 0.5 * (turned(a) + turned(b));
            const double turn = glm::length(wanted);
            if (turn < 0.02)
                continue;
            ++checked;
            EXPECT_LT(glm::distance(found, wanted), 0.25 * turn + 0.02);
        }
    EXPECT_GT(checked, 5000u);
}

/// Lines of a coarse control mesh are those of a fine mesh on the limit surface, within half a pixel or so.
TEST(LoopModel, ContoursAreThoseOfTheLimitSurface)
{
    for (const std::string name : {"creature", "bent-cylinder"}) {
        const Mesh control = make_control_sample(name), fine = limit_mesh(control, 4);
        const Camera camera = camera_for(fine, "30,20", {600, 450});
        Scene coarse = loop_scene(control), wanted = scene_of(fine);
        coarse.lines.lines = wanted.lines.lines = {LineType::outline};
        const LineAgreement agreement = compare_lines(line_pixels(draw(coarse, camera)), line_pixels(draw(wanted, camera)), 1.5);
        EXPECT_GT(agreement.f1(), 0.99) << name;
        const LineAgreement polygons = compare_lines(line_pixels(draw(scene_of(control), camera)), line_pixels(draw(wanted, camera)), 1.5);
        EXPECT_LT(polygons.f1(), 0.9) << name;
    }
}

TEST(LoopModel, PicturesAreThoseOfTheLimitSurface)
{
    const Mesh control = make_control_sample("creature"), fine = limit_mesh(control, 5);
    const Camera camera = camera_for(fine, "iso");
    const Image wanted = render(scene_of(fine), camera);
    const double near = share_beyond(render(loop_scene(control, {.surface_error = 0.25}), camera), wanted, 8);
    const double usual = share_beyond(render(loop_scene(control), camera), wanted, 8);
    const double off = share_beyond(render(loop_scene(control, {.silhouette = Silhouette::off}), camera), wanted, 8);
    EXPECT_LT(near, 0.006);
    EXPECT_LT(usual, 0.015);
    EXPECT_LT(2 * near, off);
    EXPECT_LT(1.5 * usual, off);
}

/// The outline alone does not need them: all the coarse triangles are there, and still the shape's pixels are the limit's.
TEST(LoopModel, OutlinesNeedNoFineTriangles)
{
    const Mesh control = make_control_sample("bent-cylinder"), fine = limit_mesh(control, 5);
    const Camera camera = camera_for(fine, "20,10");
    Scene coarse = loop_scene(control, {.surface_error = 0}), wanted = scene_of(fine);
    coarse.render.shade = wanted.render.shade = 1; // nothing but its shape
    EXPECT_LT(share_beyond(render(coarse, camera), render(wanted, camera), 100), 1e-4);
}

TEST(LoopModel, StandsWhereItsTransformPutsIt)
{
    const Mesh control = make_control_sample("creature");
    const double c = 2 * std::cos(0.7), s = 2 * std::sin(0.7);
    const dmat4 transform(dvec4(c, s, 0, 0), dvec4(-s, c, 0, 0), dvec4(0, 0, 2, 0), dvec4(3, -1, 0.5, 1));
    Mesh moved = control;
    for (dvec3& p : moved.positions)
        p = dvec3(transform * dvec4(p, 1));
    const Camera camera = camera_for(moved, "iso");
    EXPECT_LT(share_beyond(render(loop_scene(control, {}, transform), camera), render(loop_scene(moved), camera), 2), 2e-3);
    Camera parallel = camera;
    parallel.orthographic = true;
    parallel.ortho_height = 6;
    EXPECT_LT(share_beyond(render(loop_scene(control, {}, transform), parallel), render(loop_scene(moved), parallel), 2), 2e-3);
}

/// Sharp edges stay sharp in normals, and the mesh is one piece across them.
TEST(LoopModel, KeepsCreases)
{
    const PreparedMesh fine = LoopModel(make_control_sample("mug"), {}).fine_mesh(2, Need::curvature);
    ASSERT_FALSE(fine.weld.empty());
    std::size_t split = 0;
    for (std::uint32_t v = 0; v < fine.weld.size(); ++v)
        if (fine.weld[v] != v) {
            ++split;
            EXPECT_EQ(fine.mesh.positions[v], fine.mesh.positions[fine.weld[v]]);
        }
    EXPECT_GT(split, 20u);
    EXPECT_EQ(std::count(fine.connectivity.solid.twin.begin(), fine.connectivity.solid.twin.end(), none), 0);
    EXPECT_GT(std::count(fine.connectivity.smooth.twin.begin(), fine.connectivity.smooth.twin.end(), none), 0);
}

TEST(LoopModel, IsTheSameForAnyNumberOfThreads)
{
    const Mesh control = make_control_sample("bent-cylinder");
    const Camera camera = camera_for(control, "iso", {120, 120});
    const Image one = with_threads(1, [&] { return render(loop_scene(control), camera); });
    for (const int threads : {2, 3})
        EXPECT_EQ(with_threads(threads, [&] { return render(loop_scene(control), camera); }).samples, one.samples);
}

/// Checklist 42: of a scheme only the masks are its own. That which puts vertices into the middles of edges changes nothing in the picture.
TEST(LoopModel, PicturesOfAnotherSchemeNeedNothingElse)
{
    const Mesh control = make_control_sample("creature");
    ControlMesh linear = make_control_mesh(control);
    for (int level = 0; level < 2; ++level) {
        for (std::uint32_t e = 0; e < linear.topology.edge_count(); ++e) {
            const std::uint32_t h = linear.topology.half_edge[e];
            linear.positions.push_back(0.5 * (linear.positions[linear.topology.start(h)] + linear.positions[linear.topology.end(h)]));
        }
        linear.topology = refine(linear.topology);
    }
    Mesh fine;
    fine.positions = linear.positions;
    fine.triangles = linear.topology.triangles;
    Scene flat = scene_of(control), refined = scene_of(fine);
    flat.render.shading = refined.render.shading = Shading::flat;
    const Camera camera = camera_for(control, "iso");
    EXPECT_LT(share_beyond(render(refined, camera), render(flat, camera), 1), 1e-4);
}

TEST(LoopModel, SeedAndOffAndVertexNormalsMakePicturesToo)
{
    const Mesh control = make_control_sample("creature");
    const Camera camera = camera_for(control, "iso", {120, 100});
    std::vector<Image> pictures;
    for (const Silhouette silhouette : {Silhouette::exact, Silhouette::seed, Silhouette::off})
        for (const Normals normals : {Normals::limit, Normals::vertex}) {
            SubdivisionOptions options;
            options.silhouette = silhouette;
            options.normals = normals;
            pictures.push_back(render(loop_scene(control, options), camera));
            for (std::size_t i = 0; i + 1 < pictures.size(); ++i)
                EXPECT_NE(pictures[i].samples, pictures.back().samples);
        }
}

TEST(LoopModel, FinerLevelsComeFromTheErrorAskedFor)
{
    const LoopModel model(make_control_sample("creature"), {});
    for (const double error : {0.05, 0.01, 0.002, 0.0005}) {
        const int levels = levels_for(model, error);
        EXPECT_LE(model.deviation(levels), error);
        if (levels > 0) {
            EXPECT_GT(model.deviation(levels - 1), error);
        }
    }
    EXPECT_LE(double(model.face_count()) * std::pow(4.0, levels_for(model, 1e-30)), 4e6);
    const LoopModel finer(make_control_sample("creature"), {.base_levels = 2});
    EXPECT_NEAR(model.deviation(2), finer.deviation(), 1e-12);
}

TEST(LoopModel, OptionsAreKeysOfScenes)
{
    Scene scene = loop_scene(make_control_sample("leaf"), {.silhouette = Silhouette::seed, .outline_error = 0.25, .base_levels = 1, .normals = Normals::vertex});
    scene.objects[0].mesh.reset();
    const test::TemporaryFolder folder;
    scene.objects[0].file = folder / "leaf.obj";
    test::write_text(folder / "leaf.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const Scene read = scene_from_json(scene_to_json(scene), folder / "scene.json");
    EXPECT_EQ(read.subdivision.scheme, SubdivisionOptions::Scheme::loop);
    EXPECT_EQ(read.subdivision.silhouette, Silhouette::seed);
    EXPECT_EQ(read.subdivision.outline_error, 0.25);
    EXPECT_EQ(read.subdivision.base_levels, 1);
    EXPECT_EQ(read.subdivision.normals, Normals::vertex);
}

/// Each letter adds something, but F.
TEST(Overlay, ShowsEachStage)
{
    const Mesh control = make_control_sample("creature");
    const Camera camera = camera_for(control, "iso", {200, 160});
    const Scene scene = loop_scene(control);
    const SceneModel model = prepare_scene(scene);
    const std::unique_ptr<const LoopView> view = make_loop_view(model.loops, camera);
    const Image plain = render(scene, model, camera);
    for (const std::string letter : {"A", "B", "C", "D", "E"}) {
        const double changed = share_beyond(draw_overlay(plain, *view, model.loops, camera, letter), plain, 30);
        EXPECT_GT(changed, 0.005) << letter;
        EXPECT_LT(changed, 0.5) << letter;
    }
    EXPECT_EQ(draw_overlay(plain, *view, model.loops, camera, "F").samples, plain.samples);
    EXPECT_THROW(draw_overlay(plain, *view, model.loops, camera, "X"), Error::Input);
}

} // namespace
} // namespace limn
