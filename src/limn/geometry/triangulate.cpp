#include "limn/geometry/triangulate.h"

#include <cmath>
#include <numeric>
#include <vector>

namespace limn {
namespace {

constexpr std::size_t ear_clipping_limit = 4096;

/// Newell's normal of a polygon: twice its vector area.
dvec3 newell_normal(std::span<const dvec3> p)
{
    dvec3 normal(0);
    for (std::size_t i = 1; i + 1 < p.size(); ++i)
        normal += glm::cross(p[i] - p[0], p[i + 1] - p[0]);
    return normal;
}

/// The polygon in the coordinate plane where it appears largest, counter-clockwise.
std::vector<dvec2> flatten(std::span<const dvec3> p, const dvec3& normal)
{
    const dvec3 size = glm::abs(normal);
    const int drop = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int u = (drop + 1) % 3, v = (drop + 2) % 3;
    std::vector<dvec2> flat;
    flat.reserve(p.size());
    for (const dvec3& q : p)
        flat.push_back(normal[drop] >= 0 ? dvec2(q[u], q[v]) : dvec2(q[v], q[u]));
    return flat;
}

/// Twice the signed area of a triangle; positive where it is counter-clockwise.
double turn(const dvec2& a, const dvec2& b, const dvec2& c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

bool is_convex(std::span<const dvec2> p)
{
    const std::size_t n = p.size();
    for (std::size_t i = 0; i < n; ++i)
        if (turn(p[i], p[(i + 1) % n], p[(i + 2) % n]) < 0)
            return false;
    return true;
}

void fan(std::uint32_t first, std::uint32_t corners, std::span<CornerTriple> triangles)
{
    for (std::uint32_t i = 0; i + 2 < corners; ++i)
        triangles[i] = {first, (first + i + 1) % corners, (first + i + 2) % corners};
}

/// A doubly linked ring of the corners that are not cut off yet.
struct Ring {
    std::vector<std::uint32_t> next, previous;

    explicit Ring(std::size_t n) : next(n), previous(n)
    {
        for (std::size_t i = 0; i < n; ++i) {
            next[i] = std::uint32_t((i + 1) % n);
            previous[i] = std::uint32_t((i + n - 1) % n);
        }
    }
    void remove(std::uint32_t i)
    {
        next[previous[i]] = next[i];
        previous[next[i]] = previous[i];
    }
};

/// An ear is a convex corner whose triangle holds no other corner. Corners at the position of one of the triangle's own
/// corners (a hole joined by a bridge visits them twice) do not count.
bool is_ear(std::span<const dvec2> p, const Ring& ring, std::uint32_t b)
{
    const std::uint32_t a = ring.previous[b], c = ring.next[b];
    if (!(turn(p[a], p[b], p[c]) > 0))
        return false;
    for (std::uint32_t i = ring.next[c]; i != a; i = ring.next[i]) {
        if (p[i] == p[a] || p[i] == p[b] || p[i] == p[c])
            continue;
        if (turn(p[a], p[b], p[i]) >= 0 && turn(p[b], p[c], p[i]) >= 0 && turn(p[c], p[a], p[i]) >= 0)
            return false;
    }
    return true;
}

/// The corners that may be ears: all at first, then the neighbours of each that is cut off, then all that are left.
class Candidates {
public:
    explicit Candidates(std::size_t n) : queue_(n), is_cut_(n, 0) { std::iota(queue_.begin(), queue_.end(), 0u); }

    void cut(const CornerTriple& ear)
    {
        is_cut_[ear[1]] = 1;
        queue_.insert(queue_.end(), {ear[0], ear[2]});
        progress_ = true;
    }
    /// @return `none` where none is left that has not been tried since the last cut
    std::uint32_t next()
    {
        for (;;) {
            if (at_ == queue_.size() && !refill())
                return none;
            const std::uint32_t corner = queue_[at_++];
            if (!is_cut_[corner])
                return corner;
        }
    }

private:
    bool refill()
    {
        queue_.clear();
        at_ = 0;
        for (std::uint32_t i = 0; progress_ && i < is_cut_.size(); ++i)
            if (!is_cut_[i])
                queue_.push_back(i);
        progress_ = false;
        return !queue_.empty();
    }

    std::vector<std::uint32_t> queue_;
    std::vector<std::uint8_t> is_cut_;
    std::size_t at_ = 0;
    bool progress_ = false;
};

void clip_ears(std::span<const dvec2> p, std::span<CornerTriple> triangles)
{
    Ring ring(p.size());
    Candidates candidates(p.size());
    std::size_t trials_left = 32 * p.size();
    std::uint32_t corner = 0;
    for (CornerTriple& triangle : triangles) {
        std::uint32_t ear = none;
        while (ear == none && trials_left > 0) {
            --trials_left;
            const std::uint32_t candidate = candidates.next();
            if (candidate == none)
                break;
            if (is_ear(p, ring, candidate))
                ear = candidate;
        }
        if (ear == none) { // the polygon crosses itself or is degenerate: the rest is cut as it comes
            trials_left = 0;
            ear = corner;
        }
        triangle = {ring.previous[ear], ear, ring.next[ear]};
        ring.remove(ear);
        candidates.cut(triangle);
        corner = triangle[2];
    }
}

} // namespace

void triangulate(std::span<const dvec3> positions, std::span<CornerTriple> triangles)
{
    const std::uint32_t corners = std::uint32_t(positions.size());
    if (corners == 3)
        return fan(0, corners, triangles);
    const dvec3 normal = newell_normal(positions);
    if (!std::isfinite(glm::dot(normal, normal)))
        return fan(0, corners, triangles);
    if (corners == 4) {
        const dvec3 first = glm::cross(positions[1] - positions[0], positions[2] - positions[0]);
        const dvec3 second = glm::cross(positions[2] - positions[0], positions[3] - positions[0]);
        return fan(glm::dot(first, normal) < 0 || glm::dot(second, normal) < 0 ? 1 : 0, corners, triangles);
    }
    const std::vector<dvec2> flat = flatten(positions, normal);
    if (is_convex(flat) || corners > ear_clipping_limit)
        return fan(0, corners, triangles);
    clip_ears(flat, triangles);
}

} // namespace limn
