#include "models.h"

#include <algorithm>
#include <filesystem>
#include <numeric>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/parallel.h"
#include "limn/geometry/diagnose.h"
#include "limn/geometry/read_mesh.h"
#include "limn/geometry/unpaired_edges.h"

using namespace limn;

namespace {

/// @param tell  tell(what, part of this file's work)
template <class Tell> PreparedMesh load(const std::string& file, const ModelOptions& options, Input& input, Models& models, Tell&& tell)
{
    const std::string name = file == "-" ? "standard input" : std::filesystem::path(file).filename().string();
    tell("reading " + name, 0.0);
    Stopwatch watch;
    ReadResult read = read_mesh_with_notes(file, {.format = options.from});
    models.read_seconds += watch.lap();
    input = {file,
             input_format(file, options.from),
             read.mesh.positions.size(),
             read.mesh.triangles.size(),
             read.mesh.bounds(),
             read.notes,
             std::nullopt,
             std::move(read.mesh.face_numbers)};
    tell("estimating the surface of " + name, 0.3);
    PreparedMesh prepared = prepare_mesh(std::move(read.mesh), options.prepare);
    if (!prepared.from_cache && options.prepare.estimate.need != Need::normals)
        input.estimate = prepared.report;
    models.surface_seconds += watch.lap();
    return prepared;
}

/// The edges of an object that are not as they should be, as a diagnosis counts them.
Diagnosis count_unpaired(const LineModel& model, std::uint32_t first, std::uint32_t end)
{
    Diagnosis counts;
    const auto corner = [&](std::uint32_t h) { return model.welded(model.faces[h / 3][int(h % 3)]); };
    for_each_unpaired(find_unpaired_edges(model.solid(), 3 * first, 3 * end, corner), [&](const UnpairedEdge*, std::size_t count) {
        ++(count == 1 ? counts.border_edges : count == 2 ? counts.misoriented_edges : counts.non_manifold_edges);
    });
    return counts;
}

std::size_t count_flat_faces(const LineModel& model, std::uint32_t first, std::uint32_t end)
{
    const auto is_flat = [&](const uvec3& f) {
        const dvec3 a = model.positions[f.x], b = model.positions[f.y], c = model.positions[f.z];
        return cross(b - a, c - a) == dvec3(0);
    };
    const std::vector<std::size_t> counts =
        parallel_collect<std::size_t>(end - first, 1 << 15, [&](std::size_t from, std::size_t to, std::vector<std::size_t>& out) {
            const auto begin = model.faces.begin() + first;
            out.push_back(std::size_t(std::count_if(begin + std::ptrdiff_t(from), begin + std::ptrdiff_t(to), is_flat)));
        });
    return std::accumulate(counts.begin(), counts.end(), std::size_t(0));
}

} // namespace

Bounds Models::bounds() const
{
    Bounds all;
    for (const Input& input : inputs)
        all.add(input.bounds);
    return all;
}

std::vector<std::string> topology_notes(const LineModel& model, std::size_t object)
{
    const std::uint32_t first = model.first_face[object], end = model.first_face[object + 1];
    std::vector<std::string> notes = complaints(count_unpaired(model, first, end));
    if (const std::size_t flat = count_flat_faces(model, first, end); flat > 0)
        notes.push_back(counted(flat, "zero-area face"));
    return notes;
}

std::string input_format(const std::string& file, const std::string& from) { return from.empty() ? file_ending(file) : from; }

Models prepare_models(const ModelOptions& options, Console& console, double share)
{
    const double for_files = 0.85 * share / double(options.files.size());
    Models models;
    std::vector<PreparedMesh> loaded;
    for (const std::string& file : options.files) {
        const auto tell = [&](const std::string& what, double part) { console.progress(what, for_files * (double(loaded.size()) + part)); };
        loaded.push_back(load(file, options, models.inputs.emplace_back(), models, tell));
    }
    console.progress("joining faces", 0.85 * share);
    Stopwatch watch;
    std::vector<PlacedSurface> placed;
    for (const PreparedMesh& model : loaded)
        placed.push_back(model.placed());
    models.lines = build_line_model(placed);
    for (std::size_t object = 0; object < models.inputs.size(); ++object) {
        const std::vector<std::string> more = topology_notes(models.lines, object);
        models.inputs[object].notes.insert(models.inputs[object].notes.end(), more.begin(), more.end());
    }
    models.merge_seconds = watch.lap();
    return models;
}
