#include "limn/scene/pattern_picture.h"

#include <algorithm>
#include <cmath>

#include "limn/base/parallel.h"
#include "limn/pattern/antialias.h"
#include "limn/pattern/filament.h"
#include "limn/raycast/lighting.h"
#include "limn/raycast/occlusion.h"
#include "limn/scene/pattern_light.h"

namespace limn {
namespace {

using namespace formulas;

constexpr int most_sides = 12;       ///< that are seen through holes, one behind the other
constexpr float off_surface = 1e-3f; ///< where lines to light begin: in the frame of the scene, whose objects are about 1 in radius

/// How many places of the light a pixel looks at, and which samples of openness it takes.
struct LightSamples {
    std::size_t places;
    PixelSequence sequence;
    SampleRange open;
};

struct Painter {
    const SeenScene& scene;
    const PatternPaint& paint;
    const ShadeOptions& shade;
    std::vector<PatternLight> lights; ///< in the frame of the scene
    FragmentTracer tracer;
    Lighting lighting;                  ///< for openness
    std::vector<PatternCamera> cameras; ///< of the patterns
    std::vector<vec2> places;           ///< of the light, in a unit square around its middle

    std::size_t pattern_of(const Fragment& fragment) const
    {
        return paint.patterns.size() == 1 ? 0 : scene.part_of(fragment.object, fragment.triangle);
    }

