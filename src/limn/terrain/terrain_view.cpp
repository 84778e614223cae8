#include "limn/terrain/terrain_view.h"

#include <bit>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/formulas/formulas.h"
#include "limn/terrain/bisection.h"

namespace limn {
namespace {

/// A share of what is bounded, for each level that a point is above the finest: far above what rounding takes, far below what shows.
constexpr double slack_of_level = 1e-6;

/// Levels of points above the finest ones.
int levels_above(int half_hypotenuse, bool diagonal) { return 2 * std::countr_zero(unsigned(half_hypotenuse)) + int(diagonal); }

/// Leaves of a hierarchy with their paths, in its order; two leaves of one triangle that is not split any more become that one again.
class LeafList {
public:
    /// @param first_inner  the least path of a triangle that has a sibling
    LeafList(const ViewTest& test, std::uint64_t first_inner) : test_(test), first_inner_(first_inner) {}
    void add(const BisectionTriangle& t, std::uint64_t path)
    {
        if (t.can_split() && test_(t)) {
            split(t, path);
            return;
        }
        push(t, path);
        while (merge_last()) {
        }
    }
    std::vector<BisectionTriangle> triangles;
    std::vector<std::uint64_t> paths;
    std::size_t changes = 0;

private:
    void split(const BisectionTriangle& t, std::uint64_t path)
    {
        ++changes;
        for (const bool right : {false, true}) {
            const BisectionTriangle part = right ? t.right() : t.left();
            const std::uint64_t below = 2 * path + std::uint64_t(right);
            if (part.can_split() && test_(part))
                split(part, below);
            else
                push(part, below);
        }
    }
    void push(const BisectionTriangle& t, std::uint64_t path)
    {
        triangles.push_back(t);
        paths.push_back(path);
    }
    bool merge_last()
    {
        const std::size_t n = paths.size();
        if (n < 2 || paths[n - 1] < first_inner_ || (paths[n - 1] & 1) == 0 || paths[n - 2] != paths[n - 1] - 1)
            return false;
        const BisectionTriangle &left = triangles[n - 2], &right = triangles[n - 1];
        const BisectionTriangle whole = {left.a, left.b, right.a};
        if (test_(whole))
            return false;
        const std::uint64_t path = paths[n - 1] / 2;
        triangles.resize(n - 2);
        paths.resize(n - 2);
        push(whole, path);
        ++changes;
        return true;
    }
    const ViewTest& test_;
    std::uint64_t first_inner_;
};

} // namespace

ViewTest::ViewTest(const HeightMap& map, const NestedErrors& errors, const Camera& camera, const ViewTolerance& tolerance)
    : map_(map), errors_(errors), camera_(camera), tolerance_(tolerance), right_(camera.right()), above_(camera.above()), forward_(camera.forward()),
      scale_(camera.pixels_per_unit(1))
{
    if (!(tolerance.pixels >= 0))
        throw Error::Input(fmt::format("a tolerance of {} px: it has to be 0 or more", tolerance.pixels));
    if (errors.low.empty() && !errors.errors.empty())
        throw Error::Input("errors in a picture need the heights' ranges; nest errors with ranges");
    across_ = 0.5 * dvec2(camera.size) / scale_;
    const dvec3 size(map.columns * map.spacing.x, map.rows * map.spacing.y, 0);
    slack_length_ = 1e-12 * (glm::length(size) + glm::length(camera.eye));
}

double ViewTest::pixels(const BisectionTriangle& t) const
{
    const ivec2 p = t.middle(), along = glm::abs(t.b - t.a);
    const std::size_t i = errors_.lattice.index(p);
    const double error = double(errors_.errors[i]), low = double(errors_.low[i]), high = double(errors_.high[i]);
    if (error == 0 || !(low <= high))
        return 0;
    const bool diagonal = along.x == along.y;
    const int half = std::max(along.x, along.y) / 2, reach = reach_of_point(half, diagonal), level = levels_above(half, diagonal);
    const dvec3 middle = dvec3(p.x * map_.spacing.x, (map_.rows - 1 - p.y) * map_.spacing.y, 0.5 * (low + high)) - camera_.eye;
    const dvec3 reaches(reach * map_.spacing.x, reach * map_.spacing.y, 0.5 * (high - low));
    const formulas::BoundCamera camera = {right_, above_, forward_, scale_, tolerance_.nearest, camera_.orthographic ? 1.0 : 0.0};
    if (tolerance_.cull && !formulas::box_may_be_seen(camera, across_, middle, reaches, slack_length_ * level))
        return 0;
    return formulas::height_error_bound(camera, middle, reaches, error, slack_of_level * level);
}

std::vector<BisectionTriangle> triangles_in_view(const HeightMap& map, const NestedErrors& errors, const Camera& camera, const ViewTolerance& tolerance)
{
    return find_leaves(errors.lattice, ViewTest(map, errors, camera, tolerance));
}

TerrainView::TerrainView(const HeightMap& map, const NestedErrors& errors) : map_(map), errors_(errors), triangles_(root_triangles(errors.lattice))
{
    const std::uint64_t first = std::bit_ceil(triangles_.size());
    for (std::size_t i = 0; i < triangles_.size(); ++i)
        paths_.push_back(first + i);
}

std::size_t TerrainView::update(const Camera& camera, const ViewTolerance& tolerance)
{
    const ViewTest test(map_, errors_, camera, tolerance);
    LeafList leaves(test, 2 * std::bit_ceil(std::uint64_t(root_triangles(errors_.lattice).size())));
    leaves.triangles.reserve(triangles_.size() + triangles_.size() / 8);
    leaves.paths.reserve(triangles_.size() + triangles_.size() / 8);
    for (std::size_t i = 0; i < triangles_.size(); ++i)
        leaves.add(triangles_[i], paths_[i]);
    triangles_ = std::move(leaves.triangles);
    paths_ = std::move(leaves.paths);
    return leaves.changes;
}

} // namespace limn
