#include "limn/scene/pyramid_normals.h"

#include <algorithm>
#include <cmath>

#include "limn/terrain/sample_slope.h"

namespace limn {
namespace {

/// How far apart points may be in the picture, in pixels.
constexpr double pixels_between = 0.5;

} // namespace

PyramidNormals::PyramidNormals(TileCache& tiles, const Camera& camera, double exaggerate)
    : tiles_(tiles), layout_(tiles.pyramid().layout()), camera_(camera), exaggerate_(exaggerate),
      last_(LastTiles(std::size_t(layout_.levels())))
{
}

dvec3 PyramidNormals::operator()(const dvec3& place) const
{
    const HeightMap& frame = tiles_.pyramid().frame();
    const dvec2 sample = glm::clamp(dvec2(place.x / frame.spacing.x, frame.rows - 1 - place.y / frame.spacing.y), dvec2(0),
                                    dvec2(frame.columns - 1, frame.rows - 1));
    const double pixel = 1 / camera_.pixels_per_unit(std::max(1e-6, camera_.project(place).depth));
    const double level =
        std::clamp(std::log2(pixels_between * pixel / std::min(frame.spacing.x, frame.spacing.y)), 0.0, double(layout_.top()));
    const int finer = int(level);
    const double share = level - finer;
    const dvec3 near = normal(finer, sample);
    return share > 0 ? glm::normalize(glm::mix(near, normal(finer + 1, sample), share)) : near;
}

const TerrainTile& PyramidNormals::tile_at(int level, const dvec2& sample) const
{
    const TileId id = {level, glm::min(ivec2(sample / double(layout_.tile_samples(level))), layout_.tiles(level) - 1)};
    LastTile& last = last_.local()[std::size_t(level)];
    if (!(last.id == id))
        last = {id, tiles_.get(id)};
    return *last.tile;
}

dvec3 PyramidNormals::normal(int level, const dvec2& sample) const
{
    const TerrainTile& tile = tile_at(level, sample);
    const dvec2 at = (sample - dvec2(tile.first)) / double(tile.stride), step = double(tile.stride) * tiles_.pyramid().frame().spacing;
    const ivec2 first = glm::clamp(ivec2(at), ivec2(0), ivec2(tile.points - 2));
    const dvec2 share = at - dvec2(first);
    const auto height = [&](int x, int y) { return double(tile.heights[std::size_t((y + 1) * (tile.points + 2) + x + 1)]); };
    dvec3 sum(0);
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const int x = first.x + i, y = first.y + j;
            const double here = height(x, y), weight = (i == 0 ? 1 - share.x : share.x) * (j == 0 ? 1 - share.y : share.y);
            if (std::isnan(here))
                continue;
            const dvec2 slope = {sample_slope(height(x - 1, y), here, height(x + 1, y)),
                                 sample_slope(height(x, y - 1), here, height(x, y + 1))};
            sum += weight * glm::normalize(dvec3(-exaggerate_ * slope.x / step.x, exaggerate_ * slope.y / step.y, 1)); // rows run south
        }
    return glm::length(sum) > 0 ? glm::normalize(sum) : dvec3(0, 0, 1);
}

} // namespace limn
