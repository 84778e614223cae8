#include "terrain_smooth.h"

#include <memory>

#include <fmt/format.h>

#include "console.h"
#include "limn/base/error.h"
#include "limn/terrain/surface_terrain.h"
#include "table_options.h"

using namespace limn;

namespace {

using Kind = TerrainSmooth::Kind;

const OptionTable<TerrainSmooth>& kind_table()
{
    static const OptionTable<TerrainSmooth> table = {
        choice_row<TerrainSmooth, Kind>("smooth", {{"none", Kind::none}, {"hermite", Kind::hermite}, {"c1", Kind::c1}, {"c2", Kind::c2}},
                                        "between samples: flat triangles, these bent by their normals, or surfaces through all samples with continuous slopes or curvature",
                                        &TerrainSmooth::kind),
    };
    return table;
}

bool has_surface(const TerrainSmooth& smooth) { return smooth.kind == Kind::c1 || smooth.kind == Kind::c2; }

Interpolant interpolant(const TerrainSmooth& smooth) { return smooth.kind == Kind::c1 ? Interpolant::c1 : Interpolant::c2; }

TerrainBound parse_error(const std::string& text)
{
    try {
        return parse_terrain_bound(text);
    } catch (const Error::Input&) {
        throw Error::Input(fmt::format("--smooth-error: '{}' is neither metres (0.5m) nor pixels (0.3px)", text));
    }
}

} // namespace

void add_terrain_smooth_options(CLI::App& app, TerrainSmooth& smooth)
{
    const std::string group = "Smoothing";
    add_table_options(app, kind_table(), smooth, group);
    app.add_option("--smooth-error", smooth.error, "hermite: how far edges may stay from their curves: metres (0.5m) or pixels (0.3px); default 0.3 times --max-error")
        ->type_name("X")
        ->group(group);
    add_table_options(app, smooth_terrain_option_table(), smooth.options, group);
    add_table_options(app, hermite_option_table(), smooth.options.hermite, group);
}

void check_terrain_smooth(const CLI::App& app, const TerrainSmooth& smooth)
{
    if (smooth.kind == Kind::hermite) {
        if (smooth.options.hermite.rule == HermiteRule::seed && app.count("--base") > 0)
            throw Error::Input("--base: --smooth-rule seed leaves vertices in the middle of sides, so that the mesh cannot be closed; leave one out");
        return;
    }
    std::vector<std::string> names = {"smooth-error"};
    for (const auto& row : smooth_terrain_option_table())
        names.push_back(row.name);
    for (const auto& row : hermite_option_table())
        names.push_back(row.name);
    for (const std::string& name : names)
        if (app.count("--" + name) > 0)
            throw Error::Input(fmt::format("--{} is for bent triangles; give --smooth hermite too", name));
}

bool smoothing_needs_camera(const TerrainSmooth& smooth) { return !smooth.error.empty() && parse_error(smooth.error).in_pixels; }

BuiltTerrain build_smooth_terrain(const TerrainSmooth& smooth, const HeightMap& map, const TerrainBuildOptions& options, const std::optional<Camera>& camera,
                                  std::vector<std::string>& notes)
{
    if (has_surface(smooth))
        return build_surface_terrain(HeightSurface(map, interpolant(smooth)), options, camera);
    BuiltTerrain built = build_terrain(map, options, camera);
    if (smooth.kind == Kind::none)
        return built;
    SmoothTerrainOptions chosen = smooth.options;
    if (!smooth.error.empty())
        chosen.error = parse_error(smooth.error);
    SmoothedTerrain made = smooth_terrain(map, built, options, chosen, camera);
    notes.push_back(fmt::format("{} smoothed to {:.4g} {}{}", counted(built.mesh.triangles.size(), "triangle"), made.error.value, made.error.in_pixels ? "px" : "m",
                                made.within_error ? "" : ", for which --smooth-passes did not suffice"));
    return std::move(made.terrain);
}

std::string measured_thing(const TerrainSmooth& smooth) { return has_surface(smooth) ? "point" : "sample"; }

GroundNormal ground_normal(const TerrainSmooth& smooth, const HeightMap& map)
{
    if (!has_surface(smooth))
        return [&map](const dvec3& place) { return terrain_normal(map, dvec2(place)); };
    const auto surface = std::make_shared<const HeightSurface>(map, interpolant(smooth));
    return [surface](const dvec3& place) { return surface->normal(dvec2(place)); };
}

nlohmann::ordered_json terrain_smooth_json(const TerrainSmooth& smooth)
{
    nlohmann::ordered_json json;
    for (const auto& row : kind_table())
        json[row.name] = row.get(smooth);
    if (smooth.kind != Kind::hermite)
        return json;
    json["smooth-error"] = smooth.error;
    for (const auto& row : smooth_terrain_option_table())
        json[row.name] = row.get(smooth.options);
    for (const auto& row : hermite_option_table())
        json[row.name] = row.get(smooth.options.hermite);
    return json;
}
