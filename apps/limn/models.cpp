#include "models.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/parallel.h"
#include "limn/geometry/diagnose.h"
#include "limn/geometry/read_mesh.h"
#include "limn/geometry/unpaired_edges.h"
#include "limn/pattern/read_gcode.h"
#include "limn/shadow/shape_hash.h"

using namespace limn;

namespace {

/// A file as it was read and prepared, and what is worth telling of it.
struct Loaded {
    PreparedMesh prepared;
    Input input;
    std::shared_ptr<const LoopModel> loop; ///< where it is a control mesh
};

/// The numbers that the faces of a fine mesh have in the control mesh's file.
std::vector<std::uint32_t> control_numbers(const LoopModel& loop, std::size_t fine_faces, const std::vector<std::uint32_t>& numbers)
{
    std::size_t faces_of_one = fine_faces / loop.face_count();
    for (int i = 0; i < loop.base_levels(); ++i)
        faces_of_one *= 4;
    std::vector<std::uint32_t> out(fine_faces);
    for (std::size_t f = 0; f < fine_faces; ++f)
        out[f] = numbers.empty() ? std::uint32_t(f / faces_of_one) : numbers[f / faces_of_one];
    return out;
}

/// Takes the fine mesh of a control mesh.
void take_fine(Loaded& loaded, int levels, Need need, const std::vector<std::uint32_t>& numbers)
{
    loaded.prepared = loaded.loop->fine_mesh(levels, need);
    loaded.input.face_numbers = control_numbers(*loaded.loop, loaded.prepared.mesh.triangles.size(), numbers);
}

/// @param tell  tell(what, part of this file's work)
template <class Tell> Loaded load(const SceneObject& object, const ModelOptions& all, Models& models, Tell&& tell)
{
    const PrepareOptions& options = all.prepare;
    const std::string file = object.file.string(), name = file == "-" ? "standard input" : object.file.filename().string();
    if (is_gcode_format(input_format(file, object.format)))
        throw Error::Read(fmt::format("{}: is G-code and holds no mesh; 'limn render' draws it, alone", file));
    tell("reading " + name, 0.0);
    Stopwatch watch;
    ReadResult read = read_mesh_with_notes(object.file, {.format = object.format});
    models.read_seconds += watch.lap();
    Loaded loaded;
    loaded.input.file = file;
    loaded.input.format = input_format(file, object.format);
    loaded.input.vertices = read.mesh.positions.size();
    loaded.input.triangles = read.mesh.triangles.size();
    if (all.hash_shapes)
        loaded.input.shape = shape_hash(read.mesh);
    loaded.input.notes = read.notes;
    if (all.subdivision.scheme == SubdivisionOptions::Scheme::loop) {
        tell("subdividing " + name, 0.3);
        loaded.loop = std::make_shared<const LoopModel>(read.mesh, all.subdivision);
        loaded.input.notes.insert(loaded.input.notes.end(), loaded.loop->notes().begin(), loaded.loop->notes().end());
        take_fine(loaded, levels_for_whole(*loaded.loop, all.subdivision.outline_error), options.estimate.need, read.mesh.face_numbers);
        models.surface_seconds += watch.lap();
        return loaded;
    }
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

double scale_of(const dmat4& similarity) { return std::cbrt(std::abs(glm::determinant(dmat3(similarity)))); }

/// What so many pixels are at the nearest point of a box that the camera has before it.
double pixels_to_length(const Camera& camera, const Bounds& bounds, double pixels)
{
    constexpr double least = 0.01; // of the box, where the camera is inside it
    const double depth = glm::dot(bounds.centre() - camera.eye, camera.forward()) - bounds.radius();
    return pixels / camera.pixels_per_unit(std::max(depth, least * bounds.radius()));
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
            loaded.emplace(i, load(object, options, models, tell));
        const Loaded& model = loaded.at(first[i]);
        placed.push_back(model.prepared.placed(object.transform));
        if (model.loop)
            models.loops.push_back({model.loop, object.transform});
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
        if (first[object] != object || !models.loops.empty()) // borders of control meshes are meant to be there
            continue;
        const std::vector<std::string> more = topology_notes(models.lines, object);
        models.inputs[object].notes.insert(models.inputs[object].notes.end(), more.begin(), more.end());
    }
    models.merge_seconds = watch.lap();
    return models;
}

void refine_for(Models& models, std::span<const Camera> cameras, const ModelOptions& options)
{
    std::map<const LoopModel*, int> levels;
    const double pixels = 0.5 * options.subdivision.outline_error;
    bool finer = false;
    for (std::size_t i = 0; i < models.loops.size(); ++i) {
        const PlacedLoop& object = models.loops[i];
        int& most = levels.try_emplace(object.model.get(), levels_for_whole(*object.model, options.subdivision.outline_error)).first->second;
        for (const Camera& camera : cameras) {
            const double error = pixels_to_length(camera, models.inputs[i].bounds, pixels) / scale_of(object.transform);
            const int wanted = levels_for(*object.model, error);
            finer = finer || wanted > most;
            most = std::max(most, wanted);
        }
    }
    if (!finer)
        return;
    Stopwatch watch;
    std::map<const LoopModel*, PreparedMesh> meshes;
    std::vector<PlacedSurface> placed;
    for (std::size_t i = 0; i < models.loops.size(); ++i) {
        const PlacedLoop& object = models.loops[i];
        const LoopModel& loop = *object.model;
        if (!meshes.contains(&loop))
            meshes.emplace(&loop, loop.fine_mesh(levels.at(&loop), options.prepare.estimate.need));
        placed.push_back(meshes.at(&loop).placed(object.transform));
        std::vector<std::uint32_t>& numbers = models.inputs[i].face_numbers;
        const std::size_t fine = meshes.at(&loop).mesh.triangles.size(), times = fine / numbers.size();
        std::vector<std::uint32_t> finer_numbers(fine);
        for (std::size_t f = 0; f < fine; ++f)
            finer_numbers[f] = numbers[f / times];
        numbers = std::move(finer_numbers);
    }
    models.lines = build_line_model(placed);
    models.surface_seconds += watch.lap();
}
