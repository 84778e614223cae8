#include "terrain_pyramid.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "console.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/drawing/png.h"
#include "limn/geometry/write_mesh.h"
#include "limn/scene/pyramid_normals.h"
#include "limn/scene/unmet_marks.h"
#include "limn/terrain/measure_terrain.h"
#include "limn/terrain/pyramid_leaves.h"
#include "limn/terrain/terrain_pyramid_view.h"
#include "peak_memory.h"
#include "terrain_output.h"

using namespace limn;

namespace {

constexpr std::size_t tile_budget = std::size_t(96) << 20, picture_budget = std::size_t(64) << 20;

bool is_picture(const Output& output) { return output.format == "png"; }

void check(const PyramidCommand& command, const std::vector<Output>& outputs)
{
    if (command.build.method != TerrainMethod::strict)
        throw Error::Input("--method: of a pyramid there is strict only; delaunay and par need a whole height map in memory");
    if (command.build.triangles > 0)
        throw Error::Input("--triangles: of a pyramid, say --max-error");
    if (command.tile_memory > 0 && (outputs.empty() || !std::all_of(outputs.begin(), outputs.end(), is_picture)))
        throw Error::Input("--tile-memory is for pictures; a mesh in a file keeps its bound everywhere");
    if (command.tile_memory > 0 && command.error_report)
        throw Error::Input("--tile-memory: where the bound is not kept is marked in the picture; leave --error-report out");
    if (command.tile_memory > 0 && command.build.max_edge > 0)
        throw Error::Input("--tile-memory: with --max-edge a picture needs all the tiles it needs; leave one of them out");
    for (const Output& output : outputs)
        if (!is_picture(output) && output.format != "ply" && output.format != "obj" && output.format != "stl" && output.format != "glb")
            throw Error::Input(fmt::format(
                "-o {}: of a pyramid there are png, ply, obj, stl and glb; a drawing needs a whole height map in memory", output.path));
}

/// What was made for one kind of output.
struct Made {
    BuiltTerrain terrain; ///< measured where that was asked for
    std::vector<std::string> paths;
};

class Maker {
public:
    Maker(const PyramidCommand& command, const std::vector<Output>& outputs)
        : command_(command), outputs_(outputs), pyramid_(command.file), tiles_(pyramid_, tile_budget)
    {
        if (!command.max_error.empty())
            bound_ = parse_terrain_bound(command.max_error);
        else if (command.build.bound)
            bound_ = command.build.bound;
        if (std::any_of(outputs.begin(), outputs.end(), is_picture) || (bound_ && bound_->in_pixels))
            camera_ = place_camera();
    }
    const TerrainPyramid& pyramid() const { return pyramid_; }
    const std::optional<Camera>& camera() const { return camera_; }
    /// A warning where tiles that were not allowed in memory are missing.
    const std::string& unmet_fault() const { return unmet_fault_; }
    std::vector<Made> make()
    {
        std::vector<Made> all;
        for (const bool pictures : {true, false}) {
            std::vector<Output> mine;
            std::copy_if(outputs_.begin(), outputs_.end(), std::back_inserter(mine),
                         [&](const Output& output) { return is_picture(output) == pictures; });
            if (mine.empty() && (pictures || !outputs_.empty()))
                continue; // without outputs, the mesh is made all the same
            if (all.empty() || !bound_)
                all.push_back({built(pictures), {}});
            for (const Output& output : mine) {
                write(all.back().terrain.mesh, output);
                all.back().paths.push_back(output.path);
            }
        }
        return all;
    }
    /// A warning where the eye is under the ground.
    std::optional<std::string> eye_fault()
    {
        const HeightMap& frame = pyramid_.frame();
        const dvec2 at = {camera_->eye.x / frame.spacing.x, double(frame.rows - 1) - camera_->eye.y / frame.spacing.y};
        if (camera_->orthographic || !(at.x >= 0 && at.y >= 0 && at.x <= frame.columns - 1 && at.y <= frame.rows - 1))
            return {};
        const ivec2 sample(at + 0.5);
        const int cells = pyramid_.layout().tile_cells();
        const TileId tile = {0, glm::min(sample / cells, pyramid_.layout().tiles(0) - 1)};
        const double ground = command_.build.exaggerate * double(tiles_.get(tile)->height(sample));
        if (!(camera_->eye.z < ground))
            return {};
        return fmt::format("the eye is {:.6g} m under the ground", ground - camera_->eye.z);
    }

private:
    double relief() const { return double(pyramid_.highest()) - double(pyramid_.lowest()); }
    Mesh mesh(const PyramidTest& test) { return pyramid_mesh(pyramid_, pyramid_leaves(tiles_, test), command_.build.exaggerate); }
    Camera place_camera() { return place_terrain_camera(command_.view, coarse_pyramid_mesh(tiles_, command_.build.exaggerate)).cameras.front(); }
    /// What a view that may hold so many tiles shows once they have arrived.
    Mesh mesh_within_memory(const TerrainBound& asked)
    {
        if (!asked.in_pixels)
            throw Error::Input("--tile-memory: tiles are chosen by what they show; say --max-error in pixels");
        tiles_.clear();
        TerrainPyramidView view(pyramid_, {.budget = std::size_t(command_.tile_memory * (1 << 20)), .exaggerate = command_.build.exaggerate});
        const TerrainPyramidView::Frame& frame = view.finish(*camera_, {.pixels = asked.value});
        if (!frame.is_met()) {
            std::vector<PyramidLeaf> unmet;
            for (const std::uint32_t number : frame.unmet)
                unmet.push_back(frame.leaves[number]);
            marks_.emplace(pyramid_mesh(pyramid_, unmet, command_.build.exaggerate));
            unmet_fault_ = fmt::format("{} of {} triangles may be off by more than {:.4g} px, for want of tiles: give --tile-memory more than {:.4g} MB", with_thousands(unmet.size()),
                                       with_thousands(frame.leaves.size()), asked.value, command_.tile_memory);
            if (command_.common.strict)
                throw Error::Read(fmt::format("{}: {} (--strict)", command_.file, unmet_fault_));
        }
        return pyramid_mesh(pyramid_, frame.leaves, command_.build.exaggerate);
    }
    BuiltTerrain built(bool for_picture)
    {
        const TerrainBuildOptions& options = command_.build;
        BuiltTerrain built;
        built.asked = bound_ ? *bound_ : for_picture ? TerrainBound{1, true} : TerrainBound{relief() / 500, false};
        const double metres = built.asked.value * options.exaggerate;
        if (command_.tile_memory > 0)
            built.mesh = mesh_within_memory(built.asked);
        else
            built.mesh =
                mesh(built.asked.in_pixels ? view_test(pyramid_, *camera_, {.pixels = built.asked.value}, options.max_edge, options.exaggerate)
                                           : metric_test(pyramid_, metres, options.max_edge, options.exaggerate));
        if (!command_.error_report)
            return built;
        const HeightRows rows = rows_of(pyramid_);
        if (built.asked.in_pixels) {
            built.measured = measure_terrain(rows, built.mesh, built.asked.value, camera_, ViewTolerance().nearest, options.exaggerate);
        } else {
            built.measured = measure_terrain(rows, built.mesh, metres, {}, ViewTolerance().nearest, options.exaggerate);
            built.measured.maximum /= options.exaggerate, built.measured.rms /= options.exaggerate;
        }
        return built;
    }
    void write(const Mesh& mesh, const Output& output)
    {
        if (!is_picture(output)) {
            write_mesh(for_file(mesh, command_.print_size, command_.base), output.path,
                       {.format = output.format, .double_positions = command_.double_positions});
            return;
        }
        tiles_.clear();
        TileCache heights(pyramid_, picture_budget, TileParts::heights);
        const PyramidNormals normals(heights, *camera_, command_.build.exaggerate);
        const GroundColour colour = marks_ ? GroundColour([&](const dvec3& place) { return marks_->colour(place); }) : GroundColour();
        write_file(output.path,
                   encode_png(paint_terrain([&](const dvec3& place) { return normals(place); }, mesh, *camera_, command_.picture, colour), {}));
    }

