#include "limn/terrain/pyramid_leaves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/terrain/length_test.h"
#include "limn/terrain/polygon_fan.h"
#include "limn/terrain/pyramid_walk.h"
#include "limn/terrain/split_point.h"

namespace limn {
namespace {

/// Bounds where heights are multiplied and rounded to floats again.
PointBounds exaggerated(const PointBounds& bounds, double factor)
{
    if (factor == 1)
        return bounds;
    constexpr double rounding = std::numeric_limits<float>::epsilon(); // of two heights, each by half
    const double largest = std::max(std::abs(double(bounds.low)), std::abs(double(bounds.high)));
    const double slack = std::isfinite(largest) ? factor * largest * rounding : 0;
    return {rounded_up(factor * double(bounds.error) + slack), float(double(bounds.low) * factor), float(double(bounds.high) * factor)};
}

/// The longest hypotenuse among the triangles that a tile's own points split.
BisectionTriangle longest_in(const TileId& id)
{
    const int side = 2 << id.level;
    return {{side, 0}, {0, 0}, {side, side}};
}

/// The tile of each level that was needed last, read when it is.
class TilesInReach {
public:
    TilesInReach(TileCache& tiles, const PyramidTest& test)
        : tiles_(tiles), layout_(tiles.pyramid().layout()), test_(test), at_(std::size_t(layout_.levels()))
    {
    }
    const TerrainTile* tile_for(const BisectionTriangle& t)
    {
        const TileId id = layout_.tile_of(t);
        return place(id).may_split ? &tile(id) : nullptr;
    }
    const TerrainTile& top(const TileId& id) { return tile(id); }

private:
    struct Place {
        TileId id = {-1, ivec2(-1)};
        bool may_split = false;
        SharedTile tile;
    };
    Place& place(const TileId& id)
    {
        Place& at = at_[std::size_t(id.level)];
        if (!(at.id == id))
            at = {id, id.level == layout_.top() || test_.may_split(id), nullptr};
        return at;
    }
    const TerrainTile& tile(const TileId& id)
    {
        Place& at = place(id);
        if (!at.tile)
            at.tile = tiles_.get(id);
        return *at.tile;
    }
    TileCache& tiles_;
    const PyramidLayout& layout_;
    const PyramidTest& test_;
    std::vector<Place> at_; ///< of each level
};

/// A corner of a mesh: the number of a sample in the map, and its height.
struct MeshCorner {
    std::uint64_t sample;
    float height;
};

bool is_before(const MeshCorner& p, const MeshCorner& q) { return p.sample < q.sample; }

void sort_without_repeats(std::vector<MeshCorner>& corners)
{
    std::sort(corners.begin(), corners.end(), is_before);
    corners.erase(
        std::unique(corners.begin(), corners.end(), [](const MeshCorner& p, const MeshCorner& q) { return p.sample == q.sample; }),
        corners.end());
}

/// Calls `f(corners)` for the triangles of a mesh: parts inside the map with data at all corners.
template <class F> void each_drawn(const TerrainPyramid& pyramid, const PyramidLeaf& leaf, F&& f)
{
    const BisectionTriangle& t = leaf.triangle;
    const Lattice& lattice = pyramid.lattice();
    const auto corner = [&](const ivec2& p) -> MeshCorner {
        const float height = p == t.apex ? leaf.apex : p == t.a ? leaf.a : p == t.b ? leaf.b : pyramid.edge_height(p);
        return {std::uint64_t(p.y) * std::uint64_t(lattice.columns) + std::uint64_t(p.x), height};
    };
    const auto with_data = [&](const ivec2& p, const ivec2& q, const ivec2& r) {
        const std::array corners = {corner(p), corner(q), corner(r)};
        if (std::none_of(corners.begin(), corners.end(), [](const MeshCorner& c) { return std::isnan(c.height); }))
            f(corners);
    };
    if (lattice.is_outside_in_part(t))
        each_fan_triangle(clip_to_map(lattice, t), with_data);
    else
        with_data(t.apex, t.a, t.b);
}

} // namespace

PyramidTest metric_test(const TerrainPyramid& pyramid, double tolerance, double max_edge, double exaggerate)
{
    if (!(tolerance >= 0))
        throw Error::Input(fmt::format("a tolerance of {} m: it has to be 0 or more", tolerance));
    const LengthTest is_too_long(pyramid.frame(), max_edge);
    return {[=](const BisectionTriangle& t, const PointBounds& bounds) {
                return double(exaggerated(bounds, exaggerate).error) > tolerance || is_too_long(t);
            },
            [=, &pyramid](const TileId& id) {
                return is_too_long(longest_in(id)) ? std::numeric_limits<double>::infinity()
                                                   : double(exaggerated(pyramid.entry(id).bounds, exaggerate).error);
            },
            tolerance};
}

PyramidTest view_test(const TerrainPyramid& pyramid, const Camera& camera, const ViewTolerance& tolerance, double max_edge,
                      double exaggerate)
{
    const ViewTest test(pyramid.frame(), camera, tolerance);
    const LengthTest is_too_long(pyramid.frame(), max_edge);
    return {[=](const BisectionTriangle& t, const PointBounds& bounds) {
                return test.splits(t, exaggerated(bounds, exaggerate)) || is_too_long(t);
            },
            [=, &pyramid](const TileId& id) {
                const PyramidLayout& layout = pyramid.layout();
                const ivec2 first = layout.first_sample(id);
                return is_too_long(longest_in(id)) ? std::numeric_limits<double>::infinity()
                                                   : test.pixels_of_area(first, first + layout.tile_samples(id.level),
                                                                         exaggerated(pyramid.entry(id).bounds, exaggerate), 1 << id.level);
            },
            tolerance.pixels};
}

std::vector<PyramidLeaf> pyramid_leaves(TileCache& tiles, const PyramidTest& test)
{
    const Lattice& lattice = tiles.pyramid().lattice();
    TilesInReach first(tiles, test);
    const std::vector<PyramidLeaf> tops = first_pyramid_leaves(lattice, first, test);
    return parallel_collect<PyramidLeaf>(tops.size(), 4, [&](std::size_t begin, std::size_t end, std::vector<PyramidLeaf>& out) {
        TilesInReach in_reach(tiles, test);
        for (std::size_t i = begin; i < end; ++i)
            each_pyramid_leaf(lattice, tops[i], in_reach, test, [&](const PyramidLeaf& leaf) { out.push_back(leaf); });
    });
}

Mesh pyramid_mesh(const TerrainPyramid& pyramid, const std::vector<PyramidLeaf>& leaves, double exaggerate)
{
    constexpr std::size_t grain = 4096;
    std::vector<MeshCorner> corners =
        parallel_collect<MeshCorner>(leaves.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<MeshCorner>& out) {
            std::vector<MeshCorner> all; // neighbours share most of theirs
            for (std::size_t i = begin; i < end; ++i)
                each_drawn(pyramid, leaves[i], [&](const auto& three) { all.insert(all.end(), three.begin(), three.end()); });
            sort_without_repeats(all);
            out.insert(out.end(), all.begin(), all.end());
        });
    sort_without_repeats(corners);
    const HeightMap& frame = pyramid.frame();
    Mesh mesh;
    mesh.positions.resize(corners.size());
    parallel_each(corners.size(), grain, [&](std::size_t i) {
        const auto columns = std::uint64_t(frame.columns);
        const int column = int(corners[i].sample % columns), row = int(corners[i].sample / columns);
        mesh.positions[i] = {column * frame.spacing.x, (frame.rows - 1 - row) * frame.spacing.y,
                             double(float(double(corners[i].height) * exaggerate))};
    });
    const auto number = [&](const MeshCorner& c) {
        return std::uint32_t(std::lower_bound(corners.begin(), corners.end(), c, is_before) - corners.begin());
    };
    mesh.triangles = parallel_collect<uvec3>(leaves.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<uvec3>& out) {
        for (std::size_t i = begin; i < end; ++i)
            each_drawn(pyramid, leaves[i],
                       [&](const auto& three) { out.emplace_back(number(three[0]), number(three[1]), number(three[2])); });
    });
    return mesh;
}

Mesh coarse_pyramid_mesh(TileCache& tiles, double exaggerate)
{
    constexpr double share_of_relief = 1.0 / 500, large = 2048 * 2048;
    const TerrainPyramid& pyramid = tiles.pyramid();
    const double relief = double(pyramid.highest()) - double(pyramid.lowest()),
                 samples = double(pyramid.frame().columns) * pyramid.frame().rows;
    // The larger the map, the coarser: it is only looked at from where all of it can be seen.
    const double tolerance = exaggerate * relief * share_of_relief * std::max(1.0, samples / large);
    return pyramid_mesh(pyramid, pyramid_leaves(tiles, metric_test(pyramid, tolerance, 0, exaggerate)), exaggerate);
}

} // namespace limn
