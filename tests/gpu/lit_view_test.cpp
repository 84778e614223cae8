// Lit pictures of the device beside those of the processor.

#include "limn/gpu/lit_view.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/gpu.h"
#include "limn/scene/loop_model.h"
#include "limn/subdivision/control_samples.h"
#include "support/staged_shape.h"

namespace limn::test {
namespace {

/// Styles of `limn render`, each with another light.
std::vector<std::pair<std::string, ShadeOptions>> styles(const SeenScene& scene)
{
    ShadeOptions smooth, flat, toon, dark, gouraud, normals;
    smooth.ground = ground_under(scene, dvec3(0, 0, 1));
    flat.shading = Shading::flat;
    flat.to_light = dvec3(1, -2, 3);
    toon.shading = Shading::toon;
    toon.toon_levels = 3;
    toon.lamp = scene.centre + scene.scale * dvec3(2, -1, 2);
    toon.ground = smooth.ground;
    dark.dark = vec3(0.05f);
    dark.light = vec3(0.3f, 0.32f, 0.4f);
    dark.background = vec3(0);
    gouraud.shading = Shading::gouraud;
    gouraud.lamp = toon.lamp;
    normals.shading = Shading::normals;
    normals.ground = smooth.ground;
    return {{"smooth", smooth}, {"flat", flat}, {"toon", toon}, {"dark", dark}, {"gouraud", gouraud}, {"normals", normals}};
}

double share_of_other_pixels(const Image& a, const Image& b, double limit)
{
    std::size_t other = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            double most = 0;
            for (int c = 0; c < 3; ++c)
                most = std::max(most, std::abs(double(a.at(x, y)[c]) - double(b.at(x, y)[c])));
            other += most > limit;
        }
    return double(other) / (double(a.width) * double(a.height));
}

class GpuLit : public Gpu {};

// Within 2/255 on 99.9 % of the pixels, those on edges among them: both take the same places of the same pixels.
TEST_F(GpuLit, PicturesAreThoseOfTheProcessor)
{
    for (const char* name : {"torus", "blob"}) {
        const StagedShape stage(name, 20000);
        const gpu::LitRenderer renderer(stage.model);
        for (const auto& [style, options] : styles(stage.seen()))
            for (const bool orthographic : {false, true}) {
                const Camera camera = stage.camera({200, 150}, orthographic);
                const double other = share_of_other_pixels(renderer.render(camera, options), shade(stage.seen(), camera, options), 2.0 / 255);
                fmt::print("[ lit      ] {}, {}{}: {:.3f} % of the pixels differ by more than 2/255\n", name, style, orthographic ? ", orthographic" : "", 100 * other);
                EXPECT_LE(other, 0.001) << name << ", " << style;
            }
    }
}

TEST_F(GpuLit, EachObjectHasAMaterialOfItsOwn)
{
    const Shape torus = make_shape({.name = "torus", .triangles = 3000}), blob = make_shape({.name = "blob", .triangles = 3000});
    const PlacedSurface placed[] = {{&torus.mesh, &torus.exact}, {&blob.mesh, &blob.exact, glm::translate(dmat4(1), dvec3(1, 2, 0))}};
    const LineModel model = build_line_model(placed);
    const RayScene rays = build_ray_scene(model);
    const SeenScene seen = seen_scene(model, rays);
    ShadeOptions options;
    options.materials = {{.colour = vec3(1, 0.2f, 0.1f)}, {.colour = vec3(0.1f, 0.4f, 0.9f), .unlit = 0.5f}};
    Camera camera;
    camera.eye = dvec3(9, 6, 7);
    camera.look = seen.centre;
    camera.size = {240, 180};
    const Image device = gpu::LitRenderer(model).render(camera, options);
    EXPECT_LE(share_of_other_pixels(device, shade(seen, camera, options), 2.0 / 255), 0.001);
    options.materials.pop_back();
    EXPECT_THROW(gpu::LitRenderer(model).render(camera, options), Error::Input);
}

// Checklist 30 and 36 of the silhouette specification: control meshes with their normals in a map; two objects share one, turned, and a third has
// its own.
TEST_F(GpuLit, NormalsFromMapsAreThoseOfTheProcessor)
{
    SubdivisionOptions options;
    options.scheme = SubdivisionOptions::Scheme::loop;
    const auto model = [&](const char* sample) { return std::make_shared<const LoopModel>(make_control_sample(sample), options); };
    for (const auto normals : {SubdivisionOptions::Normals::map, SubdivisionOptions::Normals::limit}) {
        const bool is_map = normals == SubdivisionOptions::Normals::map;
        options.normals = normals;
        const auto creature = model("creature"), rook = model("rook");
        const PlacedLoop placed[] = {{creature}, {creature, glm::rotate(glm::translate(dmat4(1), dvec3(0.5, 0.2, 2)), 0.7, dvec3(1, 2, 3))},
                                     {rook, glm::translate(dmat4(1), dvec3(-1.5, 0, 1))}};
        for (const bool orthographic : {false, true}) {
            const Camera camera = Camera::framing({dvec3(-2), dvec3(2)}, {.view = "35,25", .up_axis = 'y', .size = {240, 180}, .orthographic = orthographic});
            const auto view = make_loop_view(placed, camera);
            const gpu::LitRenderer renderer(view->lines, 2048, view->mapped_normals()), bare(view->lines);
            for (const auto& [style, shade_options] : styles(view->seen)) {
                if (style != "smooth" && style != "normals" && !(is_map && style == "gouraud"))
                    continue; // what else there is has been compared above, or takes no normals from maps
                const Image expected = shade(view->seen, camera, shade_options), painted = renderer.render(camera, shade_options);
                const double other = share_of_other_pixels(painted, expected, 2.0 / 255);
                fmt::print("[ lit      ] {}, {}{}: {:.3f} % of the pixels differ by more than 2/255\n", is_map ? "map" : "limit", style,
                           orthographic ? ", orthographic" : "", 100 * other);
                EXPECT_LE(other, 0.001) << style;
                if (style == "normals") {
                    EXPECT_GT(share_of_other_pixels(bare.render(camera, shade_options), expected, 2.0 / 255), 0.02) << "vertices' normals would do";
                }
            }
        }
    }
}

TEST_F(GpuLit, LargePicturesArePutTogetherFromTiles)
{
    const StagedShape stage("knot", 8000);
    ShadeOptions options;
    options.ground = ground_under(stage.seen(), dvec3(0, 0, 1));
    options.samples = 4;
    for (const bool orthographic : {false, true}) {
        const Camera camera = stage.camera({230, 170}, orthographic);
        const Image whole = gpu::LitRenderer(stage.model).render(camera, options), tiled = gpu::LitRenderer(stage.model, 64).render(camera, options);
        EXPECT_LE(share_of_other_pixels(whole, tiled, 1e-4), 0.001); // the tiles' matrices round otherwise
    }
}

TEST_F(GpuLit, IsTheSameTwice)
{
    const StagedShape stage("blob", 5000);
    const gpu::LitRenderer renderer(stage.model);
    const Camera camera = stage.camera({160, 120});
    EXPECT_EQ(renderer.render(camera).samples, renderer.render(camera).samples);
}

TEST_F(GpuLit, ShadesAModelWithoutNormalsByItsTriangles)
{
    StagedShape stage("blob", 2000);
    const Camera camera = stage.camera({120, 90});
    ShadeOptions flat;
    flat.shading = Shading::flat;
    const Image expected = gpu::LitRenderer(stage.model).render(camera, flat);
    stage.model.normals.clear();
    EXPECT_EQ(gpu::LitRenderer(stage.model).render(camera).samples, expected.samples);
}

} // namespace
} // namespace limn::test