    const PyramidCommand& command_;
    const std::vector<Output>& outputs_;
    TerrainPyramid pyramid_;
    TileCache tiles_;
    std::optional<TerrainBound> bound_;
    std::optional<Camera> camera_;
    std::optional<UnmetMarks> marks_;
    std::string unmet_fault_;
};

/// @param marked  whether triangles that may break the bound are marked in the picture
std::string what_was_built(const BuiltTerrain& terrain, bool measured, bool marked)
{
    const std::string unit = unit_of(terrain.asked), triangles = counted(terrain.mesh.triangles.size(), "triangle");
    if (marked)
        return fmt::format("{} within {:.4g} {} where it is not marked", triangles, terrain.asked.value, unit);
    if (!measured)
        return fmt::format("{} within {:.4g} {} (--error-report measures it)", triangles, terrain.asked.value, unit);
    return fmt::format("{}, at most {:.4g} {} off at {} ({:.4g} {} asked)", triangles, terrain.measured.maximum, unit,
                       counted(terrain.measured.samples, "sample"), terrain.asked.value, unit);
}

nlohmann::ordered_json mesh_json(const Made& made, bool measured)
{
    const MeasuredTerrain& m = made.terrain.measured;
    nlohmann::ordered_json error = {{"unit", unit_of(made.terrain.asked)}, {"asked", made.terrain.asked.value}};
    if (measured)
        error.update({{"maximum", m.maximum}, {"rms", m.rms}, {"samples", m.samples}, {"over", m.over}, {"without_mesh", m.bare}});
    return {{"outputs", made.paths},
            {"vertices", made.terrain.mesh.positions.size()},
            {"triangles", made.terrain.mesh.triangles.size()},
            {"error", error}};
}

std::string report(const PyramidCommand& command, const Maker& maker, const std::vector<Made>& all,
                   const std::vector<std::string>& warnings, double seconds)
{
    const TerrainPyramid& pyramid = maker.pyramid();
    const HeightMap& frame = pyramid.frame();
    nlohmann::ordered_json json = {{"limn", LIMN_VERSION}, {"command", "terrain"}, {"file", command.file}};
    json["columns"] = frame.columns, json["rows"] = frame.rows;
    json["spacing"] = {frame.spacing.x, frame.spacing.y};
    json["origin"] = {frame.origin.x, frame.origin.y};
    json["system"] = frame.system;
    json["tiles"] = {{"all", pyramid.layout().tile_count()}, {"read", pyramid.tiles_read()}};
    json["options"] = {{"max-edge", command.build.max_edge}, {"exaggerate", command.build.exaggerate}};
    if (maker.camera())
        json["camera"] = nlohmann::ordered_json::parse(camera_to_json(*maker.camera()));
    json["meshes"] = nlohmann::ordered_json::array();
    for (const Made& made : all)
        json["meshes"].push_back(mesh_json(made, command.error_report));
    json["warnings"] = warnings;
    json["peak_memory"] = peak_memory();
    json["seconds"] = {{"total", seconds}};
    return json.dump(2) + "\n";
}

} // namespace

