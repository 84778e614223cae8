#include "limn/lines/crease.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "limn/base/parallel.h"
#include "limn/geometry/unpaired_edges.h"

namespace limn {
namespace {

constexpr std::size_t grain = 8192;

// Below this height (in radii of the model) the normal of a face is that of its rounded positions, not of the shape.
constexpr float least_height = 1e-6f;

// Edges longer than this part of their shell's radius were put there one by one: they need not stand out.
constexpr float short_edge = 0.05f;

std::uint32_t tail(const LineModel& model, std::uint32_t h) { return model.welded(model.faces[h / 3][int(h % 3)]); }
std::uint32_t head(const LineModel& model, std::uint32_t h) { return model.welded(model.faces[h / 3][int((h + 1) % 3)]); }

float edge_length(const LineModel& model, std::uint32_t h)
{
    return glm::distance(model.positions[tail(model, h)], model.positions[head(model, h)]);
}

std::uint32_t longest_half_edge(const LineModel& model, std::uint32_t face)
{
    std::uint32_t longest = 3 * face;
    for (std::uint32_t h = 3 * face + 1; h < 3 * face + 3; ++h)
        if (edge_length(model, h) > edge_length(model, longest))
            longest = h;
    return longest;
}

/// The unit normal, or 0 for a sliver.
vec3 own_normal(const LineModel& model, std::uint32_t face)
{
    const uvec3 t = model.faces[face];
    const vec3 a = model.positions[t.y] - model.positions[t.x], b = model.positions[t.z] - model.positions[t.x], c = b - a;
    const vec3 normal = glm::cross(a, b);
    const float twice_area = glm::length(normal);
    const float longest = std::sqrt(std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)}));
    return twice_area > least_height * longest ? normal / twice_area : vec3(0);
}

std::vector<vec3> face_normals(const LineModel& model)
{
    std::vector<vec3> own(model.faces.size());
    parallel_each(own.size(), grain, [&](std::size_t f) { own[f] = own_normal(model, std::uint32_t(f)); });
    std::vector<vec3> normals = own;
    parallel_each(own.size(), grain, [&](std::size_t f) {
        if (own[f] != vec3(0))
            return;
        const std::uint32_t other = model.solid().twin[longest_half_edge(model, std::uint32_t(f))];
        if (other != none)
            normals[f] = own[other / 3];
    });
    return normals;
}

std::vector<UnpairedEdge> unpaired_edges(const LineModel& model)
{
    return find_unpaired_edges(model.solid(), 0, model.solid().twin.size(), [&](std::uint32_t h) { return tail(model, h); });
}

/// The edge of half-edge h with g of another face. The angle is signed by the side on which the other face's tip lies.
FeatureEdge edge_between(const LineModel& model, const std::vector<vec3>& normals, std::uint32_t h, std::uint32_t g)
{
    FeatureEdge edge = {tail(model, h), head(model, h), h / 3, g / 3, 0, true};
    const bool same_way = tail(model, h) == tail(model, g);
    const vec3 n = normals[h / 3], m = same_way ? -normals[g / 3] : normals[g / 3];
    const vec3 along = model.positions[edge.b] - model.positions[edge.a];
    const float sine = glm::length(glm::cross(n, m)), turn = glm::dot(glm::cross(n, m), along);
    const float angle = std::atan2(sine, glm::dot(n, m));
    edge.angle = n == vec3(0) || m == vec3(0) ? 0 : (turn < 0 ? -angle : angle);
    return edge;
}

std::uint32_t find_root(std::vector<std::uint32_t>& parent, std::uint32_t v)
{
    while (parent[v] != v)
        v = parent[v] = parent[parent[v]];
    return v;
}

/// Half the diagonal of each shell's box.
std::vector<float> shell_radii(const LineModel& model)
{
    const std::size_t shells = model.component.empty() ? 0 : std::size_t(*std::max_element(model.component.begin(), model.component.end())) + 1;
    std::vector<vec3> low(shells, vec3(HUGE_VALF)), high(shells, vec3(-HUGE_VALF));
    for (std::size_t f = 0; f < model.faces.size(); ++f)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t s = model.component[f];
            low[s] = glm::min(low[s], model.positions[model.faces[f][k]]);
            high[s] = glm::max(high[s], model.positions[model.faces[f][k]]);
        }
    std::vector<float> radii(shells);
    for (std::size_t s = 0; s < shells; ++s)
        radii[s] = glm::distance(low[s], high[s]) / 2;
    return radii;
}

/// Leaves out the connected sets of edges whose total length is below `min_length` radii of their shell.
void drop_short_sets(const LineModel& model, const std::vector<float>& shell_radius, std::vector<FeatureEdge>& edges, double min_length)
{
    std::vector<std::uint32_t> parent(model.vertex_count());
    std::iota(parent.begin(), parent.end(), 0u);
    for (const FeatureEdge& e : edges)
        parent[find_root(parent, e.b)] = find_root(parent, e.a);
    std::vector<double> length(model.vertex_count(), 0);
    for (const FeatureEdge& e : edges)
        length[find_root(parent, e.a)] += double(glm::distance(model.positions[e.a], model.positions[e.b]));
    std::erase_if(edges, [&](const FeatureEdge& e) {
        return e.manifold && length[find_root(parent, e.a)] < min_length * double(shell_radius[model.component[e.face]]);
    });
}

