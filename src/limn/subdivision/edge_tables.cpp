#include "limn/subdivision/edge_tables.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/subdivision/loop_limit.h"
#include "limn/subdivision/local_refinement.h"

namespace limn {
namespace {

constexpr std::size_t grain = 2048;
constexpr int most_levels = 12;

/// The edges around one end, turned so that the edge comes first where they are closed.
struct Ring {
    RingKey key;
    std::vector<std::uint32_t> neighbours;
};

Ring ring_at(const LoopTopology& t, std::uint32_t vertex, std::uint32_t edge, Spokes& spokes)
{
    t.gather(vertex, spokes);
    const auto at = std::find(spokes.edges.begin(), spokes.edges.end(), edge) - spokes.edges.begin();
    Ring ring{{spokes.closed, spokes.closed ? 0 : std::uint32_t(at), spokes.sharpness}, spokes.neighbours};
    if (spokes.closed) {
        std::rotate(ring.key.sharpness.begin(), ring.key.sharpness.begin() + at, ring.key.sharpness.end());
        std::rotate(ring.neighbours.begin(), ring.neighbours.begin() + at, ring.neighbours.end());
    }
    return ring;
}

/// How the two rings of an edge hang together. Faces and points of a ring are numbered as its edges: face i lies between points i and i + 1.
class RingPair {
public:
    explicit RingPair(const EdgeKey& key) : start_(key.start), end_(key.end) {}

    std::size_t start_faces() const { return faces(start_); }
    std::size_t end_faces() const { return faces(end_); }
    bool has_left() const { return start_.closed || start_.at + 1 < start_.size(); }
    bool has_right() const { return start_.closed || start_.at > 0; }
    /// Within the ring of the end: the faces at the left and at the right of the edge, and their points away from it.
    std::size_t left_face() const { return before(end_.at); }
    std::size_t right_face() const { return end_.at; }
    bool is_left_point(std::size_t j) const { return has_left() && j == before(end_.at); }
    bool is_right_point(std::size_t j) const { return has_right() && j == (end_.at + 1) % end_.size(); }
    bool is_shared(std::size_t j) const { return j == end_.at || is_left_point(j) || is_right_point(j); }
    /// And these points and faces within the ring of the start.
    std::size_t left_of_start() const { return (start_.at + 1) % start_.size(); }
    std::size_t right_of_start() const { return (start_.at + start_.size() - 1) % start_.size(); }

private:
    static std::size_t faces(const RingKey& ring) { return ring.size() - (ring.closed ? 0 : 1); }
    std::size_t before(std::size_t j) const { return (j + end_.size() - 1) % end_.size(); }

