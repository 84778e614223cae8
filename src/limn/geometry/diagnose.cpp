#include "limn/geometry/diagnose.h"

#include <algorithm>
#include <cmath>

#include "limn/base/parallel.h"
#include "limn/geometry/clean.h"
#include "limn/geometry/radix_sort.h"
#include "limn/geometry/union_find.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1 << 14;

/// A triangle whose height is below this part of its longest edge has no area: double rounding of float coordinates.
constexpr double flat = 1e-12;

bool is_finite(const dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Vertices of half-edge h = 3*face + k.
std::uint32_t tail(const Mesh& mesh, std::uint32_t h) { return mesh.triangles[h / 3][int(h % 3)]; }
std::uint32_t head(const Mesh& mesh, std::uint32_t h) { return mesh.triangles[h / 3][int((h + 1) % 3)]; }
std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }

/// A half-edge beside the others that leave or reach the same lower vertex.
struct EdgeUse {
    std::uint32_t high, half_edge;
};

/// Counts edges by kind and joins what lies beside each of them: faces to shells, corners to fans around vertices.
class EdgeCensus {
public:
    EdgeCensus(const Mesh& mesh, const std::vector<std::uint8_t>& sound, Diagnosis& out)
        : mesh_(mesh), out_(out), faces_(mesh.triangles.size()), corners_(3 * mesh.triangles.size())
    {
        std::vector<std::uint64_t> items = half_edges_by_lower_vertex(sound);
        for (std::size_t begin = 0; begin < items.size();) {
            std::size_t end = begin;
            uses_.clear();
            for (; end < items.size() && key_of(items[end]) == key_of(items[begin]); ++end) {
                const std::uint32_t h = item_of(items[end]);
                uses_.push_back({std::max(tail(mesh, h), head(mesh, h)), h});
            }
            count_edges_at_vertex();
            begin = end;
        }
        count_shells(sound);
        count_touching_vertices(sound);
        measure_lengths();
    }

private:
    std::vector<std::uint64_t> half_edges_by_lower_vertex(const std::vector<std::uint8_t>& sound) const
    {
        std::vector<std::uint64_t> items;
        items.reserve(3 * mesh_.triangles.size());
        for (std::uint32_t h = 0; h < 3 * mesh_.triangles.size(); ++h)
            if (sound[h / 3])
                items.push_back(keyed(std::min(tail(mesh_, h), head(mesh_, h)), h));
        sort_by_key(items, std::uint32_t(mesh_.positions.size()));
        return items;
    }

    void count_edges_at_vertex()
    {
        std::sort(uses_.begin(), uses_.end(),
                  [](const EdgeUse& a, const EdgeUse& b) { return a.high != b.high ? a.high < b.high : a.half_edge < b.half_edge; });
        for (std::size_t begin = 0; begin < uses_.size();) {
            std::size_t end = begin;
            while (end < uses_.size() && uses_[end].high == uses_[begin].high)
                ++end;
            count_edge(begin, end);
            begin = end;
        }
    }

    /// One edge, with the half-edges uses_[begin, end).
    void count_edge(std::size_t begin, std::size_t end)
    {
        const std::uint32_t first = uses_[begin].half_edge;
        ++out_.edges;
        out_.border_edges += end - begin == 1;
        out_.non_manifold_edges += end - begin > 2;
        out_.misoriented_edges += end - begin == 2 && tail(mesh_, first) == tail(mesh_, uses_[begin + 1].half_edge);
        lengths_.push_back(glm::length(mesh_.positions[tail(mesh_, first)] - mesh_.positions[head(mesh_, first)]));
        for (std::size_t i = begin + 1; i < end; ++i) {
            const std::uint32_t other = uses_[i].half_edge;
            const bool same_way = tail(mesh_, first) == tail(mesh_, other);
            faces_.join(first / 3, other / 3);
            corners_.join(first, same_way ? other : next(other));
            corners_.join(next(first), same_way ? next(other) : other);
        }
    }

    void count_shells(const std::vector<std::uint8_t>& sound)
    {
        for (std::uint32_t f = 0; f < sound.size(); ++f)
            out_.shells += sound[f] && faces_.find(f) == f;
    }

    /// A vertex whose corners form more than one fan.
    void count_touching_vertices(const std::vector<std::uint8_t>& sound)
    {
        std::vector<std::uint8_t> fans(mesh_.positions.size(), 0);
        for (std::uint32_t c = 0; c < 3 * mesh_.triangles.size(); ++c)
            if (sound[c / 3] && corners_.find(c) == c) {
                std::uint8_t& count = fans[tail(mesh_, c)];
                out_.non_manifold_vertices += count == 1;
                count = std::uint8_t(std::min(count + 1, 2));
            }
    }

    void measure_lengths()
    {
        if (lengths_.empty())
            return;
        const auto middle = lengths_.begin() + std::ptrdiff_t(lengths_.size() / 2);
        std::nth_element(lengths_.begin(), middle, lengths_.end());
        out_.median_edge = *middle;
        out_.shortest_edge = *std::min_element(lengths_.begin(), middle + 1);
        out_.longest_edge = *std::max_element(middle, lengths_.end());
    }

