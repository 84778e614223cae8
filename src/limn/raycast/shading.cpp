#include "limn/raycast/shading.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/formulas/formulas.h"
#include "limn/raycast/lighting.h"

namespace limn {
namespace {

void store(Image& image, int x, int y, const vec3& colour)
{
    float* pixel = image.at(x, y);
    pixel[0] = colour.x, pixel[1] = colour.y, pixel[2] = colour.z;
}

vec3 load(const Image& image, int x, int y)
{
    const float* pixel = image.at(x, y);
    return {pixel[0], pixel[1], pixel[2]};
}

/// A step that is more than noise: the edge of a shadow, say.
bool is_high_step(const vec3& a, const vec3& b)
{
    const vec3 d = glm::abs(a - b);
    return std::max({d.x, d.y, d.z}) > 0.1f;
}

/// True if a pixel looks like the eight around it.
template <class IsStep> bool is_even(const Image& image, int x, int y, IsStep&& is_step)
{
    for (int ny = std::max(0, y - 1); ny <= std::min(image.height - 1, y + 1); ++ny)
        for (int nx = std::max(0, x - 1); nx <= std::min(image.width - 1, x + 1); ++nx)
            if (is_step(load(image, nx, ny), load(image, x, y)))
                return false;
    return true;
}

/// Encoded colours of a place of the picture: as it is seen, and without what is noisy. The latter tells edges; it has no meaning where nothing is.
struct Seen {
    vec3 colour, sharp;
};

/// Which samples of light to take.
struct Samples {
    PixelSequence sequence;
    SampleRange range;
};

constexpr float off_surface = 1e-4f; ///< in the frame of the scene, whose objects are about 1 in radius

/// Where lines from a fragment to light begin. Where normals are interpolated it is lifted onto the round surface that they tell of, or flat triangles
/// would shade themselves near the edge of the dark (Hanika 2021, "Hacking the shadow terminator").
vec3 place_off_surface(const SeenObject& object, const Fragment& fragment, bool is_flat)
{
    const float side = fragment.front() ? 1.0f : -1.0f;
    vec3 place = fragment.position + off_surface * side * fragment.face_normal;
    if (is_flat || object.normals.empty())
        return place;
    const uvec3& t = object.triangles.triangles[fragment.triangle];
    const float weights[3] = {1 - fragment.u - fragment.v, fragment.u, fragment.v};
    for (int k = 0; k < 3; ++k) {
        const vec3 normal = side * object.normals[t[k]];
        place -= weights[k] * std::min(0.0f, glm::dot(fragment.position - object.triangles.positions[t[k]], normal)) * normal;
    }
    return place;
}

/// Nothing for light from all sides.
std::optional<dvec3> middle_of(const WideLight& light)
{
    if (const auto* ball = std::get_if<SphereLight>(&light))
        return ball->centre;
    if (const auto* rectangle = std::get_if<RectangleLight>(&light))
        return rectangle->centre;
    return std::nullopt;
}

/// The colour that is seen in a place of the picture.
struct Shader {
    const SeenScene& scene;
    const ShadeOptions& options;
    vec3 to_light; ///< zero: headlight
    std::optional<vec3> lamp; ///< in the frame of the scene; of a light with a size its middle
    std::optional<GroundPlane> plane; ///< all objects are above it: it hides none
    vec3 eye; ///< in the frame of the scene; of parallel projection the direction towards it
    bool orthographic;
    FragmentTracer tracer;
    Lighting lighting;

