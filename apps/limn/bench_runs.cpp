#include "bench_runs.h"

#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "console.h"
#include "limn/base/error.h"
#include "limn/drawing/write_drawing.h"
#include "limn/geometry/read_mesh.h"
#include "limn/geometry/write_mesh.h"
#include "limn/lines/draw.h"
#include "limn/lines/prepare.h"
#include "limn/surface/shapes.h"
#include "process_output.h"
#include "scratch_folder.h"

using namespace limn;

namespace {

Mesh shape_of(const std::string& name, std::size_t triangles)
{
    ShapeOptions options;
    options.name = name;
    options.triangles = triangles;
    return make_shape(options).mesh;
}

/// Peak memory of `limn draw FILE`, bytes.
double peak_of_drawing(const std::filesystem::path& file)
{
    const std::string command = fmt::format("'{}' draw '{}' -o '{}.svg' --json --quiet", std::filesystem::read_symlink("/proc/self/exe").string(),
                                            file.string(), file.string());
    const auto report = nlohmann::json::parse(output_of(command), nullptr, false);
    if (!report.is_object() || !report.contains("peak_memory"))
        throw Error::Device("a run whose memory is measured failed: " + command);
    return report["peak_memory"];
}

} // namespace

RunTimes time_run(const std::string& shape, std::size_t triangles)
{
    const ScratchFolder folder;
    write_mesh(shape_of(shape, triangles), folder / "model.ply");
    RunTimes times;
    Stopwatch watch;
    Mesh mesh = read_mesh(folder / "model.ply");
    times.read = watch.lap();
    const Bounds bounds = mesh.bounds();
    const PreparedMesh prepared = prepare_mesh(std::move(mesh));
    times.surface = watch.lap();
    const PlacedSurface placed = prepared.placed();
    const LineModel model = build_line_model({&placed, 1});
    times.merge = watch.lap();
    const RayScene rays = build_ray_scene(model);
    times.rays = watch.lap();
    const Drawing drawing = draw_lines(model, rays, Camera::framing(bounds), {});
    times.draw = watch.lap();
    write_drawing(drawing, {}, (folder / "model.svg").string(), "svg");
    times.write = watch.lap();
    return times;
}

RunMemory measure_memory(const std::string& shape, std::size_t triangles)
{
    const ScratchFolder folder;
    const Mesh mesh = shape_of(shape, triangles), tiny = shape_of(shape, 100);
    const auto measure = [&](const char* name) {
        const std::filesystem::path file = folder / name;
        write_mesh(tiny, file);
        const double start = peak_of_drawing(file);
        write_mesh(mesh, file);
        return (peak_of_drawing(file) - start - double(std::filesystem::file_size(file))) / double(mesh.triangles.size());
    };
    return {measure("model.ply"), measure("model.stl"), measure("model.obj")};
}
