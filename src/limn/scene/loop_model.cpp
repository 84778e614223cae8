#include "limn/scene/loop_model.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/parallel.h"
#include "limn/geometry/split_corners.h"
#include "limn/lines/draw.h"
#include "limn/lines/regions.h"
#include "limn/subdivision/exact_silhouette.h"
#include "limn/subdivision/loop_refine.h"
#include "limn/subdivision/refined_place.h"
#include "limn/subdivision/seed_silhouette.h"
#include "limn/surface/surface_point.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1024;
constexpr std::size_t most_triangles = 4'000'000;

/// The control mesh after its base levels.
struct Base {
    LoopTopology topology;
    std::vector<dvec3> positions;
};

Base base_of(ControlMesh control, const SubdivisionOptions& options, int levels)
{
    Base base{std::move(control.topology), std::move(control.positions)};
    for (int i = 0; i < levels; ++i) {
        if (4 * base.topology.triangles.size() > most_triangles)
            throw Error::Input(fmt::format("--base-levels {}: more than {} triangles", levels, most_triangles));
        base.positions = refine_positions(base.topology, base.positions, options.crease_rule);
        base.topology = refine(base.topology);
    }
    return base;
}

/// Whatever the rule, what two steps by it leave to OpenSubdiv's, in which limits are found.
int base_levels_of(const SubdivisionOptions& options) { return std::max(options.base_levels, options.crease_rule == CreaseRule::opensubdiv ? 0 : 2); }

Point<Taylor> taylor_of(const LimitJet& x)
{
    const auto coordinate = [&](int i) {
        Taylor t;
        t.c = {x.position[i], x.dv[i], x.dw[i], x.dvv[i] / 2, x.dvw[i], x.dww[i] / 2, x.dvvv[i] / 6, x.dvvw[i] / 2, x.dvww[i] / 2, x.dwww[i] / 6};
        return t;
    };
    return {coordinate(0), coordinate(1), coordinate(2)};
}

void resize(Surface& surface, std::size_t n, Need need)
{
    surface.normals.resize(n);
    if (need == Need::normals)
        return;
    surface.e1.resize(n), surface.e2.resize(n), surface.k1.resize(n), surface.k2.resize(n);
    if (need == Need::derivative)
        surface.derivative.resize(n);
}

void set_curvature(Surface& surface, std::size_t i, const LimitJet& jet, Need need)
{
    const double flat = 1e-12;
    const bool is_regular = glm::length(glm::cross(jet.dv, jet.dw)) > flat * glm::length(jet.dv) * glm::length(jet.dw);
    SurfacePoint point;
    if (is_regular) {
        point = surface_point(taylor_of(jet));
    } else { // no tangent plane: nothing curved is known
        const dvec3 aside = std::abs(jet.normal.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
        point.e1 = glm::normalize(glm::cross(jet.normal, aside));
        point.e2 = glm::cross(jet.normal, point.e1);
    }
    surface.e1[i] = vec3(point.e1), surface.e2[i] = vec3(point.e2);
    surface.k1[i] = float(point.k1), surface.k2[i] = float(point.k2);
    if (need == Need::derivative)
        surface.derivative[i] = vec4(point.derivative);
}

constexpr int usual_curve_points = 8;

/// A mesh with corner normals, split where they differ. @param corner_of  becomes a corner of each vertex
PreparedMesh split_prepared(Mesh mesh, std::vector<std::uint32_t>& corner_of)
{
    const SplitCorners split = split_corners(mesh, true, false);
    PreparedMesh out;
    out.connectivity.solid = build_adjacency(mesh.triangles, mesh.positions.size());
    out.connectivity.shells = find_shells(out.connectivity.solid);
    const std::size_t n = split.source.size();
    out.mesh.positions.resize(n);
    out.surface.normals.resize(n);
    out.weld.resize(n);
    std::uint32_t first = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t c = split.source[i], vertex = mesh.triangles[c / 3][int(c % 3)];
        out.mesh.positions[i] = mesh.positions[vertex];
        out.surface.normals[i] = mesh.corner_normals[c];
        const std::uint32_t c0 = split.source[first];
        if (mesh.triangles[c0 / 3][int(c0 % 3)] != vertex)
            first = i;
        out.weld[i] = first;
    }
    out.mesh.triangles.resize(mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
        out.mesh.triangles[f] = {split.corner[3 * f], split.corner[3 * f + 1], split.corner[3 * f + 2]};
    out.connectivity.smooth = build_adjacency(out.mesh.triangles, n);
    if (std::none_of(out.weld.begin(), out.weld.end(), [&, i = std::uint32_t(0)](std::uint32_t w) mutable { return w != i++; }))
        out.weld.clear(), out.connectivity.solid = {};
    corner_of = split.source;
    return out;
}

double distance_to_segment(const dvec3& p, const dvec3& a, const dvec3& b)
{
    const dvec3 along = b - a;
    const double square = glm::dot(along, along), t = square > 0 ? std::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0;
    return glm::distance(p, a + t * along);
}

/// From the frame of an object to the world's directions. @param transform  a similarity
glm::mat3 rotation_of(const dmat4& transform) { return glm::mat3(dmat3(transform) / std::cbrt(std::abs(glm::determinant(dmat3(transform))))); }

} // namespace