    /// How much of a light nothing hides, by `count` of its places.
    float unhidden(const PatternLight& light, const PatternSpot& spot, const vec2& pixel, std::size_t count) const
    {
        if (!shade.occlusion)
            return 1;
        return light_share(*shade.occlusion, light, {places.data(), count}, spot.position + off_surface * spot.face_normal, pixel);
    }
    /// Radiance, premultiplied, and opacity, by one of the lights.
    vec4 lit(const PatternShader& shader, const PatternCamera& camera, const PatternSpot& in_frame, const vec2& pixel, float share) const
    {
        const auto shaded = [&](const auto& s) {
            return paint.samples.empty() ? s.at(camera.point(in_frame), paint.kernel, paint.width, share)
                                         : supersample(s, camera, in_frame, pixel, paint.samples, share);
        };
        return std::visit(shaded, shader);
    }
    /// The same as shown, by all of them.
    vec4 through(std::size_t pattern, const PatternSpot& spot, const vec2& pixel, const LightSamples& samples) const
    {
        const PaintedPattern& painted = paint.patterns[pattern];
        const PatternSpot in_frame = {painted.frame.point(spot.position), painted.frame.direction(spot.normal),
                                      painted.frame.direction(spot.face_normal), painted.frame.direction(spot.to_eye)};
        const std::size_t each = (samples.places - 1) / lights.size() + 1;
        vec4 colour(0);
        for (std::size_t k = 0; k < lights.size(); ++k) {
            const vec4 one = lit(painted.lit[k], cameras[pattern], in_frame, pixel, unhidden(lights[k], spot, pixel, each));
            colour = vec4(vec3(colour) + vec3(one), one.w);
        }
        return vec4(closed_in(shown_light(vec3(colour)), spot, samples), colour.w);
    }
    /// Darkened where a place is not open.
    vec3 closed_in(const vec3& linear, const PatternSpot& spot, const LightSamples& samples) const
    {
        if (!shade.open_radius)
            return linear;
        const LitPlace at = {spot.position + off_surface * spot.face_normal, spot.normal, spot.to_eye, Tones(vec3(0), vec3(1))};
        return linear_colour(lighting.closed_in(encoded_colour(linear), at, samples.sequence, samples.open));
    }
    /// The colour of a height map of cusps, lit a little.
    vec3 cusp(std::size_t pattern, const PatternSpot& spot) const
    {
        const LayerShader& layers = std::get<LayerShader>(paint.patterns[pattern].lit.front());
        const float height = layers.stack.place(glm::dot(spot.position, layers.pattern.up), vec2(0), 1).height * paint.mm_per_length;
        const vec3 colour = cusp_colour(cusp_height(height, glm::dot(spot.face_normal, layers.pattern.up)) / paint.layer_mm);
        return linear_colour(colour) * cusp_light(spot.normal, spot.to_eye);
    }
    /// Whether a face hangs over so far that it needs support.
    bool hangs_over(std::size_t pattern, const Fragment& fragment) const
    {
        return paint.overhang <= 1 &&
               -glm::dot(fragment.face_normal, std::get<LayerShader>(paint.patterns[pattern].lit.front()).pattern.up) > paint.overhang;
    }
    vec3 backdrop(const dvec2& pixel) const
    {
        if (!paint.ground)
            return paint.background;
        const GroundPlane::Point ground = paint.ground->plane.meet(tracer.sight(pixel));
        if (!(ground.cover > 0))
            return paint.background;
        return glm::mix(paint.background, paint.ground->colour * paint.ground->shadow.light(ground.position), ground.cover);
    }
    /// Linear, of a place of the picture.
    vec3 at(const dvec2& pixel, const Fragment& first, const LightSamples& samples) const
    {
        vec3 sum(0);
        float clear = 1;
        Fragment fragment = first;
        for (int side = 0; fragment.hit() && side < most_sides && clear > 1e-3f; ++side) {
            const std::size_t pattern = pattern_of(fragment);
            const vec3 face = seen_normal(fragment.face_normal, fragment.to_eye);
            vec3 normal = paint.flat ? face : fragment.normal;
            if (glm::dot(normal, face) < 0)
                normal = -normal;
            const PatternSpot spot = {fragment.position, normal, face, fragment.to_eye};
            vec4 colour = paint.cusps ? vec4(cusp(pattern, spot), 1) : through(pattern, spot, vec2(pixel), samples);
            if (hangs_over(pattern, fragment))
                colour = vec4(glm::mix(vec3(colour), overhang_colour, overhang_cover), colour.w);
            sum += clear * vec3(colour);
            clear *= 1 - colour.w;
            if (!paint.see_through)
                break;
            fragment = tracer.behind(pixel, fragment);
        }
        return clear > 1e-3f ? sum + clear * backdrop(pixel) : sum;
    }
};

bool is_on_edge(const std::vector<SeenPlace>& places, const ivec2& size, int x, int y)
{
    const auto at = [&](int px, int py) -> const SeenPlace& { return places[std::size_t(py) * std::size_t(size.x) + std::size_t(px)]; };
    for (int ny = std::max(0, y - 1); ny <= std::min(size.y - 1, y + 1); ++ny)
        for (int nx = std::max(0, x - 1); nx <= std::min(size.x - 1, x + 1); ++nx)
            if (is_outline(at(x, y), at(nx, ny)))
                return true;
    return false;
}

void store(Image& image, int x, int y, const vec3& linear)
{
    const vec3 c = encoded_colour(glm::max(linear, vec3(0)));
    for (int k = 0; k < 3; ++k)
        image.at(x, y)[k] = c[k];
}

} // namespace

Image paint_pattern(const SeenScene& scene, const Camera& camera, const PatternOptions& options, const PatternPlace& place,
                    const ShadeOptions& shade)
{
    const std::vector<PatternLight> lights = pattern_lights(scene, camera, shade, place);
    const PatternPaint paint = compose_pattern(scene, options, place, shade, lights);
    ShadeOptions openness = shade; // light is the pattern's own
    openness.wide.reset();
    Painter painter = {scene,
                       paint,
                       shade,
                       lights,
                       FragmentTracer(scene, camera),
                       Lighting(scene, openness),
                       {},
                       even_samples(shade.light_samples, KERNEL_BOX, 1, vec2(0))};
    for (const PaintedPattern& pattern : paint.patterns)
        painter.cameras.emplace_back(camera, scene.centre, scene.scale, pattern.frame);
    Image image(camera.size, 3);
    const ivec2 size = camera.size;
    const std::vector<dvec2> rays = sample_pattern(shade.samples);
    const std::uint32_t whole = std::uint32_t(shade.light_samples),
                        part = (whole - 1) / std::uint32_t(rays.size()) + 1; // samples of light for a pixel, and for each of its rays
    const std::uint32_t per_pixel = whole + part * std::uint32_t(rays.size());
    std::vector<SeenPlace> places(std::size_t(size.x) * std::size_t(size.y), {vec3(0), vec3(0), 0});
    parallel_each(std::size_t(size.y), 2, [&](std::size_t row) {
        for (int x = 0; x < size.x; ++x) {
            const dvec2 pixel = {x + 0.5, double(row) + 0.5};
            const Fragment fragment = painter.tracer.at(pixel);
            if (fragment.hit())
                places[row * std::size_t(size.x) + std::size_t(x)] = {
                    fragment.position, seen_normal(fragment.face_normal, fragment.to_eye),
                    float(1 / (camera.pixels_per_unit(double(fragment.depth)) * scene.scale))};
            store(image, x, int(row), painter.at(pixel, fragment, {whole, PixelSequence({x, int(row)}, per_pixel), {0, whole}}));
        }
    });
    if (rays.size() == 1)
        return image;
    parallel_each(std::size_t(size.y), 1, [&](std::size_t row) {
        for (int x = 0; x < size.x; ++x) {
            if (!is_on_edge(places, size, x, int(row)))
                continue;
            vec3 sum(0);
            std::uint32_t first = whole;
            for (const dvec2& offset : rays) {
                const dvec2 pixel = {x + offset.x, double(row) + offset.y};
                sum += painter.at(pixel, painter.tracer.at(pixel), {part, PixelSequence({x, int(row)}, per_pixel), {first, part}});
                first += part;
            }
            store(image, x, int(row), sum / float(rays.size()));
        }
    });
    return image;
}

CuspHistogram print_cusps(const SeenScene& scene, const PatternOptions& options, const PatternPlace& place)
{
    std::vector<float> heights, areas;
    const double mm = mm_in_frame(scene, place);
    std::vector<PrintStack> prints;
    const std::size_t parts = options.with_object ? scene.part_count() : 1;
    for (std::size_t part = 0; part < parts; ++part)
        prints.push_back(print_stack(scene, options, place, options.with_object ? std::optional(part) : std::nullopt));
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        const RayTriangles& t = scene.objects[o].triangles;
        for (std::size_t i = 0; i < t.triangles.size(); ++i) {
            const auto& [up, stack] = prints[options.with_object ? scene.part_of(std::uint32_t(o), std::uint32_t(i)) : 0];
            const vec3 a = t.positions[t.triangles[i].x], b = t.positions[t.triangles[i].y], c = t.positions[t.triangles[i].z],
                       n = glm::cross(b - a, c - a);
            const float size = glm::length(n);
            if (!(size > 0))
                continue;
            const float height = stack.place(glm::dot((a + b + c) / 3.0f, vec3(up)), vec2(0), 1).height * float(mm);
            heights.push_back(cusp_height(height, glm::dot(n, vec3(up)) / size));
            areas.push_back(size);
        }
    }
    return cusp_histogram(heights, areas, thickest_layer(options), 20);
}

} // namespace limn
