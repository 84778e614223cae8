#include "limn/terrain/smooth_terrain.h"

#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/formulas/formulas.h"
#include "limn/surface/neighbours.h"
#include "limn/terrain/edge_table.h"
#include "limn/terrain/lattice.h"
#include "limn/terrain/terrain_view.h"
#include "limn/terrain/triangle_scan.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1024;
constexpr double share_of_bound = 0.3;

/// The samples that a triangle's corners stand over.
struct Corners {
    ivec2 p[3];
};
Corners corners_of(const HeightMap& map, const Mesh& mesh, const uvec3& t)
{
    Corners corners;
    for (int i = 0; i < 3; ++i) {
        const dvec3& p = mesh.positions[t[i]];
        corners.p[i] = {int(std::lround(p.x / map.spacing.x)), map.rows - 1 - int(std::lround(p.y / map.spacing.y))};
    }
    return corners;
}

/// Longest sides in the plane come last, where right-isosceles triangles have their hypotenuses.
Mesh with_hypotenuses_last(const Mesh& mesh)
{
    Mesh flat = mesh;
    for (dvec3& p : flat.positions)
        p.z = 0;
    flat = with_longest_sides_last(std::move(flat));
    flat.positions = mesh.positions;
    return flat;
}

/// Of faces around each vertex; along the map's border they do not lean across it, so that curves stay over it.
std::vector<dvec3> normals_of(const HeightMap& map, const Mesh& mesh)
{
    std::vector<dvec3> normals = area_normals(mesh.positions, mesh.triangles, build_vertex_faces(mesh.triangles, mesh.positions.size()));
    const dvec2 size = dvec2(map.columns - 1, map.rows - 1) * map.spacing;
    const auto is_at = [](double place, double end) { return std::abs(place) < 1e-9 * end || std::abs(place - end) < 1e-9 * end; };
    parallel_each(normals.size(), grain, [&](std::size_t v) {
        dvec3& n = normals[v];
        if (is_at(mesh.positions[v].x, size.x))
            n.x = 0;
        if (is_at(mesh.positions[v].y, size.y))
            n.y = 0;
        const double length = glm::length(n);
        n = length > 0 ? n / length : n;
    });
    return normals;
}

/// Pick's theorem: whether a triangle has samples inside, those on its border left out.
bool has_samples_inside(const Corners& c)
{
    const ivec2 u = c.p[1] - c.p[0], v = c.p[2] - c.p[0];
    const std::int64_t area2 = std::abs(std::int64_t(u.x) * v.y - std::int64_t(u.y) * v.x);
    std::int64_t border = 0;
    for (int i = 0; i < 3; ++i) {
        const ivec2 side = c.p[(i + 1) % 3] - c.p[i];
        border += std::gcd(side.x, side.y);
    }
    return area2 - border + 2 > 0;
}

/// What stays straight so that no sample moves: sides that have samples on them, and triangles that have some inside, whole.
std::vector<std::uint8_t> straight_sides(const HeightMap& map, const Mesh& mesh)
{
    std::vector<std::uint8_t> straight(mesh.triangles.size());
    parallel_each(straight.size(), grain, [&](std::size_t i) {
        const Corners c = corners_of(map, mesh, mesh.triangles[i]);
        unsigned sides = has_samples_inside(c) ? 15u : 0u;
        for (unsigned k = 0; k < 3; ++k) {
            const glm::uvec2 ends = corners_of_side(k);
            if (can_split(c.p[ends.x], c.p[ends.y]))
                sides |= 1u << k;
        }
        straight[i] = std::uint8_t(sides);
    });
    return straight;
}

/// Metres up or down that are sure not to be more than a tolerance in the picture, from anywhere near a triangle.
class PixelRoom {
public:
    PixelRoom(const Camera& camera, double pixels)
        : camera_{camera.right(), camera.above(), camera.forward(), camera.pixels_per_unit(1), ViewTolerance().nearest, camera.orthographic ? 1.0 : 0.0}, eye_(camera.eye),
          pixels_(pixels)
    {
    }
    double metres(const dvec3& low, const dvec3& high) const
    {
        const double first = room(low, high);
        const dvec3 out(0, 0, first); // what is that far away has to be in the box
        return std::min(first, room(low - out, high + out));
    }

private:
    double room(const dvec3& low, const dvec3& high) const
    {
        return pixels_ / formulas::height_error_bound(camera_, 0.5 * (low + high) - eye_, 0.5 * (high - low), 1.0, 1e-9);
    }
    formulas::BoundCamera camera_;
    dvec3 eye_;
    double pixels_;
};

