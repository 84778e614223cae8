#include "limn/terrain/terrain_view.h"

#include <algorithm>
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

using Leaf = TerrainView::Leaf;

/// What is known of the point that would split a triangle; nothing of those that cannot be split.
PointBounds bounds_below(const NestedErrors& errors, const BisectionTriangle& t) { return t.can_split() ? errors.bounds(t.middle()) : PointBounds(); }

/// Leaves of a hierarchy, in its order; two leaves of one triangle that is not split any more become that one again.
class LeafList {
public:
    /// @param first_inner  the least path of a triangle that has a sibling
    LeafList(const NestedErrors& errors, const ViewTest& test, std::uint64_t first_inner) : errors_(errors), test_(test), first_inner_(first_inner) {}
    void add(const Leaf& leaf)
    {
        if (is_split(leaf)) {
            split(leaf);
            return;
        }
        leaves.push_back(leaf);
        while (merge_last()) {
        }
    }
    std::vector<Leaf> leaves;
    std::size_t changes = 0;

private:
    bool is_split(const Leaf& leaf) const { return leaf.below.error > 0 && test_.splits(leaf.triangle, leaf.below); }
    void split(const Leaf& leaf)
    {
        ++changes;
        for (const bool right : {false, true}) {
            const BisectionTriangle part = right ? leaf.triangle.right() : leaf.triangle.left();
            const Leaf finer = {part, 2 * leaf.path + std::uint64_t(right), bounds_below(errors_, part), leaf.below};
            if (is_split(finer))
                split(finer);
            else
                leaves.push_back(finer);
        }
    }
    bool merge_last()
    {
        if (leaves.size() < 2)
            return false;
        const Leaf &left = leaves[leaves.size() - 2], &right = leaves.back();
        if (right.path < first_inner_ || (right.path & 1) == 0 || left.path != right.path - 1)
            return false;
        const BisectionTriangle whole = {left.triangle.a, left.triangle.b, right.triangle.a};
        if (test_.splits(whole, right.above))
            return false;
        const std::uint64_t path = right.path / 2;
        const Leaf merged = {whole, path, right.above, path < first_inner_ ? PointBounds() : errors_.bounds(whole.apex)};
        leaves.resize(leaves.size() - 2);
        leaves.push_back(merged);
        ++changes;
        return true;
    }
    const NestedErrors& errors_;
    const ViewTest& test_;
    std::uint64_t first_inner_;
};

} // namespace

ViewTest::ViewTest(const HeightMap& frame, const Camera& camera, const ViewTolerance& tolerance)
    : map_(frame), camera_(camera), tolerance_(tolerance), right_(camera.right()), above_(camera.above()), forward_(camera.forward()), scale_(camera.pixels_per_unit(1))
{
    if (!(tolerance.pixels >= 0))
        throw Error::Input(fmt::format("a tolerance of {} px: it has to be 0 or more", tolerance.pixels));
    across_ = 0.5 * dvec2(camera.size) / scale_;
    const dvec3 size(frame.columns * frame.spacing.x, frame.rows * frame.spacing.y, 0);
    for (std::size_t level = 0; level < reaches_.size(); ++level)
        reaches_[level] = level < 60 ? double(reach_of_point(1 << (level / 2), level % 2 == 1)) : 0;
    slack_length_ = 1e-12 * (glm::length(size) + glm::length(camera.eye));
}

ViewTest::ViewTest(const HeightMap& map, const NestedErrors& errors, const Camera& camera, const ViewTolerance& tolerance) : ViewTest(map, camera, tolerance)
{
    if (errors.low.empty() && !errors.errors.empty())
        throw Error::Input("errors in a picture need the heights' ranges; nest errors with ranges");
    errors_ = &errors;
}

double ViewTest::pixels(const BisectionTriangle& t, const PointBounds& bounds) const
{
    const ivec2 p = t.middle(), along = glm::abs(t.b - t.a);
    const int level = levels_above(std::max(along.x, along.y) / 2, along.x == along.y);
    const double reach = reaches_[std::size_t(level)];
    return pixels_of_box(dvec2(p), dvec2(reach), bounds, level);
}

double ViewTest::pixels_of_area(const ivec2& first, const ivec2& last, const PointBounds& bounds, int half_hypotenuse) const
{
    const int level = levels_above(half_hypotenuse, true);
    const dvec2 reach = 0.5 * dvec2(last - first) + reaches_[std::size_t(level)];
    return pixels_of_box(0.5 * dvec2(first + last), reach, bounds, level + 1); // one more, so that rounding never makes it less than a point's
}

double ViewTest::pixels_of_box(const dvec2& place, const dvec2& reach, const PointBounds& bounds, int level) const
{
    const double error = double(bounds.error), low = double(bounds.low), high = double(bounds.high);
    if (error == 0 || !(low <= high))
        return 0;
    const dvec3 middle = dvec3(place.x * map_.spacing.x, (map_.rows - 1 - place.y) * map_.spacing.y, 0.5 * (low + high)) - camera_.eye;
    const dvec3 reaches(reach.x * map_.spacing.x, reach.y * map_.spacing.y, 0.5 * (high - low));
    const formulas::BoundCamera camera = {right_, above_, forward_, scale_, tolerance_.nearest, camera_.orthographic ? 1.0 : 0.0};
    if (tolerance_.cull && !formulas::box_may_be_seen(camera, across_, middle, reaches, slack_length_ * level))
        return 0;
    return formulas::height_error_bound(camera, middle, reaches, error, slack_of_level * level);
}

std::vector<BisectionTriangle> triangles_in_view(const HeightMap& map, const NestedErrors& errors, const Camera& camera, const ViewTolerance& tolerance)
{
    return find_leaves(errors.lattice, ViewTest(map, errors, camera, tolerance));
}

TerrainView::TerrainView(const HeightMap& map, const NestedErrors& errors) : map_(map), errors_(errors)
{
    const std::vector<BisectionTriangle> roots = root_triangles(errors.lattice);
    const std::uint64_t first = std::bit_ceil(roots.size());
    for (std::size_t i = 0; i < roots.size(); ++i)
        leaves_.push_back({roots[i], first + i, bounds_below(errors, roots[i]), {}});
}

std::size_t TerrainView::update(const Camera& camera, const ViewTolerance& tolerance)
{
    const ViewTest test(map_, errors_, camera, tolerance);
    const std::size_t roots = 2 * std::size_t(errors_.lattice.roots.x) * std::size_t(errors_.lattice.roots.y);
    LeafList next(errors_, test, 2 * std::bit_ceil(roots));
    next.leaves.reserve(leaves_.size() + leaves_.size() / 8);
    for (const Leaf& leaf : leaves_)
        next.add(leaf);
    leaves_ = std::move(next.leaves);
    return next.changes;
}

std::vector<BisectionTriangle> TerrainView::triangles() const
{
    std::vector<BisectionTriangle> out(leaves_.size());
    std::transform(leaves_.begin(), leaves_.end(), out.begin(), [](const Leaf& leaf) { return leaf.triangle; });
    return out;
}

} // namespace limn
