#include "limn/lines/image_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limn/base/parallel.h"
#include "limn/formulas/formulas.h"

// The shared texts need the dialect's words once more, inside of a struct.
#define FORMULA inline

namespace limn {
namespace formulas {

/// The fields of a picture as the formulas ask for them.
struct PictureFields {
    const LineFields* fields;

    std::size_t at(const ivec2 p) const
    {
        const ivec2 q = clamp(p, ivec2(0), fields->size - 1);
        return std::size_t(q.y) * std::size_t(fields->size.x) + std::size_t(q.x);
    }
    float pixel(const ivec2 p) const { return fields->intensity[at(p)]; }
    float window_depth(const ivec2 p) const { return fields->window_depth[at(p)]; }
    float nearness(const ivec2 p) const { return fields->nearness[at(p)]; }
    vec3 normal_at(const ivec2 p) const { return vec3(fields->normals[at(p)]); }
    uint id_at(const ivec2 p) const { return fields->ids[at(p)]; }
#include "limn/formulas/image_lines.glsl"
#include "limn/formulas/valley.glsl"
};

} // namespace formulas

namespace {

using O = ImageLineOptions;

bool is_line(formulas::PictureFields fields, const ivec2& p, const ImageLineOptions& o, float least_cosine)
{
    const float relative = fields.fields->orthographic ? 0.0f : 1.0f;
    const auto radius = [&] { return o.radius_scale > 0 ? fields.radius_at(p, o.radius_scale * fields.fields->pixels_per_radius, relative) : o.radius; };
    switch (o.method) {
    case ImageMethod::threshold: return fields.is_dark(p, o.dark);
    case ImageMethod::depth_raw: return fields.is_depth_edge_raw(p, o.sobel);
    case ImageMethod::depth: return fields.is_depth_edge(p, o.step, least_cosine, relative);
    case ImageMethod::valley_printed: return fields.is_valley_as_printed(p, radius());
    case ImageMethod::valley: return fields.is_valley(p, radius(), o.darker, o.contrast);
    case ImageMethod::off: return false;
    }
    return false;
}

} // namespace

LineFields line_fields(const GBuffer& seen, const Camera& camera, const SeenScene& scene, double radius)
{
    LineFields fields = {seen.size, camera.orthographic, float(radius * camera.pixels_per_unit(1)), {}, {}, {}, {}, {}};
    const std::size_t count = seen.depths.size();
    float nearest = HUGE_VALF, farthest = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (seen.triangles[i] != none) {
            nearest = std::min(nearest, seen.depths[i]);
            farthest = std::max(farthest, seen.depths[i]);
        }
    const double middle = glm::dot(scene.centre - camera.eye, camera.forward());
    const double near = 0.95 * double(nearest), far = 1.05 * double(farthest);
    fields.intensity.assign(count, 1);
    fields.window_depth.assign(count, 1);
    fields.nearness.assign(count, 0);
    fields.normals.assign(count, vec4(0));
    fields.ids.assign(count, 0);
    parallel_each(count, 4096, [&](std::size_t i) {
        if (seen.triangles[i] == none)
            return;
        const dvec3 p = scene.centre + scene.scale * dvec3(seen.positions[i]);
        const double depth = double(seen.depths[i]);
        fields.intensity[i] = std::abs(glm::dot(seen.normals[i], vec3(glm::normalize(camera.to_eye(p)))));
        fields.window_depth[i] = float(camera.orthographic ? (depth - near) / (far - near) : far / (far - near) * (1 - near / depth));
        // Of an orthographic view: between 1 and 3 for what lies in the sphere around the scene.
        fields.nearness[i] = float(camera.orthographic ? 2 - (depth - middle) / radius : 1 / depth);
        fields.normals[i] = vec4(seen.normals[i], 0);
        fields.ids[i] = scene.part_of(seen.objects[i], seen.triangles[i]) + 1;
    });
    return fields;
}

void check(const ImageLineOptions& options)
{
    for (const auto& row : image_line_option_table()) {
        ImageLineOptions copy;
        row.set(copy, row.get(options));
    }
}

Image find_image_lines(const LineFields& fields, const ImageLineOptions& options)
{
    check(options);
    const float least_cosine = std::cos(options.fold_degrees * std::numbers::pi_v<float> / 180);
    Image lines(fields.size, 1);
    parallel_each(std::size_t(fields.size.y), 4, [&](std::size_t y) {
        for (int x = 0; x < fields.size.x; ++x)
            *lines.at(x, int(y)) = is_line({&fields}, {x, int(y)}, options, least_cosine) ? 1.0f : 0.0f;
    });
    return lines;
}

const OptionTable<ImageLineOptions>& image_line_option_table()
{
    static const OptionTable<ImageLineOptions> table = {
        choice_row<O, ImageMethod>("image-lines",
                                   {{"none", ImageMethod::off}, {"threshold", ImageMethod::threshold}, {"depth-raw", ImageMethod::depth_raw}, {"depth", ImageMethod::depth},
                                    {"valley-printed", ImageMethod::valley_printed}, {"valley", ImageMethod::valley}},
                                   "lines found per pixel, under those of --lines", &O::method),
        number_row("dark-limit", "", 0, 1, "threshold: intensity below which a pixel is a line", &O::dark),
        number_row("sobel-limit", "", 0, 1e9, "depth-raw: response above which a pixel is a line", &O::sobel),
        number_row("step-limit", "", 0, 1e9, "depth: step as a part of the depth", &O::step),
        number_row("fold-limit", "degrees", 0, 180, "depth: turn of the normal from pixel to pixel", &O::fold_degrees),
        number_row("valley-radius", "px", 1, 64, "valleys: radius of the window", &O::radius),
        number_row("valley-scale", "", 0, 1, "valleys: radius as a part of the model's, so that it follows the distance; 0: --valley-radius", &O::radius_scale),
        number_row("valley-darker", "", 0, 1, "valley: largest part of the window that is darker", &O::darker),
        number_row("valley-contrast", "", 0, 1, "valley: how much brighter something in the window is", &O::contrast),
    };
    return table;
}

} // namespace limn