/// How far each triangle may move: what the bound leaves of the error at its samples.
std::vector<double> rooms(const HeightMap& map, const Mesh& mesh, const TerrainBound& bound, double exaggerate, const std::optional<Camera>& camera)
{
    constexpr double less = 1 - 1e-6; // against rounding
    std::optional<PixelRoom> picture;
    if (bound.in_pixels)
        picture.emplace(*camera, bound.value);
    std::vector<double> out(mesh.triangles.size());
    parallel_each(out.size(), grain, [&](std::size_t i) {
        const uvec3& t = mesh.triangles[i];
        const Corners c = corners_of(map, mesh, t);
        double off = 0;
        SampledTriangle(map, c.p[0], c.p[1], c.p[2]).find_worst(off);
        const dvec3 &p = mesh.positions[t.x], &q = mesh.positions[t.y], &r = mesh.positions[t.z];
        const double most = picture ? picture->metres(glm::min(p, glm::min(q, r)), glm::max(p, glm::max(q, r))) : bound.value * exaggerate;
        out[i] = std::max(0.0, most * less - off);
    });
    return out;
}

HermiteLimits limits_for(const HeightMap& map, const BuiltTerrain& built, const Mesh& mesh, double exaggerate, BentEdges edges, const std::optional<Camera>& camera)
{
    switch (edges) {
    case BentEdges::all: return {};
    case BentEdges::terminal: return {straight_sides(map, mesh), std::vector<double>(mesh.triangles.size(), std::numeric_limits<double>::infinity())};
    case BentEdges::clamp: break;
    }
    return {{}, rooms(map, mesh, built.asked, exaggerate, camera)};
}

TerrainBound error_for(const BuiltTerrain& built, const SmoothTerrainOptions& smooth, bool has_camera)
{
    const TerrainBound error = smooth.error.value_or(TerrainBound{share_of_bound * built.asked.value, built.asked.in_pixels});
    if (!(error.value > 0) || !std::isfinite(error.value))
        throw Error::Input(fmt::format("--smooth-error: {} is not above 0", error.value));
    if ((error.in_pixels || built.asked.in_pixels) && !has_camera)
        throw Error::Input("--smooth-error: pixels need a camera");
    return error;
}

} // namespace

const OptionTable<SmoothTerrainOptions>& smooth_terrain_option_table()
{
    static const OptionTable<SmoothTerrainOptions> table = {
        choice_row<SmoothTerrainOptions, BentEdges>("smooth-edges", {{"clamp", BentEdges::clamp}, {"terminal", BentEdges::terminal}, {"all", BentEdges::all}},
                                                    "which edges bend: all as far as --max-error lets them, those between neighbouring samples, or all as published",
                                                    &SmoothTerrainOptions::edges),
    };
    return table;
}

SmoothedTerrain smooth_terrain(const HeightMap& map, const BuiltTerrain& built, const TerrainBuildOptions& options, const SmoothTerrainOptions& smooth,
                               const std::optional<Camera>& camera)
{
    SmoothedTerrain out = {built, error_for(built, smooth, camera.has_value())};
    const HermiteBound bound = {out.error.in_pixels ? out.error.value : out.error.value * options.exaggerate, out.error.in_pixels ? camera : std::nullopt};
    const Mesh mesh = with_hypotenuses_last(built.mesh);
    SmoothedMesh made = smooth_with_normals(mesh, normals_of(map, mesh), bound, smooth.hermite, limits_for(map, built, mesh, options.exaggerate, smooth.edges, camera));
    out.terrain.mesh = std::move(made.mesh);
    out.within_error = made.within_bound;
    measure_built(map, out.terrain, options.exaggerate, camera);
    return out;
}

} // namespace limn
