#include "areas.h"

#include "limn/raycast/shading.h"

using namespace limn;

namespace {

Image shaded(const SeenScene& scene, const Camera& camera, Shade shade_kind, const Style& style)
{
    ShadeOptions options;
    options.shading = shade_kind == Shade::flat ? Shading::flat : Shading::smooth;
    options.light = style.shape;
    options.dark = 0.35f * style.shape;
    options.background = style.paper;
    return shade(scene, camera, options);
}

} // namespace

void add_areas(Drawing& drawing, const SeenScene& scene, const AreaOptions& options, const Style& style)
{
    const Camera& camera = drawing.camera;
    if (options.shade != Shade::none)
        drawing.background = shaded(scene, camera, options.shade, style);
    else if (options.fill || style.look == Look::dark)
        drawing.regions.push_back(silhouette_region(scene, camera, {.colour = style.shape}));
    if (style.look == Look::toon)
        drawing.regions.push_back(toon_region(scene, camera, ShadeOptions().toon_limit, {}, {.colour = vec3(0)}));
}