void run_terrain_pyramid(const PyramidCommand& command, const std::vector<Output>& outputs)
{
    const Stopwatch watch;
    check(command, outputs);
    Console console(command.common.quiet);
    console.progress("refining", 0);
    Maker maker(command, outputs);
    Warnings warnings;
    if (maker.camera())
        if (const std::optional<std::string> fault = maker.eye_fault())
            warnings.add(command.file, {*fault});
    if (command.common.strict && !warnings.empty())
        throw Error::Read(warnings.line() + " (--strict)");
    const std::vector<Made> all = maker.make();
    if (!maker.unmet_fault().empty())
        warnings.add(command.file, {maker.unmet_fault()});
    if (command.common.json)
        write_file("-", report(command, maker, all, warnings.all(), watch.total()));
    if (!warnings.empty())
        console.warn(warnings.line());
    std::vector<std::string> built;
    std::transform(all.begin(), all.end(), std::back_inserter(built),
                   [&](const Made& made) { return what_was_built(made.terrain, command.error_report, !maker.unmet_fault().empty()); });
    if (command.error_report && !command.common.json)
        for (const Made& made : all)
            write_file("-", error_lines(made.terrain));
    const std::string written = command.common.outputs.empty() ? "measured " + command.file : what_was_written(command.common.outputs);
    console.finish(fmt::format("{}: {}; {} of {} tiles read, {}", written, join(built, "; "), with_thousands(maker.pyramid().tiles_read()),
                               with_thousands(maker.pyramid().layout().tile_count()), seconds_text(watch.total())));
}