LoopModel::Refined LoopModel::refined(int levels) const
{
    Refined mesh{table_.control(), positions_};
    for (int i = 0; i < levels; ++i) {
        mesh.positions = refine_positions(mesh.topology, mesh.positions);
        mesh.topology = refine(mesh.topology);
    }
    return mesh;
}

LoopModel::LoopModel(const Mesh& mesh, const SubdivisionOptions& options)
    : options_(options), base_levels_(base_levels_of(options)), table_([&] {
          ControlMesh control = make_control_mesh(mesh, {.tags = options.crease_tags, .crease_angle = options.sharp_angle});
          notes_ = notes_of(control.notes);
          Base base = base_of(std::move(control), options, base_levels_);
          positions_ = std::move(base.positions);
          return PatchTable(std::move(base.topology));
      }()),
      pose_(pose_silhouette(table_, positions_))
{
    if (options.silhouette == SubdivisionOptions::Silhouette::seed) {
        seed_ = make_seed_surface(table_.control(), options.depth);
        seed_pose_ = make_seed_pose(*seed_, positions_);
    }
    if (options.normals == SubdivisionOptions::Normals::map)
        map();
}

const SurfaceMap* LoopModel::map() const
{
    std::call_once(map_once_, [&] {
        if (options_.normals == SubdivisionOptions::Normals::vertex)
            return;
        try {
            map_.emplace(make_surface_map(pose_, options_.map_size));
        } catch (const Error::Input&) {
            if (options_.normals == SubdivisionOptions::Normals::map)
                throw;
        }
    });
    return map_ ? &*map_ : nullptr;
}

SilhouetteMesh LoopModel::silhouette(const Camera& camera) const
{
    using Silhouette = SubdivisionOptions::Silhouette;
    if (options_.silhouette == Silhouette::exact)
        return exact_silhouette(pose_, camera, {.outline_error = options_.outline_error, .curve_points = options_.curve_points, .surface_error = options_.surface_error});
    if (seed_) {
        const Eye eye{camera.orthographic ? dvec4(-camera.forward(), 0) : dvec4(camera.eye, 1)};
        return seed_silhouette(*seed_, seed_pose_, eye, {.depth = options_.depth, .curve_points = options_.curve_points > 0 ? options_.curve_points : usual_curve_points});
    }
    SilhouetteMesh out;
    out.mesh.positions = pose_.corners.positions;
    out.mesh.triangles = table_.control().triangles;
    out.mesh.corner_normals.assign(pose_.corners.normals.begin(), pose_.corners.normals.end());
    for (std::uint32_t f = 0; f < face_count(); ++f) {
        out.faces.push_back(f);
        out.parameters.insert(out.parameters.end(), {dvec2(0, 0), dvec2(1, 0), dvec2(0, 1)});
    }
    return out;
}

CutMesh LoopModel::cut_mesh(const Camera& camera) const
{
    CutMesh cut{silhouette(camera), {}, {}};
    if (options_.normals == SubdivisionOptions::Normals::limit)
        cut.normal_at = exact_normals(pose_.shape, cut.silhouette);
    else if (options_.normals == SubdivisionOptions::Normals::map)
        cut.normal_at = normals_in_map(*map(), cut.silhouette);
    std::vector<std::uint32_t> corner_of;
    cut.prepared = split_prepared(cut.silhouette.mesh, corner_of);
    return cut;
}

Camera in_object_frame(const Camera& camera, const dmat4& transform)
{
    const dmat4 inverse = glm::inverse(transform);
    const double scale = std::cbrt(std::abs(glm::determinant(dmat3(inverse))));
    Camera out = camera;
    out.eye = dvec3(inverse * dvec4(camera.eye, 1));
    out.look = dvec3(inverse * dvec4(camera.look, 1));
    out.up = dmat3(inverse) * camera.up;
    out.ortho_height = camera.ortho_height * scale;
    return out;
}

