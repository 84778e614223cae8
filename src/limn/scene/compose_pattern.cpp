#include "limn/scene/compose_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include "limn/base/error.h"
#include "limn/pattern/filament.h"
#include "limn/pattern/pixel_samples.h"
#include "limn/raycast/environment.h"
#include "limn/scene/pattern_light.h"

namespace limn {
namespace {

using namespace formulas;

constexpr float environment_strength = 3.4f; ///< irradiance on the side that gets most

dmat3 turn_of(const PatternOptions& options)
{
    const glm::dvec4 q = glm::normalize(options.turn);
    return glm::mat3_cast(glm::dquat(q.w, q.x, q.y, q.z));
}

dmat4 transform_of(const PatternPlace& place, const PatternOptions& options, std::optional<std::size_t> part)
{
    return options.with_object && part && *part < place.transforms.size() ? place.transforms[*part] : dmat4(1);
}

double scale_of(const dmat4& transform) { return glm::length(dvec3(transform[0])); }

/// Calls f(position) for the corners of the faces of a part, or of all.
template <class F> void each_corner(const SeenScene& scene, std::optional<std::size_t> part, F&& f)
{
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        const RayTriangles& t = scene.objects[o].triangles;
        for (std::size_t i = 0; i < t.triangles.size(); ++i)
            if (!part || scene.part_of(std::uint32_t(o), std::uint32_t(i)) == *part)
                for (int k = 0; k < 3; ++k)
                    f(t.positions[t.triangles[i][k]]);
    }
}

/// Their box.
std::pair<vec3, vec3> box_of(const SeenScene& scene, std::optional<std::size_t> part)
{
    vec3 low(std::numeric_limits<float>::infinity()), high = -low;
    each_corner(scene, part, [&](const vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    });
    return {low, high};
}

/// A light without what surrounds it.
PatternLight lone_light(const vec3& to_light, const vec3& strength, float radius, const vec3& up)
{
    PatternLight light;
    light.lighting = {to_light, strength, radius, up, vec3(0), vec3(0)};
    return light;
}

/// Far lights in place of an environment, all equally strong in luminance: as many as a pixel may look at. Their sizes fill its light.
std::vector<PatternLight> environment_lights(const EnvironmentMap& map, const dvec3& up, int count)
{
    const glm::mat3 to_world = glm::transpose(environment_axes(vec3(up)));
    std::vector<PatternLight> lights;
    for (const vec2& place : even_samples(count, KERNEL_BOX, 1, vec2(0.5f))) {
        const EnvironmentMap::Drawn drawn = map.draw(place + 0.5f);
        if (!(drawn.density > 0))
            continue;
        const float angle = 1 / (drawn.density * float(count)); // solid, of what it stands for
        const vec3 strength = drawn.light * (environment_strength * angle / map.most_received());
        lights.push_back(lone_light(glm::normalize(to_world * drawn.direction), strength,
                                    std::min(1.0f, std::sqrt(angle / std::numbers::pi_v<float>)), vec3(up)));
    }
    return lights;
}

PatternLight turned(const PatternLight& light, const PatternFrame& frame)
{
    PatternLight result = light;
    result.lighting.to_light = frame.direction(light.lighting.to_light);
    result.lighting.up = frame.direction(light.lighting.up);
    if (light.place) {
        result.place = frame.point(*light.place);
        result.intensity = light.intensity * frame.scale * frame.scale;
    }
    return result;
}

/// A frame that turns with the pattern; lengths are multiplied by `factor` (of the world's), and `origin` (world) becomes 0.
PatternFrame frame_of(const SeenScene& scene, const dmat3& axes, double factor, const dvec3& origin)
{
    const dmat3 turn = glm::transpose(axes);
    return {glm::mat3(turn), float(factor * scene.scale), vec3(factor * (turn * (scene.centre - origin)))};
}

BrickShader bricks_of(const PatternOptions& o)
{
    const vec3 size = vec3(dvec3(o.brick_width, o.brick_height, o.brick_depth)), cell = size + float(o.mortar);
    return {{cell, float(o.mortar), o.brick_solid ? 3 : 2, float(o.brick_relief) / cell, linear_colour(o.brick_colour),
             linear_colour(o.mortar_colour), float(3 * o.variety), o.brick_bond ? 1 : 0},
            {FINISH_MATTE, vec3(1), 0, 1, 1, 1, 0},
            {}};
}

ThreadShader thread_of(const PatternOptions& o)
{
    // Whole cells go around, so that there is no seam; an even number of them where threads take turns.
    const double wanted = 1 / (o.hole + o.thread), step = o.woven ? 2 : 1, around = std::max(step, step * std::round(wanted / step));
    const float hole = float(o.hole * wanted / around), thread = float(o.thread * wanted / around);
    return {{hole, thread, linear_colour(o.thread_colour), float(o.thread_specular), float(o.thread_exponent), o.mirror_cone ? -1.0f : 1.0f,
             1, o.woven ? 1 : 0},
            {},
            vec3(0),
            1};
}

/// Axes whose y is a direction.
dmat3 axes_with_y(const dvec3& y)
{
    const dvec3 aside = std::abs(y.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 0, 1), z = glm::normalize(glm::cross(aside, y));
    return dmat3(glm::cross(y, z), y, z);
}

LayerShader layers_of(const SeenScene& scene, const PatternOptions& options, const PatternPlace& place, std::optional<std::size_t> part)
{
    const PrintStack print = print_stack(scene, options, place, part);
    const double mm = mm_in_frame(scene, place) / scale_of(transform_of(place, options, part));
    const int models[] = {LAYERS_BEAD, LAYERS_SLOPE, LAYERS_SEED, LAYERS_SOFT, LAYERS_VOXEL};
    const LayerPattern pattern = {models[int(options.layer_model)],
                                  vec3(print.up),
                                  float(options.soft_low / mm),
                                  float(options.soft_high / mm),
                                  float(options.bulge),
                                  float(options.variety),
                                  vec3(axes_with_y(print.up)[0]),
                                  float(options.layer_height / mm)};
    return {pattern, print_finish(options), {}, print.stack};
}

struct Unlit {
    PatternShader shader;
    PatternFrame frame;
};

Unlit unlit(const SeenScene& scene, const PatternOptions& options, const PatternPlace& place, std::optional<std::size_t> part)
{
    if (options.kind == PatternKind::layers)
        return {layers_of(scene, options, place, part), {}};
    const dmat4 transform = transform_of(place, options, part);
    const dmat3 axes = dmat3(transform) / scale_of(transform) * turn_of(options);
    if (options.kind == PatternKind::bricks)
        return {bricks_of(options), frame_of(scene, axes, 1 / (longest_side(scene) * scale_of(transform)), dvec3(transform[3]))};
    const auto [low, high] = box_of(scene, part);
    return {thread_of(options),
            frame_of(scene, axes * axes_with_y(place.up), 1 / scene.scale, scene.centre + scene.scale * dvec3(0.5f * (low + high)))};
}

PaintedPattern painted(const SeenScene& scene, const PatternOptions& options, const PatternPlace& place,
                       const std::vector<PatternLight>& lights, std::optional<std::size_t> part)
{
    const Unlit pattern = unlit(scene, options, place, part);
    PaintedPattern result = {{}, pattern.frame};
    for (const PatternLight& light : lights) {
        result.lit.push_back(pattern.shader);
        std::visit([&](auto& shader) { shader.light = turned(light, pattern.frame); }, result.lit.back());
    }
    return result;
}

std::vector<vec2> pattern_samples(const PatternOptions& options)
{
    if (options.filter == PatternFilter::seed)
        return seed_samples(options.pattern_samples, float(options.filter_box), std::uint32_t(options.sample_seed));
    if (options.filter == PatternFilter::even)
        return even_samples(options.pattern_samples, KERNEL_GAUSS, float(options.filter_width), vec2(0.5f));
    return {};
}

} // namespace

