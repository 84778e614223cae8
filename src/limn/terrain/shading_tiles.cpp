#include "limn/terrain/shading_tiles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "limn/formulas/formulas.h"
#include "limn/terrain/sample_slope.h"

namespace limn {
namespace {

/// A camera that is asked of boxes.
class BoxView {
public:
    BoxView(const HeightMap& frame, const PyramidLayout& layout, const Camera& camera)
        : frame_(frame), layout_(layout), camera_(camera), bound_{camera.right(),   camera.above(),
                                                                  camera.forward(), camera.pixels_per_unit(1),
                                                                  nearest_depth,    camera.orthographic ? 1.0 : 0.0},
          across_(dvec2(camera.size) / (2 * camera.pixels_per_unit(1)))
    {
    }
    /// How far a tile's points are apart in the picture, at most, in pixels; 0 where nothing of it is seen.
    double spacing(const TileId& id, const dvec2& heights) const
    {
        if (!(heights.x <= heights.y))
            return 0;
        const int samples = layout_.tile_samples(id.level);
        const dvec2 first(layout_.first_sample(id));
        const dvec2 centre = {(first.x + 0.5 * samples) * frame_.spacing.x,
                              (double(frame_.rows - 1) - first.y - 0.5 * samples) * frame_.spacing.y};
        const dvec3 middle = dvec3(centre, 0.5 * (heights.x + heights.y)) - camera_.eye,
                    reach(0.5 * samples * frame_.spacing, 0.5 * (heights.y - heights.x));
        if (!formulas::box_may_be_seen(bound_, across_, middle, reach, 0.0))
            return 0;
        const double depth = glm::dot(bound_.forward, middle) - glm::dot(glm::abs(bound_.forward), reach);
        const double step = (1 << id.level) * std::max(frame_.spacing.x, frame_.spacing.y);
        return step * camera_.pixels_per_unit(std::max(depth, nearest_depth));
    }

private:
    static constexpr double nearest_depth = 0.01; // metres, as ViewTolerance has it
    const HeightMap& frame_;
    const PyramidLayout& layout_;
    const Camera& camera_;
    formulas::BoundCamera bound_;
    dvec2 across_;
};

} // namespace

std::vector<TileId> shading_tiles(const HeightMap& frame, const PyramidLayout& layout, const Camera& camera, double pixels,
                                  const TileHeights& heights)
{
    const BoxView view(frame, layout, camera);
    std::vector<TileId> tiles, level;
    const ivec2 tops = layout.tiles(layout.top());
    for (int y = 0; y < tops.y; ++y)
        for (int x = 0; x < tops.x; ++x)
            level.push_back({layout.top(), {x, y}});
    while (!level.empty()) {
        tiles.insert(tiles.end(), level.begin(), level.end());
        std::vector<TileId> finer;
        for (const TileId& id : level)
            if (id.level > 0 && view.spacing(id, heights(id)) > pixels)
                for (const ivec2& part : {ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(1, 1)})
                    if (const TileId child = {id.level - 1, 2 * id.at + part}; view.spacing(child, heights(child)) > 0)
                        finer.push_back(child);
        std::sort(finer.begin(), finer.end(), [&](const TileId& a, const TileId& b) { return layout.index(a) < layout.index(b); });
        level = std::move(finer);
    }
    return tiles;
}

TerrainTile tile_of_map(const HeightMap& map, const PyramidLayout& layout, const TileId& id)
{
    TerrainTile tile;
    tile.first = layout.first_sample(id);
    tile.stride = 1 << id.level;
    tile.points = layout.tile_points();
    tile.heights.reserve(std::size_t(tile.points + 2) * std::size_t(tile.points + 2));
    for (int y = -1; y <= tile.points; ++y)
        for (int x = -1; x <= tile.points; ++x) {
            const ivec2 p = tile.first + tile.stride * ivec2(x, y);
            tile.heights.push_back(map.contains(p.x, p.y) ? map.height(p.x, p.y) : std::numeric_limits<float>::quiet_NaN());
        }
    return tile;
}

std::vector<std::uint32_t> tile_normals(const TerrainTile& tile, const dvec2& spacing, double exaggerate)
{
    const auto part = [](double value) { return std::uint32_t(std::uint16_t(std::int16_t(std::lround(32767 * value)))); };
    std::vector<std::uint32_t> normals;
    normals.reserve(std::size_t(tile.points) * std::size_t(tile.points));
    for (int y = 0; y < tile.points; ++y)
        for (int x = 0; x < tile.points; ++x) {
            const ivec2 p = tile.first + tile.stride * ivec2(x, y);
            const auto rise = [&](const ivec2& step, double width) {
                return exaggerate * sample_slope(double(tile.height(p - step)), double(tile.height(p)), double(tile.height(p + step))) /
                       (tile.stride * width);
            };
            const dvec3 normal =
                glm::normalize(dvec3(-rise({tile.stride, 0}, spacing.x), rise({0, tile.stride}, spacing.y), 1)); // rows run south
            normals.push_back(part(normal.x) | part(normal.y) << 16);
        }
    return normals;
}

} // namespace limn
