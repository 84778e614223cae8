#include "limn/scene/terrain_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/formulas/formulas.h"
#include "limn/raycast/ray_scene.h"
#include "limn/terrain/sample_slope.h"

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
    Painter(const GroundNormal& normal, const Mesh& mesh, const Camera& camera, const TerrainPictureOptions& options, const GroundColour& colour)
        : normal_(normal), camera_(camera), options_(options), drape_(colour), terrain_(mesh), rays_(std::array{terrain_.triangles()}), sun_(sun_direction(options))
    {
        const Bounds bounds = mesh.bounds();
        low_ = bounds.empty() ? 0 : bounds.low.z, relief_ = bounds.empty() ? 0 : bounds.high.z - low_;
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
        return formulas::terrain_light(vec3(normal_(p)), sun_) * ground(p);
    }
    vec3 ground(const dvec3& p) const
    {
        if (!drape_)
            return bare_ground(p.z);
        const vec4 draped = drape_(p);
        return draped.a < 1 ? glm::mix(bare_ground(p.z), vec3(draped), draped.a) : vec3(draped);
    }
    vec3 bare_ground(double z) const
    {
        if (options_.colours == TerrainPictureOptions::Colours::plain)
            return plain_ground;
        return formulas::terrain_tint(relief_ > 0 ? float((z - low_) / relief_) : 0.5f);
    }
    const GroundNormal& normal_;
    const Camera& camera_;
    const TerrainPictureOptions& options_;
    const GroundColour& drape_;
    RayTerrain terrain_;
    RayScene rays_;
    double low_ = 0, relief_ = 0;
    vec3 sun_;
};

void check(const TerrainPictureOptions& options)
{
    if (options.samples < 1 || options.samples > 16)
        throw Error::Input(fmt::format("{} rays along a pixel's side: 1 to 16 can be", options.samples));
    if (!(options.sun_height >= 0 && options.sun_height <= 90) || !std::isfinite(options.sun_azimuth))
        throw Error::Input(fmt::format("a sun at azimuth {}, {} degrees high: heights are 0 to 90", options.sun_azimuth, options.sun_height));
}

} // namespace

vec3 sun_direction(const TerrainPictureOptions& options)
{
    const double azimuth = glm::radians(options.sun_azimuth), height = glm::radians(options.sun_height);
    return vec3(dvec3(std::sin(azimuth) * std::cos(height), std::cos(azimuth) * std::cos(height), std::sin(height)));
}

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

dvec2 drape_place(const HeightMap& map, const dvec2& place)
{
    const dvec2 cell = {place.x / map.spacing.x, double(map.rows - 1) - place.y / map.spacing.y};
    return (cell + 0.5) / dvec2(map.columns, map.rows);
}

vec4 draped_at(const HeightMap& map, const Image& drape, const dvec2& place)
{
    const dvec2 p = glm::clamp(drape_place(map, place) * dvec2(drape.size()) - 0.5, dvec2(0), dvec2(drape.size() - 1));
    const ivec2 first(p), last = glm::min(first + 1, drape.size() - 1);
    const vec2 t(p - dvec2(first));
    const auto at = [&](int x, int y) {
        const float* const c = drape.at(x, y);
        return vec4(c[0], c[1], c[2], c[3]);
    };
    return glm::mix(glm::mix(at(first.x, first.y), at(last.x, first.y), t.x), glm::mix(at(first.x, last.y), at(last.x, last.y), t.x), t.y);
}

Image paint_terrain(const HeightMap& map, const Mesh& mesh, const Camera& camera, const TerrainPictureOptions& options, const Image* drape)
{
    GroundColour colour;
    if (drape)
        colour = [&](const dvec3& place) { return draped_at(map, *drape, dvec2(place)); };
    return paint_terrain([&](const dvec3& place) { return terrain_normal(map, dvec2(place)); }, mesh, camera, options, colour);
}

Image paint_terrain(const GroundNormal& normal, const Mesh& mesh, const Camera& camera, const TerrainPictureOptions& options, const GroundColour& colour)
{
    check(options);
    const Painter painter(normal, mesh, camera, options, colour);
    Image image(camera.size, 3);
    parallel_each(std::size_t(camera.size.y), 4, [&](std::size_t row) {
        for (int x = 0; x < camera.size.x; ++x) {
            const vec3 seen = painter.pixel(x, int(row));
            std::copy(&seen.x, &seen.x + 3, image.at(x, int(row)));
        }
    });
    return image;
}

} // namespace limn
