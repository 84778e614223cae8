#include "limn/terrain/morphed_view.h"

#include <algorithm>
#include <array>

#include "limn/terrain/terrain_mesh.h"

namespace limn {
namespace {

/// A leaf and the heights of its corners on their way.
struct MovingTriangle {
    BisectionTriangle triangle;
    double apex, a, b;
};

class Morph {
public:
    Morph(const HeightMap& map, const NestedErrors& errors, const Camera& camera, const ViewTolerance& tolerance)
        : map_(map), lattice_(errors.lattice), test_(map, errors, camera, tolerance), pixels_(tolerance.pixels)
    {
    }
    std::vector<MovingTriangle> leaves() const
    {
        std::vector<MovingTriangle> out;
        for (const BisectionTriangle& t : root_triangles(lattice_))
            append({t, height(t.apex), height(t.a), height(t.b)}, out);
        return out;
    }

private:
    /// Of points outside the map nothing is drawn.
    double height(const ivec2& p) const { return lattice_.is_sample(p) ? double(map_.height(p.x, p.y)) : 0; }
    void append(const MovingTriangle& moving, std::vector<MovingTriangle>& out) const
    {
        const BisectionTriangle& t = moving.triangle;
        if (lattice_.is_outside_in_part(t) && !lattice_.is_inside_in_part(t))
            return;
        const double bound = t.can_split() ? test_.pixels(t) : 0;
        if (!(bound > 0.5 * pixels_)) {
            out.push_back(moving);
            return;
        }
        const double middle = height_on_its_way(moving, bound);
        append({t.left(), middle, moving.apex, moving.a}, out);
        append({t.right(), middle, moving.b, moving.apex}, out);
    }
    double height_on_its_way(const MovingTriangle& moving, double bound) const
    {
        const BisectionTriangle& t = moving.triangle;
        const double arrived = share_of_way(t, bound);
        if (arrived == 1)
            return height(t.middle()); // then the ends of the hypotenuse have arrived too
        return 0.5 * (moving.a + moving.b) + arrived * (height(t.middle()) - 0.5 * (height(t.a) + height(t.b)));
    }
    double share_of_way(const BisectionTriangle& t, double bound) const
    {
        const ivec2 along = glm::abs(t.b - t.a), last = t.middle() + reach_of_point(std::max(along.x, along.y) / 2, along.x == along.y);
        const bool at_cut = (last.x >= lattice_.columns && lattice_.points().x > lattice_.columns) || (last.y >= lattice_.rows && lattice_.points().y > lattice_.rows);
        if (at_cut || bound >= pixels_)
            return 1;
        return glm::smoothstep(0.5 * pixels_, pixels_, bound);
    }

    const HeightMap& map_;
    const Lattice& lattice_;
    ViewTest test_;
    double pixels_;
};

} // namespace

Mesh morphed_mesh(const HeightMap& map, const NestedErrors& errors, const Camera& camera, const ViewTolerance& tolerance, std::vector<ivec2>* samples)
{
    const std::vector<MovingTriangle> leaves = Morph(map, errors, camera, tolerance).leaves();
    std::vector<BisectionTriangle> triangles(leaves.size());
    std::transform(leaves.begin(), leaves.end(), triangles.begin(), [](const MovingTriangle& moving) { return moving.triangle; });
    std::vector<ivec2> own;
    std::vector<ivec2>& corners = samples ? *samples : own;
    Mesh mesh = terrain_mesh(map, errors.lattice, triangles, &corners);
    const auto before = [](const ivec2& p, const ivec2& q) { return p.y != q.y ? p.y < q.y : p.x < q.x; };
    const auto move = [&](const ivec2& p, double height) {
        const auto at = std::lower_bound(corners.begin(), corners.end(), p, before);
        if (at != corners.end() && *at == p)
            mesh.positions[std::size_t(at - corners.begin())].z = height;
    };
    for (const MovingTriangle& moving : leaves) {
        move(moving.triangle.apex, moving.apex);
        move(moving.triangle.a, moving.a);
        move(moving.triangle.b, moving.b);
    }
    return mesh;
}

} // namespace limn