    vec3 light_from(const vec3& position, const vec3& to_eye) const
    {
        const vec3 d = lamp ? *lamp - position : vec3(0);
        return d != vec3(0) ? glm::normalize(d) : to_light != vec3(0) ? to_light : to_eye;
    }
    float toon_levels() const { return options.shading == Shading::toon ? float(options.toon_levels) : 0.0f; }
    float tone(const vec3& position, const vec3& normal, const vec3& to_eye) const
    {
        return formulas::surface_tone(normal, to_eye, light_from(position, to_eye), options.toon_limit, toon_levels());
    }
    /// Of the side of the triangle that is seen: at a vertex on the contour the normal itself cannot tell.
    float tone_between_vertices(const Fragment& fragment) const
    {
        const SeenObject& object = scene.objects[fragment.object];
        const float weights[3] = {1 - fragment.u - fragment.v, fragment.u, fragment.v};
        const float side = fragment.front() ? 1 : -1;
        float sum = 0;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t vertex = object.triangles.triangles[fragment.triangle][k];
            const vec3& position = object.triangles.positions[vertex];
            const vec3 towards = light_from(position, orthographic ? eye : glm::normalize(eye - position));
            sum += weights[k] * formulas::side_tone(side * object.normals[vertex], towards, options.toon_limit, toon_levels());
        }
        return sum;
    }
    Tones tones_of(const Fragment& fragment) const
    {
        if (options.materials.empty())
            return {options.dark, options.light};
        return Tones(options.materials[scene.part_of(fragment.object, fragment.triangle)]);
    }
    /// Where the light is, as Occlusion has it; nothing at the eye. Only the several samples of a pixel on an edge take their chances.
    std::optional<LightPlace> light_place(const Samples& samples) const
    {
        if (!lamp && to_light == vec3(0))
            return std::nullopt;
        return LightPlace{lamp ? vec4(*lamp, 1) : vec4(to_light, 0), samples.range.first == 0 ? vec2(0.5f) : samples.sequence.chance(samples.range.first)};
    }
    /// @param tone  of the light without size, unhidden
    Seen lit(const LitPlace& at, float tone, const Samples& samples) const
    {
        if (!lighting.is_needed())
            return {at.tones.at(tone), vec3(0)};
        const vec3 sharp = at.tones.at(lighting.has_wide_light() ? tone : lighting.unhidden_tone(tone, at, light_place(samples)));
        const vec3 colour = lighting.has_wide_light() ? lighting.wide_colour(at, samples.sequence, samples.range) : sharp;
        return {lighting.closed_in(colour, at, samples.sequence, samples.range), sharp};
    }
    Seen backdrop(const dvec2& pixel, const Samples& samples) const
    {
        if (!plane)
            return {options.background, options.background};
        const Camera::Ray line = tracer.sight(pixel);
        const GroundPlane::Point ground = plane->meet(line);
        if (lighting.is_needed() && !(ground.cover > 0))
            return {options.background, options.background};
        const vec3 to_eye = -vec3(line.direction);
        const LitPlace at = {ground.position + off_surface * plane->up(), plane->up(), to_eye, Tones(options.ground->material)};
        const Seen seen = lit(at, tone(ground.position, plane->up(), to_eye), samples);
        return {glm::mix(options.background, seen.colour, ground.cover), glm::mix(options.background, seen.sharp, ground.cover)};
    }
    Seen at(const dvec2& pixel, const Samples& samples) const
    {
        const Fragment fragment = tracer.at(pixel);
        if (!fragment.hit())
            return backdrop(pixel, samples);
        const vec3& normal = options.shading == Shading::flat ? fragment.face_normal : fragment.normal;
        if (options.shading == Shading::normals)
            return {formulas::normal_colour(normal), formulas::normal_colour(normal)};
        const bool between = options.shading == Shading::gouraud && !scene.objects[fragment.object].normals.empty();
        const float unhidden = between ? tone_between_vertices(fragment) : tone(fragment.position, normal, fragment.to_eye);
        const vec3 from = lighting.is_needed() ? place_off_surface(scene.objects[fragment.object], fragment, options.shading == Shading::flat) : fragment.position;
        return lit({from, formulas::seen_normal(normal, fragment.to_eye), fragment.to_eye, tones_of(fragment)}, unhidden, samples);
    }
};

} // namespace