/// The smaller bend at the other two edges of the face of half-edge h: 0 where the face continues in a flat one.
float bend_beside(const LineModel& model, const std::vector<vec3>& normals, std::uint32_t h)
{
    float least = std::numbers::pi_v<float>;
    for (std::uint32_t g = next_half_edge(h); g != h; g = next_half_edge(g)) {
        const std::uint32_t other = model.solid().twin[g];
        least = std::min(least, other == none ? 0.0f : std::abs(edge_between(model, normals, g, other).angle));
    }
    return least;
}

struct CreaseTest {
    const LineModel& model;
    std::vector<vec3> normals;
    std::vector<float> shell_radius;
    float limit, prominence;
    float flat = std::min(1.0f, std::cos(limit) + 1e-4f); ///< normals with a larger cosine surely bend less than the limit

    bool is_flat(std::uint32_t h, std::uint32_t g) const { return glm::dot(normals[h / 3], normals[g / 3]) > flat; }
    bool bends_enough(const FeatureEdge& edge) const { return std::abs(edge.angle) >= limit; }
    bool lies_in_rounding(const FeatureEdge& edge, std::uint32_t h) const;
};

/// True for a short edge of a surface that bends nearly as much beside it: a rounded rim cut coarsely, or noise.
bool CreaseTest::lies_in_rounding(const FeatureEdge& edge, std::uint32_t h) const
{
    if (edge_length(model, h) > short_edge * shell_radius[model.component[edge.face]])
        return false;
    const float beside = std::max(bend_beside(model, normals, h), bend_beside(model, normals, model.solid().twin[h]));
    return std::abs(edge.angle) < prominence * beside;
}

std::vector<FeatureEdge> paired_creases(const CreaseTest& test)
{
    const LineModel& model = test.model;
    return parallel_collect<FeatureEdge>(model.solid().twin.size(), 3 * grain, [&](std::size_t begin, std::size_t end, auto& out) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t h = std::uint32_t(i), g = model.solid().twin[h];
            if (g == none || g < h || test.is_flat(h, g))
                continue;
            const FeatureEdge edge = edge_between(model, test.normals, h, g);
            if (test.bends_enough(edge) && !test.lies_in_rounding(edge, h))
                out.push_back(edge);
        }
    });
}

void add_unpaired_creases(const CreaseTest& test, std::vector<FeatureEdge>& creases)
{
    for_each_unpaired(unpaired_edges(test.model), [&](const UnpairedEdge* e, std::size_t count) {
        if (count < 2)
            return;
        FeatureEdge edge = edge_between(test.model, test.normals, e[0].half_edge, e[1].half_edge);
        edge.manifold = count == 2;
        if (!edge.manifold || test.bends_enough(edge))
            creases.push_back(edge);
    });
}

void sort_by_half_edge(const LineModel& model, std::vector<FeatureEdge>& edges)
{
    const auto key = [&](const FeatureEdge& e) {
        const uvec3 t = model.faces[e.face];
        return std::pair(e.face, model.welded(t.x) == e.a ? 0 : (model.welded(t.y) == e.a ? 1 : 2));
    };
    std::sort(edges.begin(), edges.end(), [&](const FeatureEdge& x, const FeatureEdge& y) { return key(x) < key(y); });
}

} // namespace

std::vector<FeatureEdge> find_creases(const LineModel& model, const CreaseOptions& options)
{
    // An edge of exactly the asked angle is a crease, whatever the last bit of its normals.
    const float limit = std::max(float(options.angle * std::numbers::pi / 180) - 1e-4f, 1e-3f);
    const CreaseTest test = {model, face_normals(model), shell_radii(model), limit, float(options.prominence)};
    std::vector<FeatureEdge> creases = paired_creases(test);
    add_unpaired_creases(test, creases);
    sort_by_half_edge(model, creases);
    if (options.min_length > 0 && !creases.empty())
        drop_short_sets(model, test.shell_radius, creases, options.min_length);
    return creases;
}

std::vector<FeatureEdge> find_borders(const LineModel& model)
{
    std::vector<FeatureEdge> borders;
    for_each_unpaired(unpaired_edges(model), [&](const UnpairedEdge* e, std::size_t count) {
        if (count == 1)
            borders.push_back({tail(model, e->half_edge), head(model, e->half_edge), e->half_edge / 3});
    });
    sort_by_half_edge(model, borders);
    return borders;
}

std::vector<Segment> edge_segments(const LineModel& model, std::span<const FeatureEdge> edges)
{
    std::vector<Segment> segments(edges.size());
    parallel_each(edges.size(), grain, [&](std::size_t i) {
        const FeatureEdge& e = edges[i];
        segments[i] = {model.positions[e.a], model.positions[e.b], 1, 1, e.face, e.a, e.b, e.other, true};
    });
    return segments;
}

} // namespace limn
