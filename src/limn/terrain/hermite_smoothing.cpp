#include "limn/terrain/hermite_smoothing.h"

#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/geometry/adjacency.h"
#include "limn/surface/neighbours.h"
#include "limn/terrain/hermite_pass.h"

namespace limn {
namespace {

constexpr std::size_t grain = 4096;
constexpr std::size_t most_triangles = 1'000'000'000; // sides are counted in 32 bits

void check(const Mesh& mesh, std::span<const dvec3> normals, const HermiteBound& bound, const HermiteOptions& options, const HermiteLimits& limits)
{
    if (!(bound.error > 0) || !std::isfinite(bound.error))
        throw Error::Input(fmt::format("smoothing to {}: it has to be above 0", bound.error));
    if (!(options.tangents >= 0 && options.tangents <= 1))
        throw Error::Input(fmt::format("--lt: {} is out of range 0..1", options.tangents));
    if (options.passes < 0)
        throw Error::Input(fmt::format("--smooth-passes: {} is below 0", options.passes));
    const std::size_t n = mesh.triangles.size();
    if (normals.size() != mesh.positions.size() || (!limits.straight.empty() && limits.straight.size() != n) || (!limits.vertical.empty() && limits.vertical.size() != n))
        throw Error::Input(fmt::format("{} vertices and {} triangles with {} normals and limits of {} and {} triangles", mesh.positions.size(), n, normals.size(),
                                       limits.straight.size(), limits.vertical.size()));
}

void check_size(std::size_t triangles)
{
    if (triangles > most_triangles)
        throw Error::Input(fmt::format("smoothing makes more than {} triangles; allow a larger error", most_triangles));
}

HermiteMesh start_from(const Mesh& mesh, std::span<const dvec3> normals, const HermiteLimits& limits)
{
    HermiteMesh out = {mesh.positions, {normals.begin(), normals.end()}, {}, mesh.triangles, {}, limits.straight, limits.vertical};
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
        out.parents.emplace_back(v, v);
    out.faces.resize(mesh.triangles.size());
    std::iota(out.faces.begin(), out.faces.end(), 0u);
    out.straight.resize(mesh.triangles.size(), 0);
    return out;
}

template <class T> std::vector<T> picked(const std::vector<T>& of_faces, const std::vector<std::uint32_t>& faces)
{
    std::vector<T> out(of_faces.empty() ? 0 : faces.size());
    parallel_each(out.size(), grain, [&](std::size_t i) { out[i] = of_faces[faces[i]]; });
    return out;
}

/// Colours of new vertices are between those of their parents, which are before them.
std::vector<vec4> mixed_colours(std::vector<vec4> colours, const std::vector<glm::uvec2>& parents)
{
    if (colours.empty())
        return colours;
    for (std::size_t v = colours.size(); v < parents.size(); ++v)
        colours.push_back(0.5f * (colours[parents[v].x] + colours[parents[v].y]));
    return colours;
}

Mesh finished(const Mesh& from, const HermiteMesh& made)
{
    Mesh mesh;
    mesh.positions = made.positions;
    mesh.triangles = made.triangles;
    mesh.corner_normals.resize(3 * made.triangles.size());
    parallel_each(mesh.corner_normals.size(), grain, [&](std::size_t i) { mesh.corner_normals[i] = vec3(made.normals[made.triangles[i / 3][int(i % 3)]]); });
    mesh.colours = mixed_colours(from.colours, made.parents);
    mesh.face_groups = picked(from.face_groups, made.faces);
    mesh.face_numbers = picked(from.face_numbers, made.faces);
    mesh.group_names = from.group_names;
    return mesh;
}

/// Moves what the corners of a triangle have, so that corner `first` becomes the first one.
template <class T> void turn(T* corners, int first) { std::rotate(corners, corners + first, corners + 3); }

/// The corner opposite to the longest side.
int apex_of(const Mesh& mesh, const uvec3& t)
{
    const auto square = [&](int i) { // of the side opposite to corner i
        const dvec3 side = mesh.positions[t[(i + 1) % 3]] - mesh.positions[t[(i + 2) % 3]];
        return glm::dot(side, side);
    };
    int apex = 0;
    for (int i = 1; i < 3; ++i)
        if (square(i) > square(apex))
            apex = i;
    return apex;
}

} // namespace

const OptionTable<HermiteOptions>& hermite_option_table()
{
    using Options = HermiteOptions;
    static const OptionTable<Options> table = {
        choice_row<Options, HermiteRule>("smooth-rule", {{"repaired", HermiteRule::repaired}, {"seed", HermiteRule::seed}},
                                         "which edges are bent: as published (seed), or with tests at their quarters and in all triangles of an edge", &Options::rule),
        number_row("lt", "", 0, 1, "weight of the tangents that edges follow at their ends; published: 0.5", &Options::tangents),
        choice_row<Options, Reclassify>("reclassify", {{"first", Reclassify::first}, {"every", Reclassify::every}}, "passes that look for S-shaped edges; published: first",
                                        &Options::reclassify),
        number_row("smooth-passes", "", 0, 30, "at most so many passes", &Options::passes),
    };
    return table;
}

SmoothedMesh smooth_with_normals(const Mesh& mesh, std::span<const dvec3> normals, const HermiteBound& bound, const HermiteOptions& options, const HermiteLimits& limits)
{
    check(mesh, normals, bound, options, limits);
    check_size(mesh.triangles.size());
    HermiteMesh made = start_from(mesh, normals, limits);
    const HermiteMeasure measure(bound);
    SmoothedMesh out;
    for (int pass = 0;; ++pass) {
        const HermitePass kind = {pass == 0 || options.reclassify == Reclassify::every, pass < options.passes};
        const bool far = split_once(made, measure, options, kind);
        check_size(made.triangles.size());
        out.within_bound = !far;
        if (!far || !kind.splits)
            break;
        out.triangles.push_back(made.triangles.size());
    }
    out.mesh = finished(mesh, made);
    out.normals = std::move(made.normals);
    out.straight = std::move(made.straight);
    return out;
}

SmoothedMesh smooth_mesh(Mesh mesh, const HermiteBound& bound, const HermiteOptions& options)
{
    mesh = with_longest_sides_last(std::move(mesh));
    const std::vector<dvec3> normals = area_normals(mesh.positions, mesh.triangles, build_vertex_faces(mesh.triangles, mesh.positions.size()));
    return smooth_with_normals(mesh, normals, bound, options);
}

Mesh with_longest_sides_last(Mesh mesh)
{
    parallel_each(mesh.triangles.size(), grain, [&](std::size_t i) {
        uvec3& t = mesh.triangles[i];
        const int first = apex_of(mesh, t);
        turn(&t.x, first);
        if (!mesh.corner_normals.empty())
            turn(&mesh.corner_normals[3 * i], first);
        if (!mesh.corner_uvs.empty())
            turn(&mesh.corner_uvs[3 * i], first);
    });
    return mesh;
}

} // namespace limn
