#include "limn/terrain/delaunay_simplify.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "limn/terrain/delaunay_star.h"

namespace limn {
namespace {

/// Vertices to look at, each once at a time, first in first out.
class VertexQueue {
public:
    explicit VertexQueue(std::size_t vertices) : is_waiting_(vertices) {}
    void add(std::uint32_t vertex)
    {
        if (!is_waiting_[vertex])
            waiting_.push_back(vertex);
        is_waiting_[vertex] = true;
    }
    bool is_empty() const { return next_ == waiting_.size(); }
    std::uint32_t take()
    {
        const std::uint32_t vertex = waiting_[next_++];
        is_waiting_[vertex] = false;
        return vertex;
    }

private:
    std::vector<std::uint32_t> waiting_;
    std::vector<std::uint8_t> is_waiting_;
    std::size_t next_ = 0;
};

/// Near ones after each other, for the cache; fewer vertices stay, too, than in the order in which they were inserted.
std::vector<std::uint32_t> vertices_row_by_row(const HeightMap& map, const DelaunayTriangulation& mesh)
{
    std::vector<std::pair<std::size_t, std::uint32_t>> by_sample;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
        if (mesh.has_vertex(v))
            by_sample.emplace_back(map.index(mesh.point(v).x, mesh.point(v).y), v);
    std::sort(by_sample.begin(), by_sample.end());
    std::vector<std::uint32_t> out;
    out.reserve(by_sample.size());
    for (const auto& [sample, v] : by_sample)
        out.push_back(v);
    return out;
}

/// For each vertex, whether it is the end of more than one chain of triangles.
std::vector<std::uint8_t> vertices_where_borders_touch(const DelaunayTriangulation& mesh)
{
    std::vector<std::uint8_t> borders(mesh.vertex_count()), touch(mesh.vertex_count());
    for (std::uint32_t e = 0; e < mesh.triangle_count() * 3; ++e)
        if (mesh.has_triangle(e / 3) && mesh.twin(e) == none)
            touch[mesh.corner(e)] = borders[mesh.corner(e)]++ > 0;
    return touch;
}

/// Whether a mesh without a vertex can have the same outline.
bool can_go(const DelaunayTriangulation& mesh, std::uint32_t vertex, const DelaunayTriangulation::Star& star)
{
    if (star.is_closed)
        return true;
    const ivec2 &p = mesh.point(star.ring.front()), &q = mesh.point(vertex), &r = mesh.point(star.ring.back());
    const bool is_straight = DelaunayTriangulation::area2(p, q, r) == 0, is_between = glm::dot(dvec2(p - q), dvec2(r - q)) < 0;
    return is_straight && is_between;
}

bool can_flip_within(const HeightMap& map, const DelaunayTriangulation& mesh, const DelaunayBound& bound, std::uint32_t e)
{
    if (!mesh.is_illegal(e) || !mesh.can_flip(e))
        return false;
    const std::uint32_t over = mesh.twin(e);
    const ivec2 &a = mesh.at(e), &b = mesh.at(over), &c = mesh.at(DelaunayTriangulation::previous(e)),
                &d = mesh.at(DelaunayTriangulation::previous(over));
    return bound.holds(map, a, d, c) && bound.holds(map, d, b, c);
}

} // namespace

void simplify_within(const HeightMap& map, DelaunayTriangulation& mesh, const DelaunayBound& bound)
{
    StarFilling filling(map, mesh, bound);
    DelaunayTriangulation::Star star;
    const std::vector<std::uint8_t> stays = vertices_where_borders_touch(mesh);
    VertexQueue queue(mesh.vertex_count());
    for (const std::uint32_t v : vertices_row_by_row(map, mesh))
        if (!stays[v])
            queue.add(v);
    while (!queue.is_empty()) {
        const std::uint32_t v = queue.take();
        if (!mesh.has_vertex(v))
            continue;
        mesh.find_star(v, star);
        if (!can_go(mesh, v, star) || !filling.find(v, star))
            continue;
        mesh.remove(v, star, filling.triangles());
        for (const std::uint32_t neighbour : star.ring)
            if (!stays[neighbour])
                queue.add(neighbour);
    }
}

void flip_within(const HeightMap& map, DelaunayTriangulation& mesh, const DelaunayBound& bound)
{
    std::vector<std::uint32_t> suspects;
    for (std::uint32_t e = std::uint32_t(mesh.triangle_count()) * 3; e-- > 0;)
        if (mesh.has_triangle(e / 3))
            suspects.push_back(e);
    while (!suspects.empty()) {
        const std::uint32_t e = suspects.back();
        suspects.pop_back();
        if (!can_flip_within(map, mesh, bound, e))
            continue;
        const std::uint32_t t = e / 3, over = mesh.twin(e) / 3;
        mesh.flip(e);
        for (const std::uint32_t changed : {t, over})
            for (std::uint32_t i = 0; i < 3; ++i)
                suspects.push_back(changed * 3 + i);
    }
}

} // namespace limn
