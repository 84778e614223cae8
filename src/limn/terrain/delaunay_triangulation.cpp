#include "limn/terrain/delaunay_triangulation.h"

#include <algorithm>

namespace limn {
namespace {

__extension__ using int128 = __int128;

/// Whether the angles of a quadrangle a, b at the corners c and d opposite of its diagonal a b add to more than a half turn: their sine is
/// negative. With the angles in (0, pi), that says that d is inside the circle through a, b, c.
template <class Wide> bool is_sum_reflex(const ivec2& a, const ivec2& b, const ivec2& c, const ivec2& d)
{
    const auto dot = [](const ivec2& at, const ivec2& p, const ivec2& q) {
        return std::int64_t(p.x - at.x) * (q.x - at.x) + std::int64_t(p.y - at.y) * (q.y - at.y);
    };
    const std::int64_t sin_c = DelaunayTriangulation::area2(c, a, b), cos_c = dot(c, a, b);
    const std::int64_t sin_d = DelaunayTriangulation::area2(d, b, a), cos_d = dot(d, b, a);
    return Wide(sin_c) * cos_d + Wide(cos_c) * sin_d < 0;
}

} // namespace

DelaunayTriangulation::DelaunayTriangulation(int columns, int rows)
    : is_small_(columns <= (1 << 15) && rows <= (1 << 15)) // two products of two sums of two squares
{
    const int right = columns - 1, bottom = rows - 1;
    points_ = {{0, 0}, {0, bottom}, {right, bottom}, {right, 0}};
    edges_.resize(4);
    for (int i = 0; i < 2; ++i)
        add_triangle();
    set_triangle(0, 0, 1, 2);
    set_triangle(1, 2, 3, 0);
    for (const std::uint32_t e : {0u, 1u, 3u, 4u})
        twins_[e] = none;
    link(2, 5);
}

std::uint32_t DelaunayTriangulation::add_triangle()
{
    if (!unused_.empty()) {
        const std::uint32_t t = unused_.back();
        unused_.pop_back();
        return t;
    }
    corners_.resize(corners_.size() + 3);
    twins_.resize(corners_.size());
    return std::uint32_t(triangle_count() - 1);
}

void DelaunayTriangulation::set_triangle(std::uint32_t triangle, std::uint32_t a, std::uint32_t b, std::uint32_t c)
{
    const std::uint32_t e = triangle * 3;
    corners_[e] = a, corners_[e + 1] = b, corners_[e + 2] = c;
    edges_[a] = e, edges_[b] = e + 1, edges_[c] = e + 2;
}

void DelaunayTriangulation::link(std::uint32_t half_edge, std::uint32_t twin)
{
    twins_[half_edge] = twin;
    if (twin != none)
        twins_[twin] = half_edge;
}

std::uint32_t DelaunayTriangulation::find_triangle(const ivec2& p, std::uint32_t from) const
{
    std::uint32_t e = from * 3, stayed = 0;
    while (stayed < 3) {
        if (twins_[e] != none && area2(at(e), at(next(e)), p) < 0) {
            e = next(twins_[e]);
            stayed = 1; // p is on this side of the edge that was crossed
            continue;
        }
        e = next(e);
        ++stayed;
    }
    return e / 3;
}

bool DelaunayTriangulation::is_in_circle(const ivec2& a, const ivec2& b, const ivec2& c, const ivec2& d) const
{
    return is_small_ ? is_sum_reflex<std::int64_t>(a, b, c, d) : is_sum_reflex<int128>(a, b, c, d);
}

void DelaunayTriangulation::make_fan(std::uint32_t vertex, const Star& star)
{
    const std::size_t count = star.triangles.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t t = star.triangles[i];
        set_triangle(t, star.ring[i], star.ring[(i + 1) % star.ring.size()], vertex);
        link(t * 3, star.outside[i]);
    }
    for (std::size_t i = 1; i < count; ++i)
        link(star.triangles[i - 1] * 3 + 1, star.triangles[i] * 3 + 2);
    const std::uint32_t first = star.triangles.front() * 3 + 2, last = star.triangles.back() * 3 + 1;
    if (star.is_closed)
        link(last, first);
    else
        twins_[first] = twins_[last] = none;
}

std::uint32_t DelaunayTriangulation::insert(const ivec2& p, std::uint32_t triangle, std::vector<std::uint32_t>& changed)
{
    const std::uint32_t vertex = std::uint32_t(points_.size());
    points_.push_back(p);
    edges_.push_back(none);
    const std::uint32_t e = triangle * 3;
    std::uint32_t on = none; // the edge of the triangle that the point is on
    for (std::uint32_t i = e; i < e + 3; ++i)
        if (area2(at(i), at(next(i)), p) == 0)
            on = i;
    hole_.ring.clear(), hole_.outside.clear(), hole_.triangles.clear();
    const auto add_edge = [&](std::uint32_t i) {
        hole_.ring.push_back(corners_[i]);
        hole_.outside.push_back(twins_[i]);
    };
    hole_.triangles.push_back(triangle);
    hole_.is_closed = true;
    if (on == none) {
        for (std::uint32_t i = e; i < e + 3; ++i)
            add_edge(i);
    } else {
        add_edge(next(on));
        add_edge(previous(on));
        const std::uint32_t over = twins_[on];
        if (over != none) {
            add_edge(next(over));
            add_edge(previous(over));
            hole_.triangles.push_back(over / 3);
        } else {
            hole_.ring.push_back(corners_[on]);
            hole_.is_closed = false;
        }
    }
    while (hole_.triangles.size() < hole_.outside.size())
        hole_.triangles.push_back(add_triangle());
    make_fan(vertex, hole_);
    changed.insert(changed.end(), hole_.triangles.begin(), hole_.triangles.end());
    suspects_.clear();
    for (const std::uint32_t t : hole_.triangles)
        suspects_.push_back(t * 3);
    flip_illegal(changed);
    return vertex;
}

