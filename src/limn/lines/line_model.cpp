#include "limn/lines/line_model.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"

namespace limn {
namespace {

constexpr std::size_t grain = 16384;

void check(std::span<const PlacedSurface> placed)
{
    if (placed.empty())
        throw Error::Input("no mesh to draw");
    for (const PlacedSurface& p : placed) {
        const std::size_t n = p.mesh->positions.size();
        const auto fits = [n](std::size_t size) { return size == 0 || size == n; };
        if (!fits(p.surface->normals.size()) || !fits(p.surface->k1.size()) || !fits(p.surface->derivative.size()))
            throw Error::Input(fmt::format("a surface of {} normals does not fit its mesh of {} vertices", p.surface->normals.size(), n));
    }
}

dvec3 transform_point(const dmat4& m, const dvec3& p) { return dvec3(m * dvec4(p, 1)); }

/// Appends one placed surface; `offset` is the number of vertices before it.
void append(LineModel& model, const PlacedSurface& p, std::uint32_t offset)
{
    const Mesh& mesh = *p.mesh;
    const Surface& surface = *p.surface;
    const std::size_t n = mesh.positions.size(), first = model.faces.size();
    // The scale of the transform, and the rotation without it.
    const double size = std::cbrt(std::abs(glm::determinant(dmat3(p.transform))));
    const glm::mat3 rotation = glm::mat3(dmat3(p.transform) / size);
    const float unit = float(model.scale / size); // curvature times this is curvature in the model's frame
    const bool moved = p.transform != dmat4(1);

    parallel_each(n, grain, [&](std::size_t i) {
        const std::size_t o = offset + i;
        model.positions[o] = model.from_world(moved ? transform_point(p.transform, mesh.positions[i]) : mesh.positions[i]);
        if (!model.normals.empty() && !surface.normals.empty())
            model.normals[o] = rotation * surface.normals[i];
        if (model.has_curvature() && surface.has_curvature()) {
            model.e1[o] = rotation * surface.e1[i];
            model.e2[o] = rotation * surface.e2[i];
            model.k1[o] = surface.k1[i] * unit;
            model.k2[o] = surface.k2[i] * unit;
        }
        if (model.has_derivative() && surface.has_derivative())
            model.derivative[o] = surface.derivative[i] * (unit * unit);
    });
    if (!model.weld.empty())
        parallel_each(n, grain, [&](std::size_t i) { model.weld[offset + i] = offset + (p.weld.empty() ? std::uint32_t(i) : p.weld[i]); });
    model.faces.resize(first + mesh.triangles.size());
    parallel_each(mesh.triangles.size(), grain, [&](std::size_t f) { model.faces[first + f] = mesh.triangles[f] + offset; });
}

/// A vertex that no face uses may hold anything: it is put at the origin, where it harms no bounds.
void tame_unused_vertices(LineModel& model)
{
    parallel_each(model.vertex_count(), grain, [&](std::size_t i) {
        const vec3& p = model.positions[i];
        if (!(glm::dot(p, p) < 1e6f))
            model.positions[i] = vec3(0);
    });
}

void find_split_edges(LineModel& model)
{
    model.split_edges.clear();
    if (model.weld.empty())
        return;
    for (std::uint32_t h = 0; h < 3 * model.faces.size(); ++h)
        if (const std::uint32_t g = model.welded_adjacency.twin[h]; g != none && h < g && model.adjacency.twin[h] == none)
            model.split_edges.push_back(h);
}

void find_open_components(LineModel& model)
{
    std::uint32_t count = 0;
    for (const std::uint32_t component : model.component)
        count = std::max(count, component + 1);
    model.open_component.assign(count, 0);
    const std::vector<std::uint32_t>& twin = model.solid().twin;
    for (std::size_t h = 0; h < twin.size(); ++h)
        if (twin[h] == none)
            model.open_component[model.component[h / 3]] = 1;
}

/// Appends the twins of one object whose half-edges are numbered from `first` on.
void append_twins(std::vector<std::uint32_t>& all, const std::vector<std::uint32_t>& twins, std::uint32_t first)
{
    all.resize(first + twins.size());
    parallel_each(twins.size(), grain, [&](std::size_t h) { all[first + h] = twins[h] == none ? none : twins[h] + first; });
}

/// connect_faces where each object's own connectivity is known: no edge joins two objects.
void join_connectivities(LineModel& model, std::span<const PlacedSurface> placed)
{
    std::uint32_t shells = 0;
    for (std::size_t object = 0; object < placed.size(); ++object) {
        const Connectivity& own = *placed[object].connectivity;
        const std::uint32_t first = 3 * model.first_face[object];
        append_twins(model.adjacency.twin, own.smooth.twin, first);
        if (!model.weld.empty())
            append_twins(model.welded_adjacency.twin, (own.solid.twin.empty() ? own.smooth : own.solid).twin, first);
        const std::uint32_t before = shells;
        for (const std::uint32_t shell : own.shells) {
            model.component.push_back(before + shell);
            shells = std::max(shells, before + shell + 1);
        }
    }
    find_split_edges(model);
    find_open_components(model);
}

} // namespace

Bounds world_bounds(const PlacedSurface& p)
{
    if (p.transform == dmat4(1))
        return p.mesh->bounds();
    Bounds box;
    for (const uvec3& t : p.mesh->triangles)
        for (int k = 0; k < 3; ++k)
            box.add(transform_point(p.transform, p.mesh->positions[t[k]]));
    return box;
}

View LineModel::view(const Camera& camera) const
{
    if (camera.orthographic)
        return {true, vec3(-camera.forward())};
    return {false, from_world(camera.eye)};
}

std::uint32_t LineModel::object_of_face(std::uint32_t face) const
{
    return std::uint32_t(std::upper_bound(first_face.begin() + 1, first_face.end() - 1, face) - first_face.begin() - 1);
}

void connect_faces(LineModel& model)
{
    const std::size_t vertices = model.vertex_count();
    model.adjacency = build_adjacency(model.faces, vertices);
    if (!model.weld.empty()) {
        std::vector<uvec3> welded(model.faces.size());
        parallel_each(welded.size(), grain, [&](std::size_t f) {
            for (int k = 0; k < 3; ++k)
                welded[f][k] = model.weld[model.faces[f][k]];
        });
        model.welded_adjacency = build_adjacency(welded, vertices);
    }
    model.component = find_shells(model.solid());
    find_split_edges(model);
    find_open_components(model);
}

LineModel build_line_model(std::span<const PlacedSurface> placed)
{
    check(placed);
    LineModel model;
    Bounds box;
    std::size_t vertices = 0;
    bool normals = true, curvature = true, derivative = true, split = false;
    for (const PlacedSurface& p : placed) {
        box.add(world_bounds(p));
        vertices += p.mesh->positions.size();
        normals = normals && !p.surface->normals.empty();
        curvature = curvature && p.surface->has_curvature();
        derivative = derivative && p.surface->has_derivative();
        split = split || !p.weld.empty();
    }
    model.centre = box.centre();
    model.scale = box.radius() > 0 ? box.radius() : 1;
    model.positions.resize(vertices + 1); // the ray tracer loads 16 bytes at the last vertex
    if (normals)
        model.normals.resize(vertices);
    if (curvature) {
        model.e1.resize(vertices);
        model.e2.resize(vertices);
        model.k1.resize(vertices);
        model.k2.resize(vertices);
        if (derivative)
            model.derivative.resize(vertices);
    }
    if (split)
        model.weld.resize(vertices);
    std::uint32_t offset = 0;
    for (const PlacedSurface& p : placed) {
        model.first_face.push_back(std::uint32_t(model.faces.size()));
        model.first_vertex.push_back(offset);
        append(model, p, offset);
        offset += std::uint32_t(p.mesh->positions.size());
    }
    model.first_face.push_back(std::uint32_t(model.faces.size()));
    model.first_vertex.push_back(offset);
    tame_unused_vertices(model);
    if (std::all_of(placed.begin(), placed.end(), [](const PlacedSurface& p) { return p.connectivity != nullptr; }))
        join_connectivities(model, placed);
    else
        connect_faces(model);
    return model;
}

} // namespace limn
