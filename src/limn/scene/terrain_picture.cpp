#include "limn/scene/terrain_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/raycast/ray_scene.h"
#include "limn/scene/sample_slope.h"

namespace limn {
namespace {

double slope(const HeightMap& map, const ivec2& at, const ivec2& step)
{
    const auto height = [&](const ivec2& p) {
        const ivec2 q = glm::clamp(p, ivec2(0), ivec2(map.columns - 1, map.rows - 1));
        return p == q ? double(map.height(q.x, q.y)) : std::nan("");
    };
    return sample_slope(height(at - step), height(at), height(at + step));
}

dvec3 normal_at_sample(const HeightMap& map, const ivec2& p)
{
    return glm::normalize(dvec3(-slope(map, p, {1, 0}) / map.spacing.x, slope(map, p, {0, 1}) / map.spacing.y, 1)); // rows run south
}

/// Heights from 0 (lowest) to 1, as hand-made relief maps have them.
vec3 tint(float height)
{
    static constexpr std::array<vec3, 6> ramp = {vec3(0.47f, 0.62f, 0.42f), vec3(0.72f, 0.77f, 0.53f), vec3(0.89f, 0.84f, 0.62f),
                                                 vec3(0.80f, 0.67f, 0.48f), vec3(0.70f, 0.60f, 0.53f), vec3(0.97f, 0.96f, 0.95f)};
    const float place = glm::clamp(height, 0.0f, 1.0f) * float(ramp.size() - 1);
    const std::size_t i = std::min(std::size_t(place), ramp.size() - 2);
    return glm::mix(ramp[i], ramp[i + 1], place - float(i));
}

/// The mesh in floats around the middle of its box, as rays need it.
class RayTerrain {
public:
    explicit RayTerrain(const Mesh& mesh) : centre_(mesh.bounds().centre()), triangles_(mesh.triangles)
    {
        positions_.reserve(mesh.positions.size() + 1);
        for (const dvec3& p : mesh.positions)
            positions_.emplace_back(p - centre_);
        positions_.emplace_back(0); // a spare one for the tracer
    }
    RayTriangles triangles() const { return {std::span(positions_).first(positions_.size() - 1), triangles_}; }
    const dvec3& centre() const { return centre_; }

private:
    dvec3 centre_;
    std::vector<vec3> positions_;
    std::span<const uvec3> triangles_;
};

class Painter {
public:
    Painter(const GroundNormal& normal, const Mesh& mesh, const Camera& camera, const TerrainPictureOptions& options)
        : normal_(normal), camera_(camera), options_(options), terrain_(mesh), rays_(std::array{terrain_.triangles()})
    {
        const Bounds bounds = mesh.bounds();
        low_ = bounds.empty() ? 0 : bounds.low.z, relief_ = bounds.empty() ? 0 : bounds.high.z - low_;
        const double azimuth = glm::radians(options.sun_azimuth), height = glm::radians(options.sun_height);
        sun_ = {std::sin(azimuth) * std::cos(height), std::cos(azimuth) * std::cos(height), std::sin(height)};
    }
    vec3 pixel(int x, int y) const
    {
        vec3 sum(0);
        for (int j = 0; j < options_.samples; ++j)
            for (int i = 0; i < options_.samples; ++i)
                sum += colour({x + (i + 0.5) / options_.samples, y + (j + 0.5) / options_.samples});
        return sum / float(options_.samples * options_.samples);
    }

private:
    vec3 colour(const dvec2& place) const
    {
        const Camera::Ray ray = camera_.ray(place);
        const Hit hit = rays_.closest({vec3(ray.origin - terrain_.centre()), vec3(ray.direction)});
        if (!hit)
            return options_.background;
        const dvec3 p = ray.origin + double(hit.distance) * ray.direction;
        return light(normal_(p)) * ground(p.z);
    }
    vec3 ground(double z) const
    {
        if (options_.colours == TerrainPictureOptions::Colours::plain)
            return vec3(0.9f);
        return tint(relief_ > 0 ? float((z - low_) / relief_) : 0.5f);
    }
    /// Light of the sky and of the sun: flat ground is as bright as its colour.
    float light(const dvec3& normal) const
    {
        constexpr double sky = 0.35;
        const double flat = std::max(sun_.z, 0.2), lit = std::max(0.0, glm::dot(normal, sun_)) / flat;
        return float(std::min(sky + (1 - sky) * lit, 1.12));
    }
    const GroundNormal& normal_;
    const Camera& camera_;
    const TerrainPictureOptions& options_;
    RayTerrain terrain_;
    RayScene rays_;
    double low_ = 0, relief_ = 0;
    dvec3 sun_;
};

void check(const TerrainPictureOptions& options)
{
    if (options.samples < 1 || options.samples > 16)
        throw Error::Input(fmt::format("{} rays along a pixel's side: 1 to 16 can be", options.samples));
    if (!(options.sun_height >= 0 && options.sun_height <= 90) || !std::isfinite(options.sun_azimuth))
        throw Error::Input(fmt::format("a sun at azimuth {}, {} degrees high: heights are 0 to 90", options.sun_azimuth, options.sun_height));
}

} // namespace

const OptionTable<TerrainPictureOptions>& terrain_picture_option_table()
{
    using Options = TerrainPictureOptions;
    static const OptionTable<Options> table = {
        choice_row<Options, Options::Colours>("colours", {{"tint", Options::Colours::tint}, {"plain", Options::Colours::plain}}, "colour of the ground: by height, or light grey",
                                              &Options::colours),
        number_row("sun-azimuth", "degrees", -360, 360, "where the light comes from, clockwise from north", &Options::sun_azimuth),
        number_row("sun-height", "degrees", 0, 90, "how high above the horizon the light stands", &Options::sun_height),
        number_row("samples", "", 1, 16, "rays along each side of a pixel", &Options::samples),
    };
    return table;
}

dvec3 terrain_normal(const HeightMap& map, const dvec2& place)
{
    const double column = std::clamp(place.x / map.spacing.x, 0.0, double(map.columns - 1));
    const double row = std::clamp(double(map.rows - 1) - place.y / map.spacing.y, 0.0, double(map.rows - 1));
    const ivec2 first(std::min(int(column), map.columns - 2), std::min(int(row), map.rows - 2));
    const double u = column - first.x, v = row - first.y;
    const dvec3 north = glm::mix(normal_at_sample(map, first), normal_at_sample(map, first + ivec2(1, 0)), u);
    const dvec3 south = glm::mix(normal_at_sample(map, first + ivec2(0, 1)), normal_at_sample(map, first + ivec2(1, 1)), u);
    return glm::normalize(glm::mix(north, south, v));
}

Image paint_terrain(const HeightMap& map, const Mesh& mesh, const Camera& camera, const TerrainPictureOptions& options)
{
    return paint_terrain([&](const dvec3& place) { return terrain_normal(map, dvec2(place)); }, mesh, camera, options);
}

Image paint_terrain(const GroundNormal& normal, const Mesh& mesh, const Camera& camera, const TerrainPictureOptions& options)
{
    check(options);
    const Painter painter(normal, mesh, camera, options);
    Image image(camera.size, 3);
    parallel_each(std::size_t(camera.size.y), 4, [&](std::size_t row) {
        for (int x = 0; x < camera.size.x; ++x) {
            const vec3 colour = painter.pixel(x, int(row));
            std::copy(&colour.x, &colour.x + 3, image.at(x, int(row)));
        }
    });
    return image;
}

} // namespace limn
