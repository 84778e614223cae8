#include "limn/terrain/delaunay_simplify.h"

#include <vector>

#include "limn/terrain/delaunay_hole.h"

namespace limn {
namespace {

constexpr std::uint32_t rectangle_corners = 4; ///< the first vertices

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

bool has_data_at_corners(const HeightMap& map, const DelaunayTriangulation& mesh, std::uint32_t triangle)
{
    for (std::uint32_t e = triangle * 3; e < triangle * 3 + 3; ++e)
        if (!map.has_data(mesh.at(e).x, mesh.at(e).y))
            return false;
    return true;
}

bool can_flip_within(const HeightMap& map, const DelaunayTriangulation& mesh, const DelaunayBound& bound, std::uint32_t e)
{
    if (!mesh.is_illegal(e) || !mesh.can_flip(e))
        return false;
    const std::uint32_t over = mesh.twin(e);
    if (!has_data_at_corners(map, mesh, e / 3) || !has_data_at_corners(map, mesh, over / 3))
        return false;
    const ivec2 &a = mesh.at(e), &b = mesh.at(over), &c = mesh.at(DelaunayTriangulation::previous(e)), &d = mesh.at(DelaunayTriangulation::previous(over));
    return bound.holds(map, a, d, c) && bound.holds(map, d, b, c);
}

} // namespace

void simplify_within(const HeightMap& map, DelaunayTriangulation& mesh, const DelaunayBound& bound)
{
    HoleFilling filling(map, mesh, bound);
    DelaunayTriangulation::Star star;
    std::vector<std::uint8_t> stays(mesh.vertex_count());
    VertexQueue queue(mesh.vertex_count());
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        stays[v] = v < rectangle_corners || is_at_hole(map, mesh.point(v));
        if (!stays[v] && mesh.has_vertex(v))
            queue.add(v);
    }
    while (!queue.is_empty()) {
        const std::uint32_t v = queue.take();
        if (!mesh.has_vertex(v))
            continue;
        mesh.find_star(v, star);
        if (!filling.find(v, star))
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
