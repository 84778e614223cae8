#include "models.h"

#include <algorithm>
#include <map>
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

/// A file as it was read and prepared, and what is worth telling of it.
struct Loaded {
    PreparedMesh prepared;
    Input input;
};

/// @param tell  tell(what, part of this file's work)
template <class Tell> Loaded load(const SceneObject& object, const PrepareOptions& options, Models& models, Tell&& tell)
{
    const std::string file = object.file.string(), name = file == "-" ? "standard input" : object.file.filename().string();
    tell("reading " + name, 0.0);
    Stopwatch watch;
    ReadResult read = read_mesh_with_notes(object.file, {.format = object.format});
    models.read_seconds += watch.lap();
    Loaded loaded;
    loaded.input.file = file;
    loaded.input.format = input_format(file, object.format);
    loaded.input.vertices = read.mesh.positions.size();
    loaded.input.triangles = read.mesh.triangles.size();
    loaded.input.notes = read.notes;
    loaded.input.face_numbers = std::move(read.mesh.face_numbers);
    tell("estimating the surface of " + name, 0.3);
    loaded.prepared = prepare_mesh(std::move(read.mesh), options);
    if (!loaded.prepared.from_cache && options.estimate.need != Need::normals)
        loaded.input.estimate = loaded.prepared.report;
    models.surface_seconds += watch.lap();
    return loaded;
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
    const std::vector<std::size_t> first = first_of_same_model(options.objects);
    const double for_files = 0.85 * share / double(options.objects.size());
    Models models;
    std::map<std::size_t, Loaded> loaded; // by the first object that shows it
    std::vector<PlacedSurface> placed;
    for (std::size_t i = 0; i < options.objects.size(); ++i) {
        const SceneObject& object = options.objects[i];
        const auto tell = [&](const std::string& what, double part) { console.progress(what, for_files * (double(i) + part)); };
        if (first[i] == i)
            loaded.emplace(i, load(object, options.prepare, models, tell));
        const Loaded& model = loaded.at(first[i]);
        placed.push_back(model.prepared.placed(object.transform));
        Input& input = models.inputs.emplace_back(model.input);
        input.name = object.name;
        input.transform = object.transform;
        input.bounds = world_bounds(placed.back());
        if (first[i] != i)
            input.notes.clear();
    }
    console.progress("joining faces", 0.85 * share);
    Stopwatch watch;
    models.lines = build_line_model(placed);
    for (std::size_t object = 0; object < models.inputs.size(); ++object) {
        if (first[object] != object)
            continue;
        const std::vector<std::string> more = topology_notes(models.lines, object);
        models.inputs[object].notes.insert(models.inputs[object].notes.end(), more.begin(), more.end());
    }
    models.merge_seconds = watch.lap();
    return models;
}