/// Suspects are the edges opposite of the new vertex, which flips keep at the last corner of its triangles.
void DelaunayTriangulation::flip_illegal(std::vector<std::uint32_t>& changed)
{
    while (!suspects_.empty()) {
        const std::uint32_t e = suspects_.back();
        suspects_.pop_back();
        if (!is_illegal(e))
            continue;
        const std::uint32_t over = twins_[e] / 3;
        flip(e);
        changed.push_back(over);
        suspects_.push_back(e);
        suspects_.push_back(over * 3);
    }
}

bool DelaunayTriangulation::can_flip(std::uint32_t half_edge) const
{
    const std::uint32_t over = twins_[half_edge];
    if (over == none)
        return false;
    const ivec2 &a = at(half_edge), &b = at(next(half_edge)), &c = at(previous(half_edge)), &d = at(previous(over));
    return area2(c, a, d) > 0 && area2(d, b, c) > 0;
}

bool DelaunayTriangulation::is_illegal(std::uint32_t half_edge) const
{
    const std::uint32_t over = twins_[half_edge];
    return over != none && is_in_circle(at(half_edge), at(next(half_edge)), at(previous(half_edge)), at(previous(over)));
}

void DelaunayTriangulation::flip(std::uint32_t e)
{
    const std::uint32_t f = twins_[e], t = e / 3, u = f / 3;
    const std::uint32_t a = corners_[e], b = corners_[f], c = corners_[previous(e)], d = corners_[previous(f)];
    const std::uint32_t bc = twins_[next(e)], ca = twins_[previous(e)], ad = twins_[next(f)], db = twins_[previous(f)];
    set_triangle(t, a, d, c);
    set_triangle(u, d, b, c);
    link(t * 3, ad);
    link(t * 3 + 1, u * 3 + 2);
    link(t * 3 + 2, ca);
    link(u * 3, db);
    link(u * 3 + 1, bc);
}

void DelaunayTriangulation::find_star(std::uint32_t vertex, Star& star) const
{
    star.ring.clear(), star.outside.clear(), star.triangles.clear();
    std::uint32_t first = edges_[vertex];
    for (std::uint32_t e = first; twins_[e] != none;) { // clockwise to the border, or once around
        e = next(twins_[e]);
        if (e == edges_[vertex])
            break;
        first = e;
    }
    if (twins_[first] != none)
        first = edges_[vertex];
    star.is_closed = twins_[first] != none;
    for (std::uint32_t e = first;;) {
        star.ring.push_back(corners_[next(e)]);
        star.outside.push_back(twins_[next(e)]);
        star.triangles.push_back(e / 3);
        const std::uint32_t back = previous(e);
        e = twins_[back];
        if (e == none) {
            star.ring.push_back(corners_[back]);
            star.outside.push_back(none);
            break;
        }
        if (e == first)
            break;
    }
}

void DelaunayTriangulation::remove(std::uint32_t vertex, const Star& star, std::span<const std::array<std::uint8_t, 3>> filling)
{
    const std::size_t size = star.ring.size();
    inner_edges_.assign(size * size, none);
    for (std::size_t k = 0; k < filling.size(); ++k) {
        const std::array<std::uint8_t, 3>& places = filling[k];
        const std::uint32_t t = star.triangles[k];
        set_triangle(t, star.ring[places[0]], star.ring[places[1]], star.ring[places[2]]);
        for (std::uint32_t i = 0; i < 3; ++i) {
            const std::size_t from = places[i], to = places[(i + 1) % 3];
            const bool is_outer = to == (from + 1) % size;
            link(t * 3 + i, is_outer ? star.outside[from] : inner_edges_[to * size + from]); // `none` where the other side is still to come
            inner_edges_[from * size + to] = t * 3 + i;
        }
    }
    edges_[vertex] = none;
    for (std::size_t k = filling.size(); k < star.triangles.size(); ++k) {
        corners_[std::size_t(star.triangles[k]) * 3] = none;
        unused_.push_back(star.triangles[k]);
    }
}

void DelaunayTriangulation::drop(std::span<const std::uint32_t> triangles)
{
    for (const std::uint32_t t : triangles)
        for (std::uint32_t e = t * 3; e < t * 3 + 3; ++e) {
            if (twins_[e] != none)
                twins_[twins_[e]] = none;
            corners_[e] = twins_[e] = none;
        }
    std::fill(edges_.begin(), edges_.end(), none);
    for (std::uint32_t e = 0; e < corners_.size(); ++e)
        if (has_triangle(e / 3))
            edges_[corners_[e]] = e;
}

} // namespace limn
