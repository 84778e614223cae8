#include "limn/subdivision/loop_topology.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/geometry/counted.h"
#include "limn/base/parallel.h"

namespace limn {
namespace {

void check(const Mesh& mesh)
{
    if (mesh.triangles.empty())
        throw Error::Input("a mesh without faces cannot be subdivided");
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        const uvec3& t = mesh.triangles[f];
        if (t.x == t.y || t.y == t.z || t.z == t.x)
            throw Error::Input(fmt::format("face {} uses a vertex twice; it cannot be subdivided", f));
    }
}

void number_edges(LoopTopology& t)
{
    t.edge.resize(t.twin.size());
    for (std::uint32_t h = 0; h < t.twin.size(); ++h)
        if (t.twin[h] == none || h < t.twin[h]) {
            t.edge[h] = std::uint32_t(t.half_edge.size());
            t.half_edge.push_back(h);
        } else {
            t.edge[h] = t.edge[t.twin[h]];
        }
}

/// The half-edge that leaves h's start next, clockwise; `none` at a border.
std::uint32_t clockwise(const LoopTopology& t, std::uint32_t h) { return t.twin[h] == none ? none : next_half_edge(t.twin[h]); }
/// And counter-clockwise.
std::uint32_t counter_clockwise(const LoopTopology& t, std::uint32_t h) { return t.twin[next_half_edge(next_half_edge(h))]; }

/// Gives each fan of faces a vertex of its own, and finds a leaving half-edge for each.
void separate_fans(ControlMesh& control)
{
    LoopTopology& t = control.topology;
    t.leaving.assign(control.positions.size(), none);
    std::vector<bool> seen(t.twin.size(), false);
    for (std::uint32_t h = 0; h < t.twin.size(); ++h) {
        if (seen[h])
            continue;
        std::uint32_t first = h;
        for (std::uint32_t back = clockwise(t, h); back != none && back != h; back = clockwise(t, back))
            first = back;
        if (clockwise(t, first) != none)
            first = h; // a closed fan has no end
        std::uint32_t vertex = t.start(h);
        if (t.leaving[vertex] != none) {
            ++control.notes.split_vertices;
            control.source.push_back(control.source[vertex]);
            const dvec3 position = control.positions[vertex];
            control.positions.push_back(position);
            vertex = std::uint32_t(t.leaving.size());
            t.leaving.push_back(none);
        }
        t.leaving[vertex] = first;
        std::uint32_t around = first;
        do {
            seen[around] = true;
            t.triangles[around / 3][int(around % 3)] = vertex;
            around = counter_clockwise(t, around);
        } while (around != none && around != first);
    }
}

/// The number of unordered pairs of vertices that more than two half-edges join, or two in the same direction.
std::size_t count_non_manifold(const LoopTopology& t)
{
    std::vector<std::pair<std::uint32_t, std::uint32_t>> unpaired;
    for (std::uint32_t h = 0; h < t.twin.size(); ++h)
        if (t.twin[h] == none)
            unpaired.push_back(std::minmax(t.start(h), t.end(h)));
    std::sort(unpaired.begin(), unpaired.end());
    std::size_t count = 0;
    for (std::size_t i = 0; i < unpaired.size();) {
        std::size_t end = i + 1;
        while (end < unpaired.size() && unpaired[end] == unpaired[i])
            ++end;
        count += end > i + 1;
        i = end;
    }
    return count;
}

/// The edge between two vertices of the mesh (before fans were separated), or `none`.
class EdgeFinder {
public:
    explicit EdgeFinder(const ControlMesh& control)
    {
        const LoopTopology& t = control.topology;
        for (std::uint32_t e = 0; e < t.edge_count(); ++e) {
            const std::uint32_t h = t.half_edge[e];
            const auto [low, high] = std::minmax(control.source[t.start(h)], control.source[t.end(h)]);
            edges_.push_back({low, high, e});
        }
        std::sort(edges_.begin(), edges_.end());
    }
    template <class F> bool each(std::uint32_t a, std::uint32_t b, F&& f) const
    {
        const auto [low, high] = std::minmax(a, b);
        auto at = std::lower_bound(edges_.begin(), edges_.end(), std::array<std::uint32_t, 3>{low, high, 0});
        bool any = false;
        for (; at != edges_.end() && (*at)[0] == low && (*at)[1] == high; ++at, any = true)
            f((*at)[2]);
        return any;
    }

private:
    std::vector<std::array<std::uint32_t, 3>> edges_;
};

void set_tags(ControlMesh& control, const std::vector<CreaseEdge>& creases)
{
    LoopTopology& t = control.topology;
    const EdgeFinder finder(control);
    std::vector<float> tagged(t.edge_count(), -1);
    std::vector<bool> contradicted(t.edge_count(), false);
    for (const CreaseEdge& crease : creases) {
        const float sharp = std::clamp(crease.sharpness, 0.0f, infinitely_sharp);
        const bool found = finder.each(crease.a, crease.b, [&](std::uint32_t e) {
            if (tagged[e] >= 0 && tagged[e] != sharp)
                contradicted[e] = true;
            tagged[e] = std::max(tagged[e], sharp);
        });
        control.notes.ignored_tags += !found;
    }
    control.notes.contradicting_tags = std::size_t(std::count(contradicted.begin(), contradicted.end(), true));
    for (std::uint32_t e = 0; e < t.edge_count(); ++e)
        t.sharpness[e] = std::max(t.sharpness[e], tagged[e]);
}

void set_folds(ControlMesh& control, double degrees)
{
    LoopTopology& t = control.topology;
    const double limit = std::cos(degrees * std::numbers::pi / 180);
    const auto normal = [&](std::uint32_t h) {
        const uvec3& f = t.triangles[h / 3];
        const dvec3 n = glm::cross(control.positions[f.y] - control.positions[f.x], control.positions[f.z] - control.positions[f.x]);
        const double length = glm::length(n);
        return length > 0 ? n / length : dvec3(0);
    };
    for (std::uint32_t e = 0; e < t.edge_count(); ++e) {
        const std::uint32_t h = t.half_edge[e];
        if (t.twin[h] == none)
            continue;
        const dvec3 a = normal(h), b = normal(t.twin[h]);
        if (a != dvec3(0) && b != dvec3(0) && glm::dot(a, b) < limit)
            t.sharpness[e] = infinitely_sharp;
    }
}

} // namespace

