#include "bench_truth.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "flip.h"
#include "highlight.h"
#include "limn/lines/regions.h"
#include "limn/pattern/filament.h"
#include "limn/raycast/gbuffer.h"
#include "limn/raycast/occlusion.h"
#include "limn/scene/pattern_picture.h"
#include "limn/scene/render.h"
#include "limn/surface/shapes.h"
#include "pattern_panels.h"
#include "print_truth.h"

using namespace limn;

namespace {

constexpr const char* material = "petg-grey";
constexpr double periods[] = {6, 1.5}; ///< pixels a layer on upright walls

struct Model {
    LayerModel model;
    bool rounded; ///< its truth has beads
};
constexpr Model models[] = {{LayerModel::seed, false}, {LayerModel::slope, false}, {LayerModel::bead, true}};

Scene scene_of(const Mesh& mesh)
{
    Scene scene;
    SceneObject object;
    object.mesh = std::make_shared<const Mesh>(mesh);
    scene.objects = {object};
    return scene;
}

/// A model as patterns see it.
struct Stage {
    Scene scene;
    SceneModel model;
    Camera camera;
    std::vector<std::uint8_t> mask;

    Stage(const Mesh& mesh, const ivec2& size) : scene(scene_of(mesh)), model(prepare_scene(scene))
    {
        camera = Camera::framing(mesh.bounds(), {.view = "35,22", .up_axis = 'z', .size = size});
        const GBuffer seen = trace_gbuffer(seen_scene(model.lines, model.rays), camera);
        for (const std::uint32_t object : seen.objects)
            mask.push_back(object != none);
    }
    /// Height of layers that are so many pixels on an upright wall in the middle.
    double layer_height(double pixels) const
    {
        const dvec3 way = camera.look - camera.eye;
        const double cosine = std::hypot(way.x, way.y) / glm::length(way);
        return pixels / (camera.pixels_per_unit(glm::length(way)) * cosine);
    }
};

constexpr double bead_bulge = 1; ///< half circles, as the wall of a single bead has them

PatternOptions options_of(LayerModel model, double height)
{
    PatternOptions options;
    options.kind = PatternKind::layers;
    options.layer_model = model;
    options.layer_height = height;
    options.bulge = bead_bulge;
    options.variety = 0;
    options.filament = material;
    return options;
}

struct Lit {
    ShadeOptions shade;
    PatternPlace place = {1, {}, dvec3(0, 0, 1)};
    PatternLight light;
};

Lit lit(const Stage& stage, const SeenScene& seen)
{
    Lit result;
    result.shade.background = vec3(0.82f);
    result.shade.occlusion = ray_occlusion(seen);
    result.light = pattern_lights(seen, stage.camera, result.shade, result.place).front();
    return result;
}

} // namespace

TruthTables compare_with_truth(int width, Console& console)
{
    TruthTables tables;
    std::vector<std::vector<Image>> rows;
    const std::vector<NamedMesh> shapes = print_shapes();
    double done = 0;
    for (const NamedMesh& shape : shapes) {
        const Stage stage(shape.mesh, {width, width * 3 / 4});
        const SeenScene seen = seen_scene(stage.model.lines, stage.model.rays);
        const Lit by = lit(stage, seen);
        for (const double period : periods) {
            console.progress(fmt::format("rays meet the steps of a {}", shape.name), done++ / double(std::size(periods) * shapes.size()));
            const double height = stage.layer_height(period);
            const auto truth = [&](double bulge) {
                return trace_print(stepped_print(shape.mesh, {height, bulge}), stage.camera, {finish_of(find_filament(material)), by.light, linear_colour(by.shade.background), 0.5f, truth_side});
            };
            const Image flat = truth(0), rounded = truth(bead_bulge);
            std::vector<Image> painted;
            for (const Model& m : models)
                painted.push_back(paint_pattern(seen, stage.camera, options_of(m.model, height), by.place, by.shade));
            for (const bool beads : {false, true}) {
                const Image& wanted = beads ? rounded : flat;
                const auto aspect = [&](const Image& image) { return fmt::format("{:.2f}", highlight_of(image, stage.mask, 4).aspect); };
                std::vector<std::string> row = {shape.name, fmt::format("{}", period), beads ? "beads" : "flat steps"};
                for (const Image& image : painted)
                    row.push_back(fmt::format("{:.3f}", flip(image, wanted)));
                row.push_back(aspect(wanted));
                for (const Image& image : painted)
                    row.push_back(aspect(image));
                tables.errors.add(row);
            }
            if (period == periods[0])
                rows.push_back({flat, painted[0], painted[1], rounded, painted[2]});
        }
    }
    tables.strip = in_rows(rows, 2);
    return tables;
}
