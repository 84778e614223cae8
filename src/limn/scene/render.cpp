#include "limn/scene/render.h"

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/drawing/raster.h"
#include "limn/geometry/read_mesh.h"
#include "limn/lines/draw.h"
#include "limn/lines/feature_size.h"
#include "limn/lines/prepare.h"
#include "limn/lines/regions.h"

namespace limn {
namespace {

void check_transforms(const Scene& scene)
{
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        if (const std::string fault = transform_fault(scene.objects[i].transform); !fault.empty())
            throw Error::Input(fmt::format("objects[{}]: the transform {}", i, fault));
}

Mesh mesh_of(const SceneObject& object) { return object.mesh ? *object.mesh : read_mesh(object.file, {.format = object.format}); }

/// The maps of a model, which any of the objects that show it may name.
std::shared_ptr<const ShadowMaps> maps_of(const Scene& scene, std::size_t first, const Mesh& mesh)
{
    const std::vector<std::size_t> firsts = first_of_same_model(scene.objects);
    for (std::size_t i = 0; i < firsts.size(); ++i)
        if (const std::filesystem::path& file = scene.objects[i].shadow_maps; firsts[i] == first && !file.empty()) {
            const auto maps = std::make_shared<const ShadowMaps>(read_csm(file));
            check_shape(*maps, mesh, file.string());
            return maps;
        }
    return nullptr;
}

} // namespace

SceneModel prepare_scene(const Scene& scene)
{
    check_transforms(scene);
    PrepareOptions options;
    options.estimate = scene.surface;
    options.estimate.need = scene.shader_lines.method == ShaderMethod::off ? surface_need(scene.lines) : Need::derivative;
    options.crease.angle = scene.lines.crease_angle;
    const std::vector<std::size_t> first = first_of_same_model(scene.objects);
    std::map<std::size_t, PreparedMesh> meshes; // by the first object that shows it
    std::map<std::size_t, std::shared_ptr<const LoopModel>> loops;
    std::map<std::size_t, std::shared_ptr<const ShadowMaps>> maps;
    ObjectMaps shadow_maps;
    std::vector<dmat4> transforms;
    std::vector<PlacedLoop> placed_loops;
    std::vector<PlacedSurface> placed;
    Bounds bounds;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const SceneObject& object = scene.objects[i];
        const bool is_loop = scene.subdivision.scheme == SubdivisionOptions::Scheme::loop;
        if (is_loop && !object.shadow_maps.empty())
            throw Error::Input(fmt::format("objects[{}]: maps are of a mesh as it is, not of what subdivision makes of it", i));
        if (first[i] == i && is_loop) {
            loops[i] = std::make_shared<const LoopModel>(mesh_of(object), scene.subdivision);
            meshes.emplace(i, loops[i]->fine_mesh(levels_for_whole(*loops[i], scene.subdivision.outline_error), options.estimate.need));
        } else if (first[i] == i) {
            Mesh mesh = mesh_of(object);
            maps[i] = maps_of(scene, i, mesh);
            meshes.emplace(i, prepare_mesh(std::move(mesh), options));
        }
        shadow_maps.push_back(maps[first[i]]);
        transforms.push_back(object.transform);
        if (is_loop)
            placed_loops.push_back({loops.at(first[i]), object.transform});
        placed.push_back(meshes.at(first[i]).placed(scene.objects[i].transform));
        bounds.add(world_bounds(placed.back()));
    }
    LineModel lines = build_line_model(placed);
    RayScene rays = build_ray_scene(lines);
    return {std::move(lines), std::move(rays), bounds, std::move(placed_loops), std::move(shadow_maps), std::move(transforms)};
}

PixelOptions pixel_options(const Scene& scene, const SceneModel& model, const LineModel& lines, const SeenScene& seen)
{
    PixelOptions options;
    options.shade = shade_options(lit_by(scene.lights, scene.render), seen, up_vector(up_axis_of(scene)));
    hide_by_maps(options.shade, scene.render.shadow, model.shadow_maps, model.transforms, seen);
    options.shade.materials = object_materials(scene, default_material(scene.render));
    options.image_lines = scene.image_lines;
    options.shader_lines = scene.shader_lines;
    if (scene.shader_lines.method != ShaderMethod::off) {
        options.shader_lines.suggestive_limit = float(scene.lines.suggestive_limit);
        options.shader_lines.feature_size = model_feature_size(lines, scene.lines.feature_size);
    }
    options.ink = scene.style.line(LineType::contour).colour;
    options.pattern = scene.pattern;
    options.place.up = up_vector(up_axis_of(scene));
    const SceneObject& first = scene.objects.front();
    options.place.mm_per_unit = mm_per_unit(scene.pattern.units, first.format.empty() ? file_ending(first.file) : first.format).value_or(0); // a mesh in memory has no format
    for (const SceneObject& object : scene.objects)
        options.place.transforms.push_back(object.transform);
    return options;
}

Image render(const Scene& scene, const SceneModel& model, const Camera& camera, const std::string& device)
{
    const std::unique_ptr<const LoopView> view = model.loops.empty() ? nullptr : make_loop_view(model.loops, camera);
    const SeenScene seen = view ? view->seen : seen_scene(model.lines, model.rays);
    const LineModel& lines = view ? view->lines : model.lines;
    PixelPainter painter(device, [](const std::string&) {});
    const Image picture = painter.paint({lines, seen, up_vector(up_axis_of(scene)), view.get()}, camera, pixel_options(scene, model, lines, seen));
    if (scene.lines.lines.empty())
        return picture;
    Style style = scene.style;
    style.page = {}; // of drawings
    return lay_over(picture, draw(scene, model, camera), style);
}

Image render(const Scene& scene, const Camera& camera) { return render(scene, prepare_scene(scene), camera); }

Drawing draw(const Scene& scene, const SceneModel& model, const Camera& camera) { return draw_lines(model.lines, model.rays, camera, scene.lines); }

Drawing draw(const Scene& scene, const Camera& camera) { return draw(scene, prepare_scene(scene), camera); }

} // namespace limn