    const RingKey &start_, &end_;
};

/// Calls f(j) for the points of the end's ring that are not in the support yet, in their order.
template <class F> void each_new_point(const EdgeKey& key, F&& f)
{
    const RingPair pair(key);
    for (std::size_t j = 0; j < key.end.size(); ++j)
        if (!pair.is_shared(j))
            f(j);
}

/// The support as a mesh of its own, cut open where two of its vertices are the same in the mesh that it comes from.
class SupportMesh {
public:
    explicit SupportMesh(const EdgeKey& key) : key_(key), pair_(key)
    {
        number_points();
        add_faces();
        join(pair_.start_faces(), key.start, [](std::size_t i, std::size_t k) { return 3 * i + k; });
        join(pair_.end_faces(), key.end, [&](std::size_t j, std::size_t k) { return half_edge_of_end(j, k); });
        finish_topology(mesh_, 1 + key.start.size() + new_points_, sharpness_);
    }
    const LoopTopology& mesh() const { return mesh_; }
    bool has_left() const { return pair_.has_left(); }
    /// The half-edge that runs along the edge, from start to end where there is a face on the left, else the other way.
    std::uint32_t along() const { return std::uint32_t(has_left() ? 3 * key_.start.at : 3 * pair_.right_of_start() + 2); }

private:
    void number_points()
    {
        point_.resize(key_.end.size());
        point_[key_.end.at] = 0;
        for (std::size_t j = 0; j < key_.end.size(); ++j)
            if (pair_.is_left_point(j))
                point_[j] = std::uint32_t(1 + pair_.left_of_start());
            else if (pair_.is_right_point(j))
                point_[j] = std::uint32_t(1 + pair_.right_of_start());
        each_new_point(key_, [&](std::size_t j) { point_[j] = std::uint32_t(1 + key_.start.size() + new_points_++); });
    }
    bool is_faces_of_start(std::size_t j) const
    {
        return (pair_.has_left() && j == pair_.left_face()) || (pair_.has_right() && j == pair_.right_face());
    }
    void add_faces()
    {
        const std::size_t n = key_.start.size(), m = key_.end.size();
        for (std::size_t i = 0; i < pair_.start_faces(); ++i)
            mesh_.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
        first_half_edge_.resize(pair_.end_faces());
        const std::uint32_t end = 1 + key_.start.at;
        for (std::size_t j = 0; j < pair_.end_faces(); ++j)
            if (!is_faces_of_start(j)) {
                first_half_edge_[j] = std::uint32_t(3 * mesh_.triangles.size());
                mesh_.triangles.push_back({end, point_[j], point_[(j + 1) % m]});
            }
        mesh_.twin.assign(3 * mesh_.triangles.size(), none);
        sharpness_.assign(3 * mesh_.triangles.size(), 0);
    }
    /// Half-edge k of face j in the ring of the end: k = 0 leaves the end, 2 comes back to it.
    std::size_t half_edge_of_end(std::size_t j, std::size_t k) const
    {
        if (pair_.has_left() && j == pair_.left_face())
            return 3 * key_.start.at + (k + 1) % 3;
        if (pair_.has_right() && j == pair_.right_face())
            return 3 * pair_.right_of_start() + (k + 2) % 3;
        return first_half_edge_[j] + k;
    }
    /// Twins and sharpness of the edges around one end.
    template <class F> void join(std::size_t faces, const RingKey& ring, F&& half_edge)
    {
        for (std::size_t i = 0; i < faces; ++i) {
            const std::size_t next = (i + 1) % ring.size();
            const std::size_t leaving = half_edge(i, 0), arriving = half_edge(i, 2);
            sharpness_[leaving] = ring.sharpness[i];
            sharpness_[arriving] = ring.sharpness[next];
            if (next < faces) {
                mesh_.twin[arriving] = std::uint32_t(half_edge(next, 0));
                mesh_.twin[half_edge(next, 0)] = std::uint32_t(arriving);
            }
        }
    }