double longest_side(const SeenScene& scene)
{
    const auto [low, high] = box_of(scene, std::nullopt);
    const vec3 size = high - low;
    return double(std::max({size.x, size.y, size.z})) * scene.scale;
}

std::optional<double> mm_per_unit(char units, std::string_view format)
{
    switch (units) {
    case 'm': return 1;
    case 'c': return 10;
    case 'M': return 1000;
    case 'i': return 25.4;
    default: break;
    }
    if (format == "stl" || format == "3mf")
        return 1;
    if (format == "gltf" || format == "glb")
        return 1000;
    return std::nullopt;
}

double mm_in_frame(const SeenScene& scene, const PatternPlace& place)
{
    return scene.scale * (place.mm_per_unit > 0 ? place.mm_per_unit : 100 / longest_side(scene));
}

double thickest_layer(const PatternOptions& options)
{
    if (!options.layer_heights.empty())
        return *std::max_element(options.layer_heights.begin(), options.layer_heights.end());
    return options.layer_height;
}

PrintStack print_stack(const SeenScene& scene, const PatternOptions& options, const PatternPlace& place, std::optional<std::size_t> part)
{
    const dmat4 transform = transform_of(place, options, part);
    const dvec3 up = glm::normalize(dmat3(transform) * (turn_of(options) * options.direction.value_or(place.up)));
    float low = std::numeric_limits<float>::infinity(), high = -low;
    each_corner(scene, part, [&, g = vec3(up)](const vec3& p) {
        low = std::min(low, glm::dot(p, g));
        high = std::max(high, glm::dot(p, g));
    });
    const double mm = mm_in_frame(scene, place) / scale_of(transform);
    if (const double height = double(high - low) * mm, layer = thickest_layer(options); layer > height)
        throw Error::Input(fmt::format(
            "--layer-height: a layer of {:.4g} mm is higher than the print, which is {:.4g} mm along its direction", layer, height));
    const LayerStack stack =
        options.layer_heights.empty() ? LayerStack(options.layer_height, 0, options.first_layer) : LayerStack(options.layer_heights, 0);
    return {up, stack.scaled(1 / mm, double(low))};
}

