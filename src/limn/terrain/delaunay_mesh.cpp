#include "limn/terrain/delaunay_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/terrain/delaunay_no_data.h"
#include "limn/terrain/delaunay_refine.h"
#include "limn/terrain/delaunay_simplify.h"

namespace limn {
namespace {

constexpr std::size_t most_samples = 700'000'000; // six half-edges of each have to have numbers of 32 bits

void check_size(const HeightMap& map)
{
    if (map.columns < 2 || map.rows < 2)
        throw Error::Input(fmt::format("a height map of {} x {} samples has no area; it needs 2 x 2", map.columns, map.rows));
    const std::size_t samples = std::size_t(map.columns) * std::size_t(map.rows);
    if (map.heights.size() != samples)
        throw Error::Input(fmt::format("a height map of {} x {} samples with {} heights", map.columns, map.rows, map.heights.size()));
    if (samples > most_samples)
        throw Error::Input(
            fmt::format("a height map of {} x {} samples: a Delaunay mesh can be made of {} in all", map.columns, map.rows, most_samples));
}

void check(const HeightMap& map, double tolerance, const DelaunayMeshOptions& options)
{
    check_size(map);
    if (!(tolerance >= 0))
        throw Error::Input(fmt::format("a tolerance of {} m: it has to be 0 or more", tolerance));
    if (!(options.max_edge >= 2))
        throw Error::Input(fmt::format("edges of at most {} samples: it has to be 2 or more", options.max_edge));
}

/// @throws Error::Input where a height is infinite
double greatest_height(const HeightMap& map)
{
    float greatest = 0;
    for (std::size_t i = 0; i < map.heights.size(); ++i) {
        const float height = std::abs(map.heights[i]);
        if (std::isinf(height))
            throw Error::Input(
                fmt::format("an infinite height at column {}, row {}", i % std::size_t(map.columns), i / std::size_t(map.columns)));
        greatest = std::max(greatest, std::isnan(height) ? 0.f : height);
    }
    return double(greatest);
}

/// A bit less than asked for, so that whoever computes the heights of triangles in another way finds the bound kept too.
double tolerance_with_rounding(double tolerance, double greatest)
{
    const double rounding = 16 * std::numeric_limits<double>::epsilon() * greatest;
    return std::max(0.0, tolerance - rounding);
}

/// Numbers the vertices that triangles use in the order of samples.
class MeshBuilder {
public:
    MeshBuilder(const HeightMap& map, const DelaunayTriangulation& triangulation) : map_(map), triangulation_(triangulation) {}
    Mesh build(std::vector<ivec2>* samples)
    {
        std::vector<std::uint32_t> kept;
        for (std::uint32_t t = 0; t < triangulation_.triangle_count(); ++t)
            if (triangulation_.has_triangle(t))
                kept.push_back(t);
        Mesh mesh;
        number_vertices(kept, mesh, samples);
        mesh.triangles.reserve(kept.size());
        for (const std::uint32_t t : kept)
            mesh.triangles.push_back({number(t * 3), number(t * 3 + 1), number(t * 3 + 2)});
        return mesh;
    }

private:
    std::uint32_t number(std::uint32_t half_edge) const { return numbers_[triangulation_.corner(half_edge)]; }
    void number_vertices(const std::vector<std::uint32_t>& kept, Mesh& mesh, std::vector<ivec2>* samples)
    {
        std::vector<std::uint32_t> used;
        std::vector<std::uint8_t> is_used(triangulation_.vertex_count());
        for (const std::uint32_t t : kept)
            for (std::uint32_t e = t * 3; e < t * 3 + 3; ++e)
                if (!std::exchange(is_used[triangulation_.corner(e)], std::uint8_t(1)))
                    used.push_back(triangulation_.corner(e));
        const auto sample_of = [&](std::uint32_t vertex) {
            return map_.index(triangulation_.point(vertex).x, triangulation_.point(vertex).y);
        };
        std::sort(used.begin(), used.end(), [&](std::uint32_t a, std::uint32_t b) { return sample_of(a) < sample_of(b); });
        numbers_.resize(triangulation_.vertex_count());
        mesh.positions.reserve(used.size());
        if (samples)
            samples->clear();
        for (const std::uint32_t vertex : used) {
            const ivec2& p = triangulation_.point(vertex);
            numbers_[vertex] = std::uint32_t(mesh.positions.size());
            mesh.positions.push_back(map_.position(p.x, p.y));
            if (samples)
                samples->push_back(p);
        }
    }

    const HeightMap& map_;
    const DelaunayTriangulation& triangulation_;
    std::vector<std::uint32_t> numbers_;
};

} // namespace

Mesh delaunay_mesh_within(const HeightMap& map, double tolerance, const DelaunayMeshOptions& options, std::vector<ivec2>* samples)
{
    check(map, tolerance, options);
    const DelaunayBound bound = {tolerance_with_rounding(tolerance, greatest_height(map)), options.max_edge};
    DelaunayTriangulation triangulation(map.columns, map.rows);
    insert_hole_borders(map, triangulation);
    refine_within(map, triangulation, bound);
    drop_triangles_without_data(map, triangulation);
    if (options.simplify) {
        simplify_within(map, triangulation, bound);
        flip_within(map, triangulation, bound);
    }
    return MeshBuilder(map, triangulation).build(samples);
}

} // namespace limn
