#include "limn/subdivision/subdivide.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/parallel.h"
#include "limn/geometry/triangle_distance.h"
#include "limn/subdivision/loop_limit.h"
#include "limn/subdivision/loop_refine.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1 << 13;

struct Level {
    LoopTopology topology;
    std::vector<dvec3> positions;
};

Level next_level(const Level& level, CreaseRule rule)
{
    return {refine(level.topology), refine_positions(level.topology, level.positions, rule)};
}

/// Values of vertices, and behind them the middle of each edge's two.
template <class T> std::vector<T> with_middles(const LoopTopology& t, std::vector<T> values)
{
    const std::size_t old = values.size();
    values.resize(old + t.edge_count());
    parallel_each(t.edge_count(), grain, [&](std::size_t e) {
        const std::uint32_t h = t.half_edge[e];
        values[old + e] = (values[t.start(h)] + values[t.end(h)]) * typename T::value_type(0.5);
    });
    return values;
}

/// A level and the next two, in which its distance to the limit is measured.
using ThreeLevels = std::array<Level, 3>;

std::size_t triangle_count(const Level& level) { return level.topology.triangles.size(); }

/// The greatest distance of points of the limit surface to the mesh: for each triangle of the first level, of the vertices of the third that
/// lie in it, each to the nearest point of the triangle and those around its corners. (The point of the triangle with the same parameters would
/// not do: at vertices of high valence it lags far behind along the surface.)
double distance_to_limit(const ThreeLevels& levels, const SubdivideOptions& options)
{
    const LoopTopology& t = levels[0].topology;
    const std::vector<dvec3> pushed = options.limit ? limit_positions(t, levels[0].positions, options.crease_rule) : std::vector<dvec3>();
    const std::vector<dvec3>& shown = options.limit ? pushed : levels[0].positions;
    const std::vector<dvec3> limit = limit_positions(levels[2].topology, levels[2].positions, options.crease_rule);
    const auto distance_to = [&](std::size_t f, const dvec3& p) {
        const uvec3& corners = t.triangles[f];
        return distance_to_triangle(p, shown[corners.x], shown[corners.y], shown[corners.z]);
    };
    const auto most_in = [&](std::size_t f, const uvec3& vertices, double most, Spokes& spokes) {
        for (int k = 0; k < 3; ++k) {
            const dvec3& p = limit[vertices[k]];
            double least = distance_to(f, p);
            for (int corner = 0; corner < 3 && least > most; ++corner) {
                t.gather(t.triangles[f][corner], spokes);
                for (const std::uint32_t h : spokes.half_edges)
                    least = std::min(least, distance_to(h / 3, p));
            }
            most = std::max(most, least);
        }
        return most;
    };
    const std::vector<double> blocks = parallel_collect<double>(triangle_count(levels[0]), grain, [&](std::size_t begin, std::size_t end, std::vector<double>& out) {
        Spokes spokes;
        double most = 0;
        for (std::size_t f = begin; f < end; ++f) {
            most = most_in(f, t.triangles[f], most, spokes);
            most = most_in(f, levels[1].topology.triangles[4 * f + 3], most, spokes);
            for (std::size_t child = 4 * f; child < 4 * f + 4; ++child)
                most = most_in(f, levels[2].topology.triangles[4 * child + 3], most, spokes);
        }
        out.push_back(most);
    });
    return *std::max_element(blocks.begin(), blocks.end());
}

/// Whether so many triangles may be made.
bool is_too_many(std::size_t triangles, int levels) { return double(triangles) * std::pow(4.0, levels) > double(most_subdivided_triangles); }

/// The first level that is near enough, its number and what was measured there.
Level measured_level(Level first, const SubdivideOptions& options, Subdivided& result)
{
    const std::string what = fmt::format("--max-error {}", options.max_error);
    if (is_too_many(triangle_count(first), 2))
        throw Error::Input(fmt::format("{}: measuring {} triangles takes 16 times as many, more than the {} that there may be", what,
                                       triangle_count(first), most_subdivided_triangles));
    ThreeLevels levels;
    levels[0] = std::move(first);
    levels[1] = next_level(levels[0], options.crease_rule);
    levels[2] = next_level(levels[1], options.crease_rule);
    for (;;) {
        result.measured = distance_to_limit(levels, options);
        result.measured_at = levels[2].positions.size();
        if (result.measured <= options.max_error)
            return std::move(levels[0]);
        if (is_too_many(triangle_count(levels[2]), 1))
            throw Error::Input(fmt::format("{}: level {} ({} triangles) is {:.3g} away from the limit surface; measuring the next takes {} triangles, "
                                           "more than the {} that there may be{}",
                                           what, result.levels, triangle_count(levels[0]), result.measured, 4 * triangle_count(levels[2]),
                                           most_subdivided_triangles, options.limit ? "" : " (--limit gets nearer at the same level)"));
        std::rotate(levels.begin(), levels.begin() + 1, levels.end());
        levels[2] = next_level(levels[1], options.crease_rule);
        ++result.levels;
    }
}

std::vector<CreaseEdge> remaining_creases(const LoopTopology& t)
{
    return parallel_collect<CreaseEdge>(t.edge_count(), grain, [&](std::size_t begin, std::size_t end, std::vector<CreaseEdge>& out) {
        for (std::uint32_t e = std::uint32_t(begin); e < end; ++e)
            if (t.sharpness[e] > 0 && !t.is_border(e))
                out.push_back({t.start(t.half_edge[e]), t.end(t.half_edge[e]), t.sharpness[e]});
    });
}

