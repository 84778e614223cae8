#include "limn/raycast/shading.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/formulas/formulas.h"

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

/// True if a pixel looks like the eight around it.
bool is_even(const Image& image, int x, int y)
{
    for (int ny = std::max(0, y - 1); ny <= std::min(image.height - 1, y + 1); ++ny)
        for (int nx = std::max(0, x - 1); nx <= std::min(image.width - 1, x + 1); ++nx)
            if (formulas::is_step(load(image, nx, ny), load(image, x, y)))
                return false;
    return true;
}

/// The encoded colours between which light mixes.
struct Tones {
    vec3 dark, light;
    explicit Tones(const Material& material) : dark(material.dark()), light(material.colour) {}
    Tones(const vec3& of_unlit, const vec3& of_lit) : dark(of_unlit), light(of_lit) {}
    vec3 at(float tone) const { return glm::mix(dark, light, tone); }
};

/// The colour that is seen in a place of the picture.
struct Shader {
    const SeenScene& scene;
    const ShadeOptions& options;
    vec3 to_light; ///< zero: headlight
    std::optional<vec3> lamp; ///< in the frame of the scene
    std::optional<GroundPlane> plane; ///< all objects are above it: it hides none
    vec3 eye; ///< in the frame of the scene; of parallel projection the direction towards it
    bool orthographic;
    FragmentTracer tracer;

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
    vec3 backdrop(const dvec2& pixel) const
    {
        if (!plane)
            return options.background;
        const Camera::Ray line = tracer.sight(pixel);
        const GroundPlane::Point ground = plane->meet(line);
        const vec3 colour = Tones(options.ground->material).at(tone(ground.position, plane->up(), -vec3(line.direction)));
        return glm::mix(options.background, colour, ground.cover);
    }
    vec3 at(const dvec2& pixel) const
    {
        const Fragment fragment = tracer.at(pixel);
        if (!fragment.hit())
            return backdrop(pixel);
        const vec3& normal = options.shading == Shading::flat ? fragment.face_normal : fragment.normal;
        if (options.shading == Shading::normals)
            return formulas::normal_colour(normal);
        if (options.shading == Shading::gouraud && !scene.objects[fragment.object].normals.empty())
            return tones_of(fragment).at(tone_between_vertices(fragment));
        return tones_of(fragment).at(tone(fragment.position, normal, fragment.to_eye));
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
    const std::optional<vec3> lamp = options.lamp ? std::optional(vec3((*options.lamp - scene.centre) / scene.scale)) : std::nullopt;
    const std::optional<GroundPlane> plane = options.ground ? std::optional(GroundPlane(*options.ground, scene.centre, scene.scale)) : std::nullopt;
    const vec3 eye = camera.orthographic ? vec3(-camera.forward()) : vec3((camera.eye - scene.centre) / scene.scale);
    const Shader shader = {scene, options, to_light, lamp, plane, eye, camera.orthographic, FragmentTracer(scene, camera)};
    Image centres(camera.size, 3);
    parallel_each(std::size_t(camera.size.y), 4, [&](std::size_t y) {
        for (int x = 0; x < camera.size.x; ++x)
            store(centres, x, int(y), shader.at({x + 0.5, double(y) + 0.5}));
    });
    const std::vector<dvec2> pattern = sample_pattern(options.samples);
    Image image = centres;
    parallel_each(std::size_t(camera.size.y), 1, [&](std::size_t y) {
        for (int x = 0; x < camera.size.x; ++x) {
            if (is_even(centres, x, int(y)))
                continue;
            vec3 sum = vec3(0);
            for (const dvec2& offset : pattern)
                sum += shader.at({x + offset.x, double(y) + offset.y});
            store(image, x, int(y), sum / float(options.samples));
        }
    });
    return image;
}

} // namespace limn