std::vector<PatternLight> pattern_lights(const SeenScene& scene, const Camera& camera, const ShadeOptions& shade, const PatternPlace& place)
{
    if (shade.wide && std::holds_alternative<EnvironmentLight>(*shade.wide))
        return environment_lights(*std::get<EnvironmentLight>(*shade.wide).map, place.up, shade.light_samples);
    return {pattern_light(scene.centre, scene.scale, camera, shade, place.up)};
}

PatternPaint compose_pattern(const SeenScene& scene, const PatternOptions& options, const PatternPlace& place, const ShadeOptions& shade,
                             const std::vector<PatternLight>& lights)
{
    check(shade, scene.part_count());
    PatternPaint paint;
    const std::size_t parts = options.with_object ? scene.part_count() : 1;
    for (std::size_t part = 0; part < parts; ++part)
        paint.patterns.push_back(painted(scene, options, place, lights, options.with_object ? std::optional(part) : std::nullopt));
    paint.kernel = options.filter == PatternFilter::off ? KERNEL_NONE : options.filter == PatternFilter::box ? KERNEL_BOX : KERNEL_GAUSS;
    paint.width = paint.kernel == KERNEL_BOX ? float(options.filter_box) : float(options.filter_width);
    paint.samples = pattern_samples(options);
    const bool is_print = options.kind == PatternKind::layers;
    paint.see_through = options.kind == PatternKind::thread;
    paint.flat = shade.shading == Shading::flat;
    if (is_print && options.overhang > 0)
        paint.overhang = float(std::sin(glm::radians(options.overhang)));
    paint.cusps = is_print && options.show == PrintShow::cusp;
    paint.mm_per_length = float(mm_in_frame(scene, place));
    paint.layer_mm = float(thickest_layer(options));
    paint.background = linear_colour(shade.background);
    paint.edge_samples = shade.samples;
    if (shade.ground) {
        const GroundPlane plane(*shade.ground, scene.centre, scene.scale);
        vec3 to_light(0);
        for (const PatternLight& light : lights)
            to_light += luminance(light.lighting.light) * (light.place ? glm::normalize(*light.place) : light.lighting.to_light);
        paint.ground.emplace(plane, GroundShadow(scene, plane, glm::length(to_light) > 0 ? glm::normalize(to_light) : plane.up()),
                             linear_colour(shade.ground->material.colour));
    }
    return paint;
}

} // namespace limn
