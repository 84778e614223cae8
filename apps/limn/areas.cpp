#include "areas.h"

#include "limn/raycast/shading.h"

using namespace limn;

namespace {

Image shaded(const SeenScene& scene, const Camera& camera, const AreaOptions& areas, const Style& style)
{
    ShadeOptions options;
    options.shading = areas.shade == Shade::flat ? Shading::flat : Shading::smooth;
    options.to_light = areas.to_light;
    options.lamp = areas.lamp;
    options.light = shape_material(style).colour;
    options.dark = shape_material(style).dark();
    options.materials = areas.materials;
    options.background = style.paper;
    return shade(scene, camera, options);
}

} // namespace

Material shape_material(const Style& style) { return {style.shape, 0.35f}; }

void add_areas(Drawing& drawing, const SeenScene& scene, const AreaOptions& options, const Style& style)
{
    const Camera& camera = drawing.camera;
    if (options.shade != Shade::none)
        drawing.background = shaded(scene, camera, options, style);
    else if (options.fill || style.look == Look::dark)
        drawing.regions.push_back(silhouette_region(scene, camera, {.colour = style.shape}));
    if (style.look == Look::toon)
        drawing.regions.push_back(toon_region(scene, camera, ShadeOptions().toon_limit, {}, {.colour = vec3(0)}));
}