void check(const ShadeOptions& options, std::size_t parts)
{
    if (options.toon_levels < 2 || options.toon_levels > 16)
        throw Error::Input(fmt::format("{} toon levels are outside 2..16", options.toon_levels));
    if (!(options.toon_limit > 0 && options.toon_limit < 1))
        throw Error::Input(fmt::format("the toon limit {} is outside 0..1", options.toon_limit));
    if (options.samples < 1 || options.samples > 256)
        throw Error::Input(fmt::format("{} samples of a pixel are outside 1..256", options.samples));
    if (options.to_light && !(glm::length(*options.to_light) > 0))
        throw Error::Input("the light has no direction");
    if (options.to_light && options.lamp)
        throw Error::Input("a distant light and a lamp were both asked for; give one");
    if (options.wide && (options.to_light || options.lamp))
        throw Error::Input("a light with a size and one without were both asked for; give one");
    if (options.light_samples < 1 || options.light_samples > 65536)
        throw Error::Input(fmt::format("{} samples of light are outside 1..65536", options.light_samples));
    if (options.open_radius && !(*options.open_radius > 0))
        throw Error::Input("the radius of openness is not above 0");
    if (!options.materials.empty() && options.materials.size() != parts)
        throw Error::Input(fmt::format("{} materials do not fit {} objects", options.materials.size(), parts));
}

float diffuse_value(const Fragment& fragment, const vec3& normal, const vec3& to_light)
{
    const vec3 n = formulas::seen_normal(normal, fragment.to_eye);
    return std::min(1.0f, formulas::diffuse(n, to_light == vec3(0) ? fragment.to_eye : to_light));
}

Image shade(const SeenScene& scene, const Camera& camera, const ShadeOptions& options)
{
    check(options, scene.part_count());
    const vec3 to_light = options.to_light ? vec3(glm::normalize(*options.to_light)) : vec3(0);
    const std::optional<dvec3> place = options.wide ? middle_of(*options.wide) : options.lamp;
    const std::optional<vec3> lamp = place ? std::optional(vec3((*place - scene.centre) / scene.scale)) : std::nullopt;
    const std::optional<GroundPlane> plane = options.ground ? std::optional(GroundPlane(*options.ground, scene.centre, scene.scale)) : std::nullopt;
    const vec3 eye = camera.orthographic ? vec3(-camera.forward()) : vec3((camera.eye - scene.centre) / scene.scale);
    const Shader shader = {scene, options, to_light, lamp, plane, eye, camera.orthographic, FragmentTracer(scene, camera), Lighting(scene, options)};
    const std::vector<dvec2> pattern = sample_pattern(options.samples);
    const bool is_noisy = shader.lighting.is_noisy();
    const std::uint32_t whole = is_noisy ? std::uint32_t(options.light_samples) : 1, part = (whole - 1) / std::uint32_t(options.samples) + 1;
    const std::uint32_t per_pixel = whole + part * std::uint32_t(options.samples);
    Image centres(camera.size, 3), sharp(is_noisy ? camera.size : ivec2(0), 3);
    parallel_each(std::size_t(camera.size.y), 4, [&](std::size_t y) {
        for (int x = 0; x < camera.size.x; ++x) {
            const Seen seen = shader.at({x + 0.5, double(y) + 0.5}, {PixelSequence({x, int(y)}, per_pixel), {0, whole}});
            store(centres, x, int(y), seen.colour);
            if (is_noisy)
                store(sharp, x, int(y), seen.sharp);
        }
    });
    Image image = centres;
    parallel_each(std::size_t(camera.size.y), 1, [&](std::size_t y) {
        for (int x = 0; x < camera.size.x; ++x) {
            if (is_even(is_noisy ? sharp : centres, x, int(y), formulas::is_step) && (!is_noisy || is_even(centres, x, int(y), is_high_step)))
                continue;
            const PixelSequence sequence({x, int(y)}, per_pixel);
            vec3 sum = vec3(0);
            std::uint32_t first = whole;
            for (const dvec2& offset : pattern) {
                sum += shader.at({x + offset.x, double(y) + offset.y}, {sequence, {first, part}}).colour;
                first += part;
            }
            store(image, x, int(y), sum / float(options.samples));
        }
    });
    return image;
}

} // namespace limn
