#include "limn/subdivision/normal_map.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/drawing/png.h"
#include "limn/subdivision/subdivide.h"
#include "subdivision/charted.h"
#include "subdivision/control_meshes.h"

namespace limn::test {
namespace {

dvec3 decoded(const float* texel) { return 2.0 * dvec3(texel[0], texel[1], texel[2]) - 1.0; }

/// What a graphics card reads at texture coordinates, filtered bilinearly.
dvec3 filtered(const Image& map, const dvec2& uv)
{
    const dvec2 p = dvec2(uv.x, 1 - uv.y) * double(map.width) - 0.5;
    const ivec2 low(int(std::floor(p.x)), int(std::floor(p.y)));
    dvec3 sum(0);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) {
            const ivec2 at = glm::clamp(low + ivec2(x, y), ivec2(0), map.size() - 1);
            const dvec2 f = p - dvec2(low);
            sum += (x == 1 ? f.x : 1 - f.x) * (y == 1 ? f.y : 1 - f.y) * decoded(map.at(at.x, at.y));
        }
    return glm::normalize(sum);
}

/// The next mip level: means of 2 x 2 texels.
Image halved(const Image& map)
{
    Image half(map.size() / 2, map.channels);
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x)
            for (int k = 0; k < map.channels; ++k)
                half.at(x, y)[k] = (map.at(2 * x, 2 * y)[k] + map.at(2 * x + 1, 2 * y)[k] + map.at(2 * x, 2 * y + 1)[k] + map.at(2 * x + 1, 2 * y + 1)[k]) / 4;
    return half;
}

dvec2 mixed(std::span<const vec2> uvs, const PatchPoint& at)
{
    const std::size_t c = 3 * std::size_t(at.face);
    return (1 - at.v - at.w) * dvec2(uvs[c]) + at.v * dvec2(uvs[c + 1]) + at.w * dvec2(uvs[c + 2]);
}

/// Calls f at places along all sides of all faces.
void along_edges(std::size_t faces, int steps, const std::function<void(const PatchPoint&)>& f)
{
    for (std::uint32_t face = 0; face < faces; ++face)
        for (int k = 0; k < 3; ++k)
            for (int i = 0; i < steps; ++i) {
                double weights[3] = {0, 0, 0};
                weights[k] = 1 - (i + 0.5) / steps;
                weights[(k + 1) % 3] = (i + 0.5) / steps;
                f({face, weights[1], weights[2]});
            }
}

struct Errors {
    double mean = 0, most = 0;
    std::size_t count = 0, above = 0; ///< samples, those more than 2 degrees off
    void add(double degrees)
    {
        mean += (degrees - mean) / double(++count);
        most = std::max(most, degrees);
        above += degrees > 2;
    }
};

Errors edge_errors(const Charted& it, const Image& map)
{
    Errors errors;
    along_edges(it.mesh.triangles.size(), 16, [&](const PatchPoint& at) { errors.add(degrees_between(filtered(map, mixed(it.layout.uvs, at)), it.shape.normal(at))); });
    return errors;
}

/// Smooth and creased models.
std::vector<std::pair<std::string, Mesh>> models()
{
    std::vector<std::pair<std::string, Mesh>> all = {{"octahedron", octahedron()}, {"torus", torus(6, 8)}};
    for (const std::string& name : control_sample_names())
        all.emplace_back(name, make_control_sample(name));
    return all;
}

// Checklist 27: texels against the surface, found from the texture coordinates as a viewer finds them.
TEST(NormalMap, TexelsHoldTheLimitNormalAtTheirPlace)
{
    for (const auto& [name, mesh] : models()) {
        const Charted it(mesh, {.size = 256});
        const NormalMap map = object_space_map(it.layout, it.shape);
        const Image read = decode_png(encode_png(map.texels), "map");
        std::vector<std::uint8_t> seen(256 * 256, 0);
        double most = 0, most_read = 0;
        for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
            const dvec2 a = dvec2(it.layout.uvs[3 * f]) * 256.0, b = dvec2(it.layout.uvs[3 * f + 1]) * 256.0, c = dvec2(it.layout.uvs[3 * f + 2]) * 256.0;
            const glm::dmat2 sides(b - a, c - a);
            const dvec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
            for (int y = int(low.y); y <= int(high.y); ++y)
                for (int x = int(low.x); x <= int(high.x); ++x) {
                    const dvec2 p = glm::inverse(sides) * (dvec2(x + 0.5, y + 0.5) - a);
                    if (p.x < 1e-4 || p.y < 1e-4 || p.x + p.y > 1 - 1e-4)
                        continue;
                    const float* texel = map.texels.at(x, 255 - y);
                    ASSERT_EQ(texel[3], 1) << name << " face " << f;
                    seen[std::size_t(255 - y) * 256 + std::size_t(x)] = 1;
                    const dvec3 truth = it.shape.normal({f, p.x, p.y});
                    most = std::max(most, degrees_between(decoded(texel), truth));
                    most_read = std::max(most_read, degrees_between(decoded(read.at(x, 255 - y)), truth));
                }
        }
        EXPECT_LT(most, 0.5) << name;
        EXPECT_LT(most_read, 1) << name;
        std::size_t covered = 0, elsewhere = 0;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            covered += map.texels.samples[4 * i + 3] == 1;
            elsewhere += map.texels.samples[4 * i + 3] == 1 && seen[i] == 0; // those on the line between two faces, or of a chart that holds none
        }
        EXPECT_EQ(map.covered, covered) << name;
        EXPECT_LE(elsewhere, covered / 100 + it.layout.charts.size() / 10) << name;
    }
}

// Checklist 29.
TEST(NormalMap, DilationKeepsFilteringRightAlongEdgesOfCharts)
{
    for (const auto& [name, mesh] : models()) {
        const Charted it(mesh, {.size = 1024});
        const Errors with = edge_errors(it, object_space_map(it.layout, it.shape).texels), without = edge_errors(it, object_space_map(it.layout, it.shape, false).texels);
        fmt::print("[ seams    ] {}: mean {:.3f}, most {:.2f} degrees, {} of {} above 2; not dilated: mean {:.2f}, most {:.1f}\n", name, with.mean, with.most, with.above,
                   with.count, without.mean, without.most);
        EXPECT_GT(without.mean, 10 * with.mean) << name;
    }
}

} // namespace
} // namespace limn::test
