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
#include "limn/subdivision/tangent_frames.h"
#include "subdivision/charted.h"
#include "subdivision/control_meshes.h"

namespace limn::test {
namespace {

dvec3 decoded(const float* texel) { return 2.0 * dvec3(texel[0], texel[1], texel[2]) - 1.0; }

/// What a graphics card reads at texture coordinates, filtered bilinearly.
dvec3 sampled(const Image& map, const dvec2& uv)
{
    const dvec2 p = dvec2(uv.x, 1 - uv.y) * double(map.width) - 0.5;
    const ivec2 low(int(std::floor(p.x)), int(std::floor(p.y)));
    dvec3 sum(0);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) {
            const ivec2 at = glm::clamp(low + ivec2(x, y), ivec2(0), map.size() - 1);
            const dvec2 f = p - dvec2(low);
            sum += (x == 1 ? f.x : 1 - f.x) * (y == 1 ? f.y : 1 - f.y) * dvec3(map.at(at.x, at.y)[0], map.at(at.x, at.y)[1], map.at(at.x, at.y)[2]);
        }
    return sum;
}

dvec3 sampled_normal(const Image& map, const dvec2& uv) { return glm::normalize(2.0 * sampled(map, uv) - 1.0); }

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
    along_edges(it.mesh.triangles.size(), 16, [&](const PatchPoint& at) { errors.add(degrees_between(sampled_normal(map, mixed(it.layout.uvs, at)), it.shape.normal(at))); });
    return errors;
}