/// The same after one more step.
std::vector<CreaseEdge> creases_after_step(const LoopTopology& t)
{
    return parallel_collect<CreaseEdge>(t.edge_count(), grain, [&](std::size_t begin, std::size_t end, std::vector<CreaseEdge>& out) {
        for (std::uint32_t e = std::uint32_t(begin); e < end; ++e) {
            const float sharp = child_sharpness(t.sharpness[e]);
            const std::uint32_t h = t.half_edge[e], point = std::uint32_t(t.vertex_count()) + e;
            if (sharp > 0 && !t.is_border(e)) {
                out.push_back({t.start(h), point, sharp});
                out.push_back({point, t.end(h), sharp});
            }
        }
    });
}

/// A level as a mesh, its vertices where they are.
void set_level(Level&& level, Mesh& fine)
{
    fine.creases = remaining_creases(level.topology);
    fine.positions = std::move(level.positions);
    fine.triangles = std::move(level.topology.triangles);
}

/// The next level as a mesh; nothing is made that only further steps would ask for.
void set_next_level(const Level& level, CreaseRule rule, Mesh& fine)
{
    fine.creases = creases_after_step(level.topology);
    fine.positions = refine_positions(level.topology, level.positions, rule);
    fine.triangles = refine_triangles(level.topology);
}

/// A level as a mesh on the limit surface, with its normals.
void set_limit(Level&& level, CreaseRule rule, Mesh& fine)
{
    LimitSurface limit = limit_surface(level.topology, level.positions, rule);
    fine.positions = std::move(limit.positions);
    fine.corner_normals.assign(limit.normals.begin(), limit.normals.end());
    fine.triangles = std::move(level.topology.triangles);
}

/// What hangs on vertices and faces, taken down to a level.
void take_down(const Mesh& mesh, const ControlMesh& control, int levels, Mesh& fine)
{
    fine.corner_uvs = mesh.corner_uvs;
    fine.group_names = mesh.group_names;
    if (!mesh.colours.empty())
        for (const std::uint32_t v : control.source)
            fine.colours.push_back(mesh.colours[v]);
    LoopTopology t = fine.colours.empty() ? LoopTopology() : control.topology;
    for (int i = 0; i < levels; ++i) {
        if (!fine.corner_uvs.empty())
            fine.corner_uvs = refine_corners(fine.corner_uvs);
        if (!fine.colours.empty()) {
            fine.colours = with_middles(t, std::move(fine.colours));
            t = refine(t);
        }
    }
    if (!mesh.face_groups.empty()) {
        fine.face_groups.resize(fine.triangles.size());
        const std::size_t children = fine.triangles.size() / mesh.triangles.size();
        parallel_each(fine.triangles.size(), grain, [&](std::size_t f) { fine.face_groups[f] = mesh.face_groups[f / children]; });
    }
}

} // namespace

const OptionTable<SubdivideOptions>& subdivide_option_table()
{
    using Options = SubdivideOptions;
    static const OptionTable<Options> table = {
        number_row<Options>("levels", "", 0, 12, "how often each triangle is cut into four", &Options::levels),
        number_row<Options>("max-error", "length", 0, 1e9, "instead of --levels: as many as bring the mesh this near to the limit surface",
                            &Options::max_error),
        switch_row<Options>("limit", "push the vertices to the limit surface, and write its normals", &Options::limit),
        choice_row<Options, CreaseRule>("crease-rule",
                                        {{"opensubdiv", CreaseRule::opensubdiv}, {"hoppe", CreaseRule::hoppe}, {"biermann", CreaseRule::biermann}},
                                        "how sharp edges and what lies beside them are subdivided", &Options::crease_rule),
        number_row<Options>("crease-angle", "degrees", 0, 180, "keep edges sharp where faces turn by more than this; 0 is off", &Options::crease_angle),
        switch_row<Options>("crease-tags", "keep edges sharp that an OBJ file tags", &Options::crease_tags)};
    return table;
}

Subdivided subdivide(const Mesh& mesh, const SubdivideOptions& options)
{
    ControlMesh control = make_control_mesh(mesh, {.tags = options.crease_tags, .crease_angle = options.crease_angle});
    Subdivided result;
    result.notes = notes_of(control.notes);
    Level level{control.topology, std::move(control.positions)};
    if (options.max_error > 0) {
        level = measured_level(std::move(level), options, result);
    } else {
        if (is_too_many(mesh.triangles.size(), options.levels))
            throw Error::Input(fmt::format("--levels {}: {} triangles would become {:.0f}, more than the {} that there may be", options.levels,
                                           mesh.triangles.size(), double(mesh.triangles.size()) * std::pow(4.0, options.levels), most_subdivided_triangles));
        for (; result.levels + 1 < options.levels; ++result.levels)
            level = next_level(level, options.crease_rule);
    }
    Mesh& fine = result.mesh;
    const bool is_step_left = options.max_error == 0 && result.levels < options.levels;
    result.levels += is_step_left;
    if (options.limit)
        set_limit(is_step_left ? next_level(level, options.crease_rule) : std::move(level), options.crease_rule, fine);
    else if (is_step_left)
        set_next_level(level, options.crease_rule, fine);
    else
        set_level(std::move(level), fine);
    take_down(mesh, control, result.levels, fine);
    return result;
}

} // namespace limn