void LoopTopology::gather(std::uint32_t vertex, Spokes& spokes) const
{
    spokes.neighbours.clear(), spokes.edges.clear(), spokes.half_edges.clear(), spokes.sharpness.clear();
    spokes.closed = true;
    const std::uint32_t first = leaving[vertex];
    if (first == none)
        return;
    const auto add = [&](std::uint32_t neighbour, std::uint32_t e) {
        spokes.neighbours.push_back(neighbour);
        spokes.edges.push_back(e);
        spokes.sharpness.push_back(sharpness[e]);
    };
    std::uint32_t h = first;
    do {
        add(end(h), edge[h]);
        spokes.half_edges.push_back(h);
        const std::uint32_t arriving = next_half_edge(next_half_edge(h));
        if (twin[arriving] == none) {
            add(start(arriving), edge[arriving]);
            spokes.closed = false;
            return;
        }
        h = twin[arriving];
    } while (h != first);
}

Spokes LoopTopology::gather(std::uint32_t vertex) const
{
    Spokes spokes;
    gather(vertex, spokes);
    return spokes;
}

bool LoopTopology::is_at_sharp_edge(std::uint32_t vertex) const
{
    std::uint32_t h = leaving[vertex];
    if (h == none)
        return false;
    do { // a border would be the first edge, and is sharp
        if (sharpness[edge[h]] > 0)
            return true;
        h = twin[next_half_edge(next_half_edge(h))];
    } while (h != leaving[vertex]);
    return false;
}

std::vector<std::uint8_t> creased_vertices(const LoopTopology& t)
{
    constexpr std::size_t grain = 1 << 14;
    std::vector<std::uint8_t> marks(t.vertex_count(), 0);
    const auto mark = [&](std::uint32_t v) { std::atomic_ref(marks[v]).store(1, std::memory_order_relaxed); };
    parallel_each(t.edge_count(), grain, [&](std::size_t e) {
        if (t.sharpness[e] > 0 || t.is_border(std::uint32_t(e))) {
            mark(t.start(t.half_edge[e]));
            mark(t.end(t.half_edge[e]));
        }
    });
    return marks;
}

ControlMesh make_control_mesh(const Mesh& mesh, const ControlOptions& options)
{
    check(mesh);
    ControlMesh control;
    control.positions = mesh.positions;
    control.source.resize(mesh.positions.size());
    for (std::uint32_t i = 0; i < control.source.size(); ++i)
        control.source[i] = i;
    LoopTopology& t = control.topology;
    t.triangles = mesh.triangles;
    t.twin = build_adjacency(t.triangles, mesh.positions.size()).twin;
    control.notes.non_manifold_edges = count_non_manifold(t);
    number_edges(t);
    separate_fans(control);
    control.notes.isolated_vertices = std::size_t(std::count(t.leaving.begin(), t.leaving.end(), none));
    t.sharpness.assign(t.edge_count(), 0);
    for (std::uint32_t e = 0; e < t.edge_count(); ++e)
        if (t.is_border(e))
            t.sharpness[e] = infinitely_sharp;
    if (options.tags)
        set_tags(control, mesh.creases);
    if (options.crease_angle > 0)
        set_folds(control, options.crease_angle);
    return control;
}

std::vector<std::string> notes_of(const ControlNotes& notes)
{
    std::vector<std::string> all;
    const auto say = [&](std::size_t count, const char* one, const char* many) {
        if (count > 0)
            all.push_back(counted(count, one, many));
    };
    say(notes.non_manifold_edges, "non-manifold edge, cut open", "non-manifold edges, cut open");
    say(notes.split_vertices, "vertex added where fans of faces met", "vertices added where fans of faces met");
    say(notes.isolated_vertices, "vertex without faces", "vertices without faces");
    say(notes.ignored_tags, "crease tag without an edge", "crease tags without an edge");
    say(notes.contradicting_tags, "edge with contradicting crease tags, the sharper one holds", "edges with contradicting crease tags, the sharper ones hold");
    return all;
}

} // namespace limn