double LoopModel::deviation(int levels) const
{
    constexpr double share = 0.99; // of edges
    const Refined mesh = refined(levels);
    const LoopTopology& t = mesh.topology;
    const std::vector<dvec3> fine = refine_positions(t, mesh.positions);
    const std::vector<dvec3> limit = limit_positions(refine(t), fine);
    std::vector<double> distances(t.edge_count());
    parallel_each(distances.size(), grain, [&](std::size_t e) {
        const std::uint32_t h = t.half_edge[e];
        distances[e] = distance_to_segment(limit[t.vertex_count() + e], limit[t.start(h)], limit[t.end(h)]);
    });
    const auto at = distances.begin() + std::ptrdiff_t(share * double(distances.size() - 1));
    std::nth_element(distances.begin(), at, distances.end());
    return *at;
}

PreparedMesh LoopModel::fine_mesh(int levels, Need need) const
{
    Refined fine = refined(levels);
    LimitSurface limit = limit_surface(fine.topology, fine.positions);
    Mesh mesh;
    mesh.positions = std::move(limit.positions);
    mesh.triangles = std::move(fine.topology.triangles);
    mesh.corner_normals.assign(limit.normals.begin(), limit.normals.end());
    std::vector<std::uint32_t> corner_of;
    PreparedMesh out = split_prepared(std::move(mesh), corner_of);
    if (need == Need::normals)
        return out;
    resize(out.surface, corner_of.size(), need);
    parallel_each(corner_of.size(), grain, [&](std::size_t i) {
        set_curvature(out.surface, i, pose_.shape.jet(corner_place(corner_of[i] / 3, int(corner_of[i] % 3), levels)), need);
    });
    return out;
}

std::unique_ptr<const LoopView> make_loop_view(std::span<const PlacedLoop> placed, const Camera& camera)
{
    std::vector<CutMesh> meshes;
    std::vector<PlacedSurface> surfaces;
    meshes.reserve(placed.size());
    for (const PlacedLoop& object : placed) {
        meshes.push_back(object.model->cut_mesh(in_object_frame(camera, object.transform)));
        surfaces.push_back(meshes.back().prepared.placed(object.transform));
    }
    LineModel lines = build_line_model(surfaces);
    RayScene rays = build_ray_scene(lines);
    auto view = std::make_unique<LoopView>(LoopView{std::move(lines), std::move(rays), {}, std::move(meshes), placed});
    view->seen = seen_scene(view->lines, view->rays);
    if (!view->meshes[0].normal_at)
        return view;
    std::vector<NormalAt> normals;
    for (const CutMesh& mesh : view->meshes)
        normals.push_back(mesh.normal_at);
    std::vector<glm::mat3> rotations;
    for (const PlacedLoop& object : placed)
        rotations.push_back(rotation_of(object.transform));
    const std::vector<std::uint32_t>& first = view->lines.first_face;
    view->seen.objects[0].normal_at = [first, normals = std::move(normals), rotations = std::move(rotations)](std::uint32_t face, float u, float v) {
        const std::size_t object = std::size_t(std::upper_bound(first.begin(), first.end() - 1, face) - first.begin()) - 1;
        return rotations[object] * normals[object](face - first[object], u, v);
    };
    return view;
}

MappedNormals LoopView::mapped_normals() const
{
    MappedNormals result;
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const SurfaceMap* map = placed[i].model->map();
        if (!map)
            return {};
        const auto known = std::find(result.maps.begin(), result.maps.end(), &map->texels);
        result.parts.push_back({std::uint32_t(known - result.maps.begin()), rotation_of(placed[i].transform)});
        if (known == result.maps.end())
            result.maps.push_back(&map->texels);
        const std::vector<vec2> uvs = map_uvs(*map, meshes[i].silhouette);
        result.uvs.insert(result.uvs.end(), uvs.begin(), uvs.end());
    }
    return result;
}

int levels_for(const LoopModel& model, double error)
{
    int levels = 0;
    for (;;) {
        const double found = model.deviation(levels);
        if (found <= error)
            return levels;
        // A level brings a quarter of the error, but less than that while semi-sharp edges wear off: so it is measured again.
        const int more = std::max(1, int(std::ceil(std::log2(found / error) / 2)));
        for (int i = 0; i < more; ++i, ++levels)
            if (double(model.face_count()) * std::pow(4.0, levels + 1) > double(most_triangles))
                return levels;
    }
}

int levels_for_whole(const LoopModel& model, double outline_error)
{
    constexpr double pixels = 2000;
    Bounds bounds;
    for (const dvec3& p : model.pose().corners.positions)
        bounds.add(p);
    return levels_for(model, outline_error * 2 * bounds.radius() / pixels);
}

} // namespace limn
