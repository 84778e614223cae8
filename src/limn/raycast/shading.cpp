#include "limn/raycast/shading.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/formulas/formulas.h"

namespace limn {
namespace {

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

/// A step in tone that the eye does not see: below it an edge needs no anti-aliasing.
constexpr float unseen_step = 1.0f / 48;

void store(Image& image, int x, int y, const vec3& colour)
{
    float* pixel = image.at(x, y);
    pixel[0] = colour.x, pixel[1] = colour.y, pixel[2] = colour.z;
}

bool differs(const float* a, const float* b)
{
    return std::abs(a[0] - b[0]) > unseen_step || std::abs(a[1] - b[1]) > unseen_step || std::abs(a[2] - b[2]) > unseen_step;
}

/// True if a pixel looks like the eight around it.
bool is_even(const Image& image, int x, int y)
{
    for (int ny = std::max(0, y - 1); ny <= std::min(image.height - 1, y + 1); ++ny)
        for (int nx = std::max(0, x - 1); nx <= std::min(image.width - 1, x + 1); ++nx)
            if (differs(image.at(nx, ny), image.at(x, y)))
                return false;
    return true;
}

/// The encoded colours between which light mixes.
struct Tones {
    vec3 dark, light;
};

/// The colour that is seen in a place of the picture.
struct Shader {
    const SeenScene& scene;
    const ShadeOptions& options;
    vec3 to_light; ///< zero: headlight
    std::optional<vec3> lamp; ///< in the frame of the scene
    FragmentTracer tracer;

    vec3 light_at(const Fragment& fragment) const
    {
        const vec3 d = lamp ? *lamp - fragment.position : vec3(0);
        return d == vec3(0) ? to_light : glm::normalize(d);
    }
    Tones tones_of(const Fragment& fragment) const
    {
        if (options.materials.empty())
            return {options.dark, options.light};
        const Material& material = options.materials[scene.part_of(fragment.object, fragment.triangle)];
        return {material.dark(), material.colour};
    }
    vec3 at(const dvec2& pixel) const
    {
        const Fragment fragment = tracer.at(pixel);
        if (!fragment.hit())
            return options.background;
        float tone = diffuse_value(fragment, options.shading == Shading::flat ? fragment.face_normal : fragment.normal, light_at(fragment));
        if (options.shading == Shading::toon)
            tone = formulas::toon_tone(tone, options.toon_limit, float(options.toon_levels));
        const Tones tones = tones_of(fragment);
        return glm::mix(tones.dark, tones.light, tone);
    }
};

} // namespace

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
    const Shader shader = {scene, options, to_light, lamp, FragmentTracer(scene, camera)};
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
