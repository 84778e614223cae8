#include "limn/terrain/terrain_build.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/terrain/bisection.h"
#include "limn/terrain/delaunay_mesh.h"
#include "limn/terrain/length_test.h"
#include "limn/terrain/nested_errors.h"
#include "limn/terrain/par.h"
#include "limn/terrain/terrain_mesh.h"
#include "limn/terrain/terrain_view.h"

namespace limn {
namespace {

constexpr double share_of_relief = 1.0 / 500;

double relief(const HeightMap& map)
{
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const float height : map.heights)
        if (!std::isnan(height))
            low = std::min(low, double(height)), high = std::max(high, double(height));
    return low <= high ? high - low : 0;
}

Mesh mesh_within(const HeightMap& map, const NestedErrors& errors, const LengthTest& is_too_long, double tolerance)
{
    return terrain_mesh(map, errors.lattice,
                        find_leaves(errors.lattice, [&](const BisectionTriangle& t) { return double(errors.error(t.middle())) > tolerance || is_too_long(t); }));
}

/// The least tolerance with a mesh of at most so many triangles, or the greatest of all where there is none: found among all floats, whose bits
/// are in the order of their values.
float tolerance_for(const HeightMap& map, const NestedErrors& errors, const LengthTest& is_too_long, std::size_t most)
{
    std::uint32_t low = 0, high = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::max()); // the answer is in [low, high]
    while (low < high) {
        const std::uint32_t middle = low + (high - low) / 2;
        if (mesh_within(map, errors, is_too_long, double(std::bit_cast<float>(middle))).triangles.size() <= most)
            high = middle;
        else
            low = middle + 1;
    }
    return std::bit_cast<float>(low);
}

Mesh par_mesh(const HeightMap& map, const TerrainBound& bound, double exaggerate, const std::optional<Camera>& camera)
{
    const Lattice whole = make_lattice(map.columns, map.rows), lattice = make_lattice(map.columns, map.rows, std::max(0, whole.level - 4));
    const EdgeTest test = bound.in_pixels ? screen_height_test(map, *camera, bound.value) : middle_height_test(map, bound.value * exaggerate);
    return terrain_mesh(map, lattice, refine_in_parallel(lattice, root_triangles(lattice), test).triangles);
}

Mesh strict_mesh(const HeightMap& map, const TerrainBuildOptions& options, TerrainBound& bound, const std::optional<Camera>& camera)
{
    const NestedErrors errors = nest_errors(map, {.ranges = bound.in_pixels});
    const LengthTest is_too_long(map, options.max_edge);
    if (options.triangles > 0) {
        bound = {double(tolerance_for(map, errors, is_too_long, options.triangles)) / options.exaggerate, false};
        Mesh mesh = mesh_within(map, errors, is_too_long, bound.value * options.exaggerate);
        if (mesh.triangles.size() > options.triangles)
            throw Error::Input(fmt::format("--triangles {}: the coarsest mesh of this map has {}", options.triangles, mesh.triangles.size()));
        return mesh;
    }
    if (!bound.in_pixels)
        return mesh_within(map, errors, is_too_long, bound.value * options.exaggerate);
    const ViewTest in_view(map, errors, *camera, {.pixels = bound.value});
    return terrain_mesh(map, errors.lattice, find_leaves(errors.lattice, [&](const BisectionTriangle& t) { return in_view(t) || is_too_long(t); }));
}

Mesh make_mesh(const HeightMap& map, const TerrainBuildOptions& options, TerrainBound& bound, const std::optional<Camera>& camera)
{
    switch (options.method) {
    case TerrainMethod::par: return par_mesh(map, bound, options.exaggerate, camera);
    case TerrainMethod::delaunay: {
        DelaunayMeshOptions mesh;
        if (options.max_edge > 0)
            mesh.max_edge = std::max(2.0, options.max_edge / std::max(map.spacing.x, map.spacing.y));
        return delaunay_mesh_within(map, bound.value * options.exaggerate, mesh);
    }
    case TerrainMethod::strict: break;
    }
    return strict_mesh(map, options, bound, camera);
}