    const EdgeKey& key_;
    RingPair pair_;
    LoopTopology mesh_;
    std::vector<std::uint32_t> point_;           ///< per point of the end's ring: its number in the support
    std::vector<std::uint32_t> first_half_edge_; ///< per face of the end that is not the start's as well
    std::vector<float> sharpness_;               ///< per half-edge
    std::size_t new_points_ = 0;
};

/// The pieces of an edge, from its start to its end, after some steps.
std::vector<std::uint32_t> refine_along(LocalRefinement& mesh, std::uint32_t along, bool forward, int levels)
{
    std::vector<std::uint32_t> pieces = {along};
    for (int level = 0; level < levels; ++level) {
        std::vector<std::uint32_t> halves;
        for (const std::uint32_t h : pieces) {
            halves.push_back(forward ? first_half(h) : last_half(h));
            halves.push_back(forward ? last_half(h) : first_half(h));
        }
        mesh.step(halves);
        pieces = std::move(halves);
    }
    return pieces;
}

/// A half-edge that leaves each point of the pieces on one side of them.
std::vector<std::uint32_t> corners_along(std::span<const std::uint32_t> pieces, bool leaving_first)
{
    std::vector<std::uint32_t> corners;
    if (leaving_first) { // each piece leaves its first point
        corners.assign(pieces.begin(), pieces.end());
        corners.push_back(next_half_edge(pieces.back()));
    } else {
        corners.push_back(next_half_edge(pieces.front()));
        corners.insert(corners.end(), pieces.begin(), pieces.end());
    }
    return corners;
}

std::vector<std::uint32_t> twins(const LoopTopology& t, std::vector<std::uint32_t> half_edges)
{
    for (std::uint32_t& h : half_edges)
        h = t.twin[h];
    return half_edges;
}

/// One column of each row of one side.
void set_column(EdgeTable& table, EdgeTable::Side side, std::size_t j, const LoopTopology& t, std::span<const dvec3> values, std::span<const std::uint32_t> corners)
{
    const std::size_t s = table.support;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const LimitPoint point = limit_point(t, values, corners[i]);
        double* row = &table.weights[side][3 * s * i];
        row[j] = point.position.x, row[s + j] = point.u.x, row[2 * s + j] = point.v.x;
    }
}

/// Of one edge: what the table of its kind is found by, and the vertices of its support.
struct Surroundings {
    EdgeKey key;
    std::vector<std::uint32_t> support;
};

Surroundings surroundings(const LoopTopology& t, const DirectedEdge& edge, Spokes& spokes)
{
    const std::uint32_t h = t.half_edge[edge.edge], end = t.start(h) == edge.start ? t.end(h) : t.start(h);
    Ring first = ring_at(t, edge.start, edge.edge, spokes), second = ring_at(t, end, edge.edge, spokes);
    Surroundings n{{std::move(first.key), std::move(second.key)}, {edge.start}};
    n.support.insert(n.support.end(), first.neighbours.begin(), first.neighbours.end());
    each_new_point(n.key, [&](std::size_t j) { n.support.push_back(second.neighbours[j]); });
    return n;
}

/// A smooth edge to valence 6: its key is known by the valence.
bool is_plain(const EdgeKey& key) { return key.start.is_smooth() && key.end.is_smooth() && key.end.size() == 6; }

/// Numbers the keys in the order in which they are met.
class KeyNumbers {
public:
    std::uint32_t of(const EdgeKey& key)
    {
        const auto [at, is_new] = number_.try_emplace(key, std::uint32_t(keys_.size()));
        if (is_new)
            keys_.push_back(&at->first);
        return at->second;
    }
    std::uint32_t of_plain(std::uint32_t valence)
    {
        if (valence >= plain_.size())
            plain_.resize(valence + 1, none);
        if (plain_[valence] == none)
            plain_[valence] = of(smooth_edge_key(valence));
        return plain_[valence];
    }
    const std::vector<const EdgeKey*>& keys() const { return keys_; }

private:
    std::map<EdgeKey, std::uint32_t> number_;
    std::vector<const EdgeKey*> keys_; ///< into the map
    std::vector<std::uint32_t> plain_; ///< by valence
};

} // namespace

bool RingKey::is_smooth() const
{
    return closed && std::none_of(sharpness.begin(), sharpness.end(), [](float s) { return s > 0; });
}

EdgeKey smooth_edge_key(std::uint32_t valence) { return {{true, 0, std::vector<float>(valence)}, {true, 0, std::vector<float>(6)}}; }

EdgeTable make_edge_table(const EdgeKey& key, int levels)
{
    if (levels < 0 || levels > most_levels)
        throw Error::Input(fmt::format("a table of {} levels: 0 to {} are possible", levels, most_levels));
    const SupportMesh support(key);
    LocalRefinement mesh(support.mesh());
    const std::vector<std::uint32_t> pieces = refine_along(mesh, support.along(), support.has_left(), levels);
    const LoopTopology& t = mesh.topology();
    const std::vector<std::uint32_t> corners = corners_along(pieces, support.has_left());
    EdgeTable table;
    table.levels = levels;
    table.support = support.mesh().vertex_count();
    table.two_sided = key.start.sharpness[key.start.at] >= infinitely_sharp && t.twin[pieces[0]] != none;
    table.weights[EdgeTable::left].resize(3 * table.support * table.rows());
    std::vector<std::uint32_t> right_corners;
    if (table.two_sided) {
        table.weights[EdgeTable::right].resize(3 * table.support * table.rows());
        right_corners = corners_along(twins(t, pieces), false);
    }
    for (std::size_t j = 0; j < table.support; ++j) {
        std::vector<dvec3> impulse(table.support, dvec3(0));
        impulse[j].x = 1; // in one direction only: the limit's cross products are 0, and nothing depends on them
        const std::vector<dvec3> values = mesh.refined(std::move(impulse));
        set_column(table, EdgeTable::left, j, t, values, corners);
        set_column(table, EdgeTable::right, j, t, values, right_corners);
    }
    return table;
}

