#include "limn/scene/pattern_picture.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/pattern/antialias.h"
#include "limn/pattern/filament.h"
#include "limn/raycast/occlusion.h"
#include "limn/scene/ground_shadow.h"
#include "limn/scene/pattern_light.h"

namespace limn {
namespace {

using namespace formulas;

constexpr int most_sides = 12;           ///< that are seen through holes, one behind the other

/// One pattern with all of its numbers, in a frame.
struct Painted {
    std::variant<LayerShader, BrickShader, ThreadShader> shader;
    PatternFrame frame;
    PatternCamera camera;
};

dmat3 turn_of(const PatternOptions& options)
{
    const glm::dvec4 q = glm::normalize(options.turn);
    return glm::mat3_cast(glm::dquat(q.w, q.x, q.y, q.z));
}

dmat4 transform_of(const PatternPlace& place, const PatternOptions& options, std::size_t part)
{
    return options.with_object && part < place.transforms.size() ? place.transforms[part] : dmat4(1);
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

/// The direction in which layers follow each other, in the world.
dvec3 print_direction(const PatternOptions& options, const PatternPlace& place, const dmat4& transform)
{
    return glm::normalize(dmat3(transform) * (turn_of(options) * options.direction.value_or(place.up)));
}

/// Millimetres of a length 1 in the frame of the scene.
double mm_in_frame(const SeenScene& scene, const PatternPlace& place)
{
    return scene.scale * (place.mm_per_unit > 0 ? place.mm_per_unit : 100 / longest_side(scene));
}

double thickest(const PatternOptions& options)
{
    if (!options.layer_heights.empty())
        return *std::max_element(options.layer_heights.begin(), options.layer_heights.end());
    return options.layer_height;
}

/// The layers of a print in the frame of the scene.
LayerStack stack_of(const SeenScene& scene, const PatternOptions& options, const PatternPlace& place, const dvec3& up, const dmat4& transform, std::optional<std::size_t> part)
{
    float low = std::numeric_limits<float>::infinity(), high = -low;
    each_corner(scene, part, [&, g = vec3(up)](const vec3& p) {
        low = std::min(low, glm::dot(p, g));
        high = std::max(high, glm::dot(p, g));
    });
    const double mm = mm_in_frame(scene, place) / scale_of(transform);
    if (const double height = double(high - low) * mm, layer = thickest(options); layer > height)
        throw Error::Input(fmt::format("--layer-height: a layer of {:.4g} mm is higher than the print, which is {:.4g} mm along its direction", layer, height));
    const LayerStack stack = options.layer_heights.empty() ? LayerStack(options.layer_height, 0, options.first_layer) : LayerStack(options.layer_heights, 0);
    return stack.scaled(1 / mm, double(low));
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
    return {{cell, float(o.mortar), o.brick_solid ? 3 : 2, float(o.brick_relief) / cell, linear_colour(o.brick_colour), linear_colour(o.mortar_colour), float(3 * o.variety)},
            {FINISH_MATTE, vec3(1), 0, 1, 1, 1, 0},
            {}};
}

ThreadShader thread_of(const PatternOptions& o)
{
    // Whole cells go around, so that there is no seam; an even number of them where threads take turns.
    const double wanted = 1 / (o.hole + o.thread), step = o.woven ? 2 : 1, around = std::max(step, step * std::round(wanted / step));
    const float hole = float(o.hole * wanted / around), thread = float(o.thread * wanted / around);
    return {{hole, thread, linear_colour(o.thread_colour), float(o.thread_specular), float(o.thread_exponent), o.mirror_cone ? -1.0f : 1.0f, 1, o.woven ? 1 : 0}, {}, vec3(0), 1};
}

/// Axes whose y is a direction.
dmat3 axes_with_y(const dvec3& y)
{
    const dvec3 aside = std::abs(y.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 0, 1), z = glm::normalize(glm::cross(aside, y));
    return dmat3(glm::cross(y, z), y, z);
}

Painted painted(const SeenScene& scene, const Camera& camera, const PatternOptions& options, const PatternPlace& place, const PatternLight& light, std::optional<std::size_t> part)
{
    const dmat4 transform = part ? transform_of(place, options, *part) : dmat4(1);
    const dmat3 axes = dmat3(transform) / scale_of(transform) * turn_of(options);
    if (options.kind == PatternKind::layers) {
        const dvec3 up = print_direction(options, place, transform);
        const int models[] = {LAYERS_BEAD, LAYERS_SLOPE, LAYERS_SEED, LAYERS_SOFT};
        const double mm = mm_in_frame(scene, place) / scale_of(transform);
        const LayerPattern pattern = {models[int(options.layer_model)], vec3(up), float(options.soft_low / mm), float(options.soft_high / mm), float(options.bulge), float(options.variety)};
        const PatternFrame frame;
        return {LayerShader{pattern, print_finish(options), light, stack_of(scene, options, place, up, transform, part)}, frame, PatternCamera(camera, scene.centre, scene.scale, frame)};
    }
    if (options.kind == PatternKind::bricks) {
        const PatternFrame frame = frame_of(scene, axes, 1 / (longest_side(scene) * scale_of(transform)), dvec3(transform[3]));
        BrickShader shader = bricks_of(options);
        shader.light = turned(light, frame);
        return {shader, frame, PatternCamera(camera, scene.centre, scene.scale, frame)};
    }
    vec3 low(std::numeric_limits<float>::infinity()), high = -low;
    each_corner(scene, part, [&](const vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    });
    const PatternFrame frame = frame_of(scene, axes * axes_with_y(place.up), 1 / scene.scale, scene.centre + scene.scale * dvec3(0.5f * (low + high)));
    ThreadShader shader = thread_of(options);
    shader.light = turned(light, frame);
    return {shader, frame, PatternCamera(camera, scene.centre, scene.scale, frame)};
}

struct Painter {
    const SeenScene& scene;
    const PatternOptions& options;
    const ShadeOptions& shade;
    std::vector<Painted> patterns; ///< one for all, or one for each part
    FragmentTracer tracer;
    std::optional<GroundPlane> plane;
    std::optional<GroundShadow> shadow;
    dvec3 up;
    double layer_mm;        ///< of the thickest layer
    double mm_per_length;   ///< in the frame of the scene
    std::vector<vec2> samples; ///< of the pattern in a pixel; empty: it is filtered
    PatternLight light;        ///< in the frame of the scene
    std::vector<vec2> places;  ///< of the light, in a unit square around its middle

    const Painted& pattern_of(const Fragment& fragment) const { return patterns.size() == 1 ? patterns[0] : patterns[scene.part_of(fragment.object, fragment.triangle)]; }

    /// How much of the light nothing hides, by `count` of its places.
    float unhidden(const PatternSpot& spot, const vec2& pixel, std::size_t count) const
    {
        if (!shade.occlusion)
            return 1;
        constexpr float off_surface = 1e-3f; // in the frame of the scene, whose objects are about 1 in radius
        return light_share(*shade.occlusion, light, {places.data(), count}, spot.position + off_surface * spot.face_normal, pixel);
    }
    /// @param light_places  to look at, of those of the light
    vec4 through(const Painted& painted, const PatternSpot& spot, const vec2& pixel, std::size_t light_places) const
    {
        const PatternSpot in_frame = {painted.frame.point(spot.position), painted.frame.direction(spot.normal), painted.frame.direction(spot.face_normal), painted.frame.direction(spot.to_eye)};
        const int kernel = options.filter == PatternFilter::off ? KERNEL_NONE : options.filter == PatternFilter::box ? KERNEL_BOX : KERNEL_GAUSS;
        const float width = kernel == KERNEL_BOX ? float(options.filter_box) : float(options.filter_width);
        const float share = unhidden(spot, pixel, light_places);
        const auto shaded = [&](const auto& shader) {
            return samples.empty() ? shader.at(painted.camera.point(in_frame), kernel, width, share) : supersample(shader, painted.camera, in_frame, pixel, samples, share);
        };
        const vec4 colour = std::visit(shaded, painted.shader);
        return vec4(shown(vec3(colour)), colour.w);
    }
    /// The colour of a height map of cusps, lit a little.
    vec3 cusp(const Painted& painted, const PatternSpot& spot) const
    {
        const LayerShader& layers = std::get<LayerShader>(painted.shader);
        const float height = layers.stack.place(glm::dot(spot.position, layers.pattern.up), vec2(0), 1).height * float(mm_per_length);
        const vec3 colour = cusp_colour(cusp_height(height, glm::dot(spot.face_normal, layers.pattern.up)) / float(layer_mm));
        return linear_colour(colour) * (0.55f + 0.45f * glm::max(glm::dot(spot.normal, spot.to_eye), 0.0f));
    }
    /// Whether a face hangs over so far that it needs support.
    bool hangs_over(const Painted& painted, const Fragment& fragment) const
    {
        if (options.overhang <= 0 || options.kind != PatternKind::layers)
            return false;
        const float down = -glm::dot(fragment.face_normal, std::get<LayerShader>(painted.shader).pattern.up);
        return down > std::sin(glm::radians(float(options.overhang)));
    }
    vec3 backdrop(const dvec2& pixel) const
    {
        const vec3 background = linear_colour(shade.background);
        if (!plane)
            return background;
        const GroundPlane::Point ground = plane->meet(tracer.sight(pixel));
        if (!(ground.cover > 0))
            return background;
        const float lit = shadow ? shadow->light(ground.position) : 1;
        return glm::mix(background, linear_colour(shade.ground->material.colour) * lit, ground.cover);
    }
    /// Linear, of a place of the picture.
    vec3 at(const dvec2& pixel, const Fragment& first, std::size_t light_places) const
    {
        vec3 sum(0);
        float clear = 1;
        Fragment fragment = first;
        for (int side = 0; fragment.hit() && side < most_sides && clear > 1e-3f; ++side) {
            const Painted& painted = pattern_of(fragment);
            const vec3 face = seen_normal(fragment.face_normal, fragment.to_eye);
            vec3 normal = shade.shading == Shading::flat ? face : fragment.normal;
            if (glm::dot(normal, face) < 0)
                normal = -normal;
            const PatternSpot spot = {fragment.position, normal, face, fragment.to_eye};
            vec4 colour = options.show == PrintShow::cusp && options.kind == PatternKind::layers ? vec4(cusp(painted, spot), 1) : through(painted, spot, vec2(pixel), light_places);
            if (hangs_over(painted, fragment))
                colour = vec4(glm::mix(vec3(colour), vec3(0.75f, 0.04f, 0.03f), 0.6f), colour.w);
            sum += clear * vec3(colour);
            clear *= 1 - colour.w;
            if (options.kind != PatternKind::thread)
                break;
            fragment = tracer.behind(pixel, fragment);
        }
        return clear > 1e-3f ? sum + clear * backdrop(pixel) : sum;
    }
};

/// What tells edges of the picture: not of the pattern, which is filtered.
struct Place {
    vec3 position = vec3(0), normal = vec3(0);
    float pixel = 0; ///< size of one there
    bool hit = false;
};

bool is_edge(const Place& a, const Place& b)
{
    if (a.hit != b.hit)
        return true;
    if (!a.hit)
        return false;
    const float off = std::min(std::abs(glm::dot(b.position - a.position, a.normal)), std::abs(glm::dot(b.position - a.position, b.normal)));
    return glm::dot(a.normal, b.normal) < 0.85f || off > 3 * std::max(a.pixel, b.pixel);
}

bool is_on_edge(const std::vector<Place>& places, const ivec2& size, int x, int y)
{
    const auto at = [&](int px, int py) -> const Place& { return places[std::size_t(py) * std::size_t(size.x) + std::size_t(px)]; };
    for (int ny = std::max(0, y - 1); ny <= std::min(size.y - 1, y + 1); ++ny)
        for (int nx = std::max(0, x - 1); nx <= std::min(size.x - 1, x + 1); ++nx)
            if (is_edge(at(x, y), at(nx, ny)))
                return true;
    return false;
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
    vec3 low(std::numeric_limits<float>::infinity()), high = -low;
    each_corner(scene, std::nullopt, [&](const vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    });
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

Image paint_pattern(const SeenScene& scene, const Camera& camera, const PatternOptions& options, const PatternPlace& place, const ShadeOptions& shade)
{
    check(shade, scene.part_count());
    const PatternLight light = pattern_light(scene.centre, scene.scale, camera, shade, place.up);
    std::vector<Painted> patterns;
    if (options.with_object)
        for (std::size_t part = 0; part < scene.part_count(); ++part)
            patterns.push_back(painted(scene, camera, options, place, light, part));
    else
        patterns.push_back(painted(scene, camera, options, place, light, std::nullopt));
    Painter painter = {scene, options, shade, std::move(patterns), FragmentTracer(scene, camera), {}, {}, place.up, thickest(options), mm_in_frame(scene, place), pattern_samples(options), light, even_samples(shade.light_samples, KERNEL_BOX, 1, vec2(0))};
    if (shade.ground) {
        painter.plane.emplace(*shade.ground, scene.centre, scene.scale);
        painter.shadow.emplace(scene, *painter.plane, light.place ? glm::normalize(*light.place) : light.lighting.to_light);
    }
    Image image(camera.size, 3);
    const ivec2 size = camera.size;
    std::vector<Place> places(std::size_t(size.x) * std::size_t(size.y));
    const auto store = [&](int x, int y, const vec3& linear) {
        const vec3 c = encoded_colour(glm::max(linear, vec3(0)));
        for (int k = 0; k < 3; ++k)
            image.at(x, y)[k] = c[k];
    };
    parallel_each(std::size_t(size.y), 2, [&](std::size_t row) {
        for (int x = 0; x < size.x; ++x) {
            const dvec2 pixel = {x + 0.5, double(row) + 0.5};
            const Fragment fragment = painter.tracer.at(pixel);
            if (fragment.hit())
                places[row * std::size_t(size.x) + std::size_t(x)] = {fragment.position, seen_normal(fragment.face_normal, fragment.to_eye),
                                                                      float(1 / (camera.pixels_per_unit(double(fragment.depth)) * scene.scale)), true};
            store(x, int(row), painter.at(pixel, fragment, painter.places.size()));
        }
    });
    const std::vector<dvec2> rays = sample_pattern(shade.samples);
    const std::size_t few = (painter.places.size() - 1) / rays.size() + 1; // places of the light for each
    parallel_each(std::size_t(size.y), 1, [&](std::size_t row) {
        for (int x = 0; x < size.x; ++x) {
            if (!is_on_edge(places, size, x, int(row)))
                continue;
            vec3 sum(0);
            for (const dvec2& offset : rays) {
                const dvec2 pixel = {x + offset.x, double(row) + offset.y};
                sum += painter.at(pixel, painter.tracer.at(pixel), few);
            }
            store(x, int(row), sum / float(rays.size()));
        }
    });
    return image;
}

CuspHistogram print_cusps(const SeenScene& scene, const PatternOptions& options, const PatternPlace& place)
{
    std::vector<float> heights, areas;
    const double mm = mm_in_frame(scene, place);
    std::vector<std::pair<dvec3, LayerStack>> stacks;
    const std::size_t parts = options.with_object ? scene.part_count() : 1;
    for (std::size_t part = 0; part < parts; ++part) {
        const dmat4 transform = transform_of(place, options, part);
        const dvec3 up = print_direction(options, place, transform);
        stacks.emplace_back(up, stack_of(scene, options, place, up, transform, options.with_object ? std::optional(part) : std::nullopt));
    }
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        const RayTriangles& t = scene.objects[o].triangles;
        for (std::size_t i = 0; i < t.triangles.size(); ++i) {
            const auto& [up, stack] = stacks[options.with_object ? scene.part_of(std::uint32_t(o), std::uint32_t(i)) : 0];
            const vec3 a = t.positions[t.triangles[i].x], b = t.positions[t.triangles[i].y], c = t.positions[t.triangles[i].z], n = glm::cross(b - a, c - a);
            const float size = glm::length(n);
            if (!(size > 0))
                continue;
            const float height = stack.place(glm::dot((a + b + c) / 3.0f, vec3(up)), vec2(0), 1).height * float(mm);
            heights.push_back(cusp_height(height, glm::dot(n, vec3(up)) / size));
            areas.push_back(size);
        }
    }
    return cusp_histogram(heights, areas, thickest(options), 20);
}

} // namespace limn