/// Smooth and creased models.
std::vector<std::pair<std::string, Mesh>> models()
{
    Mesh sharp = octahedron();
    sharp.creases = {{0, 2, 10}, {2, 1, 10}, {1, 3, 10}, {3, 0, 10}};
    std::vector<std::pair<std::string, Mesh>> all = {{"octahedron", octahedron()}, {"octahedron with a sharp equator", sharp}, {"torus", torus(6, 8)}};
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

// Checklist 29. Filtering cannot be right where a semi-sharp crease turns the normal within a texel or two: there only the means are asked for.
TEST(NormalMap, FilteringIsRightAlongEdgesOfCharts)
{
    for (const auto& [name, mesh] : models()) {
        const Charted it(mesh, {.size = 512});
        const auto errors = [&](MapGutter gutter) { return edge_errors(it, object_space_map(it.layout, it.shape, gutter).texels); };
        const Errors continued = errors(MapGutter::continued), nearest = errors(MapGutter::nearest), empty = errors(MapGutter::empty);
        fmt::print("[ seams    ] {}: degrees, mean and most: {:.3f} {:.2f} continued, {:.3f} {:.2f} nearest, {:.2f} {:.1f} empty; above 2: {} and {} of {}\n", name,
                   continued.mean, continued.most, nearest.mean, nearest.most, empty.mean, empty.most, continued.above, nearest.above, nearest.count);
        const bool resolved = mesh.creases.empty() || name == "octahedron with a sharp equator";
        EXPECT_LT(continued.most, resolved ? 2 : 45) << name;
        EXPECT_LT(continued.mean, resolved ? 0.2 : 2) << name;
        if (resolved) {
            EXPECT_LT(nearest.most, 2) << name;
        }
        EXPECT_LT(continued.mean, 0.8 * nearest.mean) << name;
        EXPECT_GT(empty.mean, 5 * nearest.mean) << name;
    }
}

// Every cell in a colour of its own: whatever filtering reads in a chart, at any clean level, is that colour alone.
TEST(NormalMap, MipLevelsUpToTheLogarithmOfTheGapMixNoCharts)
{
    for (const int gap : {2, 4, 16}) {
        const Charted it(make_control_sample("mug"), {.size = 512, .gap = gap});
        const Atlas& atlas = it.layout.atlas;
        Image map({512, 512}, 3);
        const auto colour = [](std::size_t chart) { return 1.0f + float(chart); };
        std::vector<std::size_t> chart_of(it.mesh.triangles.size());
        for (std::size_t i = 0; i < atlas.cells.size(); ++i) {
            for (int f = 0; f < it.layout.charts[i].face_count(); ++f)
                chart_of[it.layout.charts[i].faces[f]] = i;
            for (int y = atlas.cells[i].low.y; y < atlas.cells[i].high.y; ++y)
                for (int x = atlas.cells[i].low.x; x < atlas.cells[i].high.x; ++x)
                    std::fill_n(map.at(x, y), 3, colour(i));
        }
        std::size_t mixed_at_the_next = 0;
        for (int level = 0; level <= atlas.mip_levels() + 1; ++level) {
            along_edges(it.mesh.triangles.size(), 8, [&](const PatchPoint& at) {
                const bool same = std::abs(sampled(map, mixed(it.layout.uvs, at)).x - colour(chart_of[at.face])) < 1e-9;
                if (level <= atlas.mip_levels()) {
                    EXPECT_TRUE(same) << "gap " << gap << ", level " << level;
                } else {
                    mixed_at_the_next += !same;
                }
            });
            map = halved(map);
        }
        EXPECT_GT(mixed_at_the_next, 0u) << gap; // so that the levels are not told too modestly
    }
}

/// The control mesh's coordinates and their way down to a level.
Subdivided written(const Charted& it, int levels)
{
    Mesh mesh = it.mesh;
    mesh.corner_uvs = it.layout.uvs;
    return subdivide(mesh, {.levels = levels, .limit = true});
}

// A viewer's way: the tangent and normal of the mesh that is drawn, interpolated over its triangles, then the map.
TEST(NormalMap, InTangentSpaceGivesTheLimitNormalOnTheMeshThatIsDrawn)
{
    for (const std::string name : {"creature", "mug", "leaf"})
        for (const int levels : {0, 1, 3}) {
            const Charted it(make_control_sample(name), {.size = 256});
            const Subdivided made = written(it, levels);
            const NormalMap object = object_space_map(it.layout, it.shape), map = tangent_space_map(it.layout, it.shape, made.mesh, levels);
            EXPECT_EQ(map.covered, object.covered);
            const std::vector<dvec3> tangents = corner_tangents(made.mesh);
            double most = 0, blue = 0;
            std::size_t count = 0;
            for (std::size_t f = 0; f < made.mesh.triangles.size(); ++f) {
                const std::span<const vec2> uvs(made.mesh.corner_uvs.data() + 3 * f, 3);
                const dvec2 a = dvec2(uvs[0]) * 256.0, b = dvec2(uvs[1]) * 256.0, c = dvec2(uvs[2]) * 256.0;
                const dvec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
                const glm::dmat2 inverse = glm::inverse(glm::dmat2(b - a, c - a));
                for (int y = int(low.y); y <= int(high.y); ++y)
                    for (int x = int(low.x); x <= int(high.x); ++x) {
                        const dvec2 p = inverse * (dvec2(x + 0.5, y + 0.5) - a);
                        if (p.x < 1e-3 || p.y < 1e-3 || p.x + p.y > 1 - 1e-3)
                            continue;
                        const auto at = [&](const auto& values) { return (1 - p.x - p.y) * dvec3(values[3 * f]) + p.x * dvec3(values[3 * f + 1]) + p.y * dvec3(values[3 * f + 2]); };
                        const dvec3 n = at(made.mesh.corner_normals), t = at(tangents), m = decoded(map.texels.at(x, 255 - y));
                        const dvec3 shaded = m.x * t + m.y * glm::cross(n, t) + m.z * n;
                        most = std::max(most, degrees_between(shaded, decoded(object.texels.at(x, 255 - y))));
                        blue += m.z;
                        ++count;
                    }
            }
            EXPECT_GT(count, map.covered * 9 / 10) << name;
            EXPECT_LT(most, 0.05) << name << " level " << levels;
            EXPECT_GT(blue / double(count), levels == 0 ? 0.9 : 0.97) << name << " level " << levels; // mostly the mesh's own normal
        }
}

TEST(NormalMap, TangentsRunAlongU)
{
    Mesh mesh = sheet(2);
    mesh.corner_normals.assign(3 * mesh.triangles.size(), vec3(0, 0, 1));
    for (const uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) // u along y, v against x: turned, not mirrored
            mesh.corner_uvs.push_back({float(mesh.positions[t[k]].y), 1 - float(mesh.positions[t[k]].x)});
    for (const dvec3& t : corner_tangents(mesh))
        EXPECT_LT(glm::distance(t, dvec3(0, 1, 0)), 1e-7);
    // In the plane of the normal, and shared by the faces at a vertex.
    const Charted it(make_control_sample("creature"), {});
    const Mesh fine = written(it, 1).mesh;
    const std::vector<dvec3> tangents = corner_tangents(fine);
    for (std::size_t c = 0; c < tangents.size(); ++c) {
        EXPECT_NEAR(glm::length(tangents[c]), 1, 1e-9);
        EXPECT_NEAR(glm::dot(tangents[c], dvec3(fine.corner_normals[c])), 0, 1e-6);
    }
    for (std::size_t f = 0; f < fine.triangles.size(); f += 4) // corner 1 of a child at a corner is corner 0 of the middle one
        EXPECT_EQ(tangents[3 * f + 1], tangents[3 * (f + 3)]);
}

// One map for every level: coordinates of a finer mesh lie where those of the control mesh do.
TEST(NormalMap, ServesEveryLevelOfTheMesh)
{
    const Charted it(make_control_sample("bent-cylinder"), {.size = 512});
    const Image map = object_space_map(it.layout, it.shape).texels;
    for (const int levels : {0, 2}) {
        const Mesh mesh = written(it, levels).mesh;
        Errors errors;
        for (std::size_t c = 0; c < mesh.corner_uvs.size(); ++c)
            errors.add(degrees_between(sampled_normal(map, mesh.corner_uvs[c]), mesh.corner_normals[c]));
        EXPECT_LT(errors.most, 2) << levels;
        EXPECT_LT(errors.mean, 0.2) << levels;
    }
}

TEST(NormalMap, IsTheSameForAnyNumberOfThreads)
{
    const Charted it(make_control_sample("mug"), {.size = 128});
    const Mesh mesh = written(it, 1).mesh;
    const auto maps = [&] {
        Image map = object_space_map(it.layout, it.shape).texels;
        const Image tangent = tangent_space_map(it.layout, it.shape, mesh, 1).texels;
        map.samples.insert(map.samples.end(), tangent.samples.begin(), tangent.samples.end());
        return map.samples;
    };
    EXPECT_EQ(with_threads(1, maps), with_threads(4, maps));
}

TEST(NormalMap, RefusesAMeshOfAnotherLevel)
{
    const Charted it(make_control_sample("leaf"), {.size = 128});
    EXPECT_THROW(tangent_space_map(it.layout, it.shape, written(it, 1).mesh, 2), Error::Input);
    EXPECT_THROW(tangent_space_map(it.layout, it.shape, it.mesh, 0), Error::Input);
}

} // namespace
} // namespace limn::test
