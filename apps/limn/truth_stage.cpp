#include "truth_stage.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "highlight.h"
#include "limn/lines/regions.h"
#include "limn/pattern/filament.h"
#include "limn/raycast/gbuffer.h"
#include "limn/raycast/occlusion.h"
#include "limn/scene/pattern_picture.h"
#include "pattern_panels.h"

using namespace limn;

namespace {

constexpr double glint = 4; ///< pixels, a Gauss filter's: what is finer belongs to layers, not to highlights

Scene scene_of(const Mesh& mesh)
{
    Scene scene;
    SceneObject object;
    object.mesh = std::make_shared<const Mesh>(mesh);
    scene.objects = {object};
    return scene;
}

} // namespace

TruthStage::TruthStage(const Mesh& mesh, const ivec2& size)
    : scene(scene_of(mesh)), model(prepare_scene(scene)), camera(filling_camera(model, "35,22", size)),
      seen(seen_scene(model.lines, model.rays))
{
    look_closer(1);
    shade.background = vec3(0.82f);
    shade.occlusion = ray_occlusion(seen);
    light = pattern_lights(seen, camera, shade, place).front();
}

void TruthStage::look_closer(double factor)
{
    camera.fov_degrees = 2 * glm::degrees(std::atan(std::tan(glm::radians(camera.fov_degrees) / 2) / factor));
    const GBuffer pixels = trace_gbuffer(seen, camera);
    mask.clear();
    for (const std::uint32_t object : pixels.objects)
        mask.push_back(object != none);
}

double TruthStage::layer_height(double pixels) const
{
    const dvec3 way = camera.look - camera.eye;
    const double cosine = std::hypot(way.x, way.y) / glm::length(way);
    return pixels / (camera.pixels_per_unit(glm::length(way)) * cosine);
}

Image TruthStage::painted(LayerModel layers, double height) const
{
    PatternOptions options;
    options.kind = PatternKind::layers;
    options.layer_model = layers;
    options.layer_height = height;
    options.bulge = single_wall_bulge;
    options.variety = 0;
    options.filament = truth_filament;
    return paint_pattern(seen, camera, options, place, shade);
}

TracedPrint TruthStage::traced(const PrintBody& print) const
{
    return trace_print(print, camera, {finish_of(find_filament(truth_filament)), light, linear_colour(shade.background), 0.5f, truth_side});
}

std::string TruthStage::aspect_text(const Image& image, const std::vector<std::uint8_t>& filled) const
{
    std::vector<std::uint8_t> both(mask.size());
    std::transform(mask.begin(), mask.end(), filled.begin(), both.begin(), std::bit_and<>());
    const std::optional<Highlight> highlight = highlight_of(image, both, glint);
    return highlight ? fmt::format("{:.2f}", highlight->aspect) : std::string("none");
}