    const Mesh& mesh_;
    Diagnosis& out_;
    UnionFind faces_, corners_;
    std::vector<EdgeUse> uses_;
    std::vector<double> lengths_;
};

/// Sums over the sound faces, in the order of blocks.
struct Sums {
    double area = 0, volume = 0;
    std::size_t no_area = 0;
};

Sums sum_faces(const Mesh& mesh, const std::vector<std::uint8_t>& sound, const dvec3& centre)
{
    std::vector<Sums> parts((sound.size() + grain - 1) / grain);
    parallel_blocks(sound.size(), grain, [&](std::size_t begin, std::size_t end) {
        Sums& sums = parts[begin / grain];
        for (std::size_t f = begin; f < end; ++f) {
            if (!sound[f])
                continue;
            const uvec3& t = mesh.triangles[f];
            const dvec3 a = mesh.positions[t.x] - centre, b = mesh.positions[t.y] - centre, c = mesh.positions[t.z] - centre;
            const double doubled = glm::length(glm::cross(b - a, c - a));
            const double longest = std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
            sums.no_area += !(doubled > flat * longest);
            sums.area += 0.5 * doubled;
            sums.volume += glm::dot(a, glm::cross(b, c)) / 6;
        }
    });
    Sums all;
    for (const Sums& part : parts)
        all = {all.area + part.area, all.volume + part.volume, all.no_area + part.no_area};
    return all;
}

/// 1 for each face with three distinct, finite vertices; counts the others.
std::vector<std::uint8_t> find_sound_faces(const Mesh& mesh, Diagnosis& out)
{
    std::vector<std::uint8_t> sound(mesh.triangles.size(), 1);
    for (std::size_t f = 0; f < sound.size(); ++f) {
        const uvec3& t = mesh.triangles[f];
        const bool finite = is_finite(mesh.positions[t.x]) && is_finite(mesh.positions[t.y]) && is_finite(mesh.positions[t.z]);
        const bool distinct = t.x != t.y && t.y != t.z && t.z != t.x;
        out.not_finite_faces += !finite;
        out.degenerate_faces += finite && !distinct;
        sound[f] = finite && distinct;
    }
    return sound;
}

/// Counts unused and not finite vertices; returns how many the sound faces use.
std::size_t count_vertices(const Mesh& mesh, const std::vector<std::uint8_t>& sound, Diagnosis& out)
{
    std::vector<std::uint8_t> use(mesh.positions.size(), 0); // 1: by a face, 2: by a sound one
    for (std::size_t f = 0; f < sound.size(); ++f)
        for (int k = 0; k < 3; ++k) {
            std::uint8_t& u = use[mesh.triangles[f][k]];
            u = std::max(u, std::uint8_t(1 + sound[f]));
        }
    std::size_t used = 0;
    for (std::size_t v = 0; v < use.size(); ++v) {
        out.unreferenced_vertices += use[v] == 0;
        out.not_finite_vertices += !is_finite(mesh.positions[v]);
        used += use[v] == 2;
        if (use[v] == 2)
            out.bounds.add(mesh.positions[v]);
    }
    return used;
}

template <class T> std::size_t bytes_of(const std::vector<T>& values) { return values.size() * sizeof(T); }

std::size_t memory_of(const Mesh& mesh)
{
    return bytes_of(mesh.positions) + bytes_of(mesh.triangles) + bytes_of(mesh.corner_normals) + bytes_of(mesh.corner_uvs) +
           bytes_of(mesh.colours) + bytes_of(mesh.face_groups) + bytes_of(mesh.polygons.offsets) + bytes_of(mesh.polygons.vertices) +
           bytes_of(mesh.creases);
}

} // namespace

Diagnosis diagnose(const Mesh& mesh)
{
    Diagnosis d;
    d.vertices = mesh.positions.size();
    d.triangles = mesh.triangles.size();
    d.memory = memory_of(mesh);
    const std::vector<std::uint8_t> sound = find_sound_faces(mesh, d);
    const std::size_t used = count_vertices(mesh, sound, d);
    const std::size_t faces = std::size_t(std::count(sound.begin(), sound.end(), 1));
    for (std::uint8_t mark : mark_duplicates(mesh))
        d.duplicate_faces += mark;
    EdgeCensus(mesh, sound, d);
    const Sums sums = sum_faces(mesh, sound, d.bounds.centre());
    d.area = sums.area;
    d.degenerate_faces += sums.no_area;
    d.euler = std::int64_t(used) - std::int64_t(d.edges) + std::int64_t(faces);
    d.closed = faces > 0 && d.border_edges == 0 && d.non_manifold_edges == 0;
    d.manifold = d.non_manifold_edges == 0 && d.non_manifold_vertices == 0;
    d.oriented = d.misoriented_edges == 0 && d.non_manifold_edges == 0;
    if (d.closed && d.oriented)
        d.volume = sums.volume;
    if (d.closed && d.oriented && d.manifold)
        d.genus = std::int64_t(d.shells) - d.euler / 2;
    return d;
}

} // namespace limn