EdgePoint limit_of_row(std::span<const double> row, std::span<const std::uint32_t> support, std::span<const dvec3> positions)
{
    const std::size_t s = support.size();
    const double *p = row.data(), *pu = p + s, *pv = pu + s;
    dvec3 position(0), u(0), v(0);
    for (std::size_t j = 0; j < s; ++j) {
        const dvec3& q = positions[support[j]];
        position += p[j] * q;
        u += pu[j] * q;
        v += pv[j] * q;
    }
    const dvec3 normal = glm::cross(u, v);
    const double length = glm::length(normal);
    return {position, length > 0 ? normal / length : dvec3(0)};
}

std::array<double, 30> regular_edge_row(double t)
{
    const double u = 1 - t;
    const double u2 = u * u, u3 = u2 * u, u4 = u3 * u, t2 = t * t, t3 = t2 * t, t4 = t3 * t;
    const double beside = u4 + 6 * u3 * t + 12 * u2 * t2 + 6 * u * t3 + t4;
    const double beside_along = 2 * u3 + 6 * u2 * t - 6 * u * t2 - 2 * t3;
    const double before = u4 + 2 * u3 * t, before_along = -2 * u3 - 6 * u2 * t;
    const double after = t4 + 2 * u * t3, after_along = 2 * t3 + 6 * u * t2;
    std::array<double, 30> row = {
        // position: A, B, r1 … r5, q0, q1, q2
        6 * u4 + 24 * u3 * t + 24 * u2 * t2 + 8 * u * t3 + t4, u4 + 8 * u3 * t + 24 * u2 * t2 + 24 * u * t3 + 6 * t4,
        beside, before, u4, before, beside, after, t4, after,
        // along
        -24 * u2 * t - 24 * u * t2 - 4 * t3, 4 * u3 + 24 * u2 * t + 24 * u * t2,
        beside_along, before_along, -4 * u3, before_along, beside_along, after_along, 4 * t3, after_along,
        // towards r1
        -12 * u2 * t - 12 * u * t2 - 2 * t3, 2 * u3 + 12 * u2 * t + 12 * u * t2,
        4 * u3 + 18 * u2 * t + 12 * u * t2 + 2 * t3, 2 * u3, -2 * u3, -4 * u3 - 6 * u2 * t, -2 * u3 - 12 * u2 * t - 18 * u * t2 - 4 * t3,
        -2 * t3, 2 * t3, 6 * u * t2 + 4 * t3};
    for (double& weight : row)
        weight /= 12;
    return row;
}

EdgeStencils::EdgeStencils(const LoopTopology& t, std::span<const DirectedEdge> edges, int levels)
{
    std::vector<std::uint32_t> size(edges.size()), plain_valence(edges.size(), none);
    vertices_ = parallel_collect<std::uint32_t>(edges.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& out) {
        Spokes spokes;
        for (std::size_t i = begin; i < end; ++i) {
            const Surroundings n = surroundings(t, edges[i], spokes);
            size[i] = std::uint32_t(n.support.size());
            if (is_plain(n.key))
                plain_valence[i] = std::uint32_t(n.key.start.size());
            out.insert(out.end(), n.support.begin(), n.support.end());
        }
    });
    offset_.assign(1, 0);
    for (const std::uint32_t s : size)
        offset_.push_back(offset_.back() + s);
    KeyNumbers numbers;
    Spokes spokes;
    table_.resize(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i)
        table_[i] = plain_valence[i] != none ? numbers.of_plain(plain_valence[i]) : numbers.of(surroundings(t, edges[i], spokes).key);
    tables_.resize(numbers.keys().size());
    parallel_each(tables_.size(), 1, [&](std::size_t k) { tables_[k] = make_edge_table(*numbers.keys()[k], levels); });
}

} // namespace limn