void check(const TerrainBuildOptions& options, const TerrainBound& bound, bool has_camera)
{
    if (!(bound.value >= 0) || !std::isfinite(bound.value))
        throw Error::Input(fmt::format("--max-error: {} is no bound; it has to be 0 or more", bound.value));
    if (bound.in_pixels && !has_camera)
        throw Error::Input("--max-error: pixels need a camera");
    if (bound.in_pixels && options.method == TerrainMethod::delaunay)
        throw Error::Input("--max-error: --method delaunay has bounds in metres only");
    if (options.triangles > 0 && options.method != TerrainMethod::strict)
        throw Error::Input("--triangles goes with --method strict only");
    if (options.triangles > 0 && options.bound)
        throw Error::Input("--triangles and --max-error both say how fine the mesh gets; leave one out");
    if (options.max_edge > 0 && options.method == TerrainMethod::par)
        throw Error::Input("--max-edge goes with --method strict or delaunay");
}

} // namespace

TerrainBound parse_terrain_bound(std::string_view text)
{
    std::string_view number = text;
    TerrainBound bound;
    if (number.ends_with("px")) {
        bound.in_pixels = true;
        number.remove_suffix(2);
    } else if (number.ends_with("m")) {
        number.remove_suffix(1);
    }
    while (number.ends_with(' '))
        number.remove_suffix(1);
    try {
        bound.value = parse_number("max-error", number);
    } catch (const Error::Input&) {
        throw Error::Input(fmt::format("--max-error: '{}' is neither metres (5m) nor pixels (1px)", text));
    }
    if (bound.value < 0)
        throw Error::Input(fmt::format("--max-error: {} is below 0", text));
    return bound;
}

const OptionTable<TerrainBuildOptions>& terrain_build_option_table()
{
    using Options = TerrainBuildOptions;
    static const OptionTable<Options> table = {
        choice_row<Options, TerrainMethod>("method", {{"strict", TerrainMethod::strict}, {"delaunay", TerrainMethod::delaunay}, {"par", TerrainMethod::par}},
                                           "bisection with a true bound, the fewest triangles for files, or parallel refinement as published, whose bound is not one",
                                           &Options::method),
        number_row("triangles", "", 0, 1e9, "instead of a bound: the smallest one with at most so many triangles; 0: --max-error", &Options::triangles),
        number_row("max-edge", "m", 0, 1e9, "no triangle is longer in the plane; 0: any length", &Options::max_edge),
        number_row("exaggerate", "", 1e-3, 1e3, "heights are multiplied by this; bounds stay true metres", &Options::exaggerate),
    };
    return table;
}

TerrainBound usual_bound(const HeightMap& map, double exaggerate) { return {relief(map) / exaggerate * share_of_relief, false}; }

HeightMap exaggerated(HeightMap map, double factor)
{
    if (!(factor > 0 && std::isfinite(factor)))
        throw Error::Input(fmt::format("--exaggerate: {} is not above 0", factor));
    if (factor != 1)
        for (float& height : map.heights)
            height = float(double(height) * factor);
    return map;
}

BuiltTerrain build_terrain(const HeightMap& map, const TerrainBuildOptions& options, const std::optional<Camera>& camera)
{
    BuiltTerrain built;
    built.asked = options.bound.value_or(usual_bound(map, options.exaggerate));
    check(options, built.asked, camera.has_value());
    built.mesh = make_mesh(map, options, built.asked, camera);
    measure_built(map, built, options.exaggerate, camera);
    return built;
}

void measure_built(const HeightMap& map, BuiltTerrain& built, double exaggerate, const std::optional<Camera>& camera)
{
    if (built.asked.in_pixels) {
        built.measured = measure_terrain(map, built.mesh, built.asked.value, camera, ViewTolerance().nearest);
    } else {
        built.measured = measure_terrain(map, built.mesh, built.asked.value * exaggerate);
        built.measured.maximum /= exaggerate, built.measured.rms /= exaggerate;
    }
}

} // namespace limn
