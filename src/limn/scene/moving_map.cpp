#include <algorithm>
#include <cmath>
#include <limits>

#include "limn/base/parallel.h"
#include "limn/scene/moving_terrain.h"
#include "limn/scene/tile_normals.h"
#include "limn/terrain/shading_tiles.h"
#include "limn/terrain/terrain_build.h"
#include "limn/terrain/terrain_mesh.h"

namespace limn {
namespace {

/// What has to be there together, since the view looks at the rest.
struct Prepared {
    HeightMap map;
    NestedErrors errors;
    PyramidLayout layout;
    TerrainView view;
    TileNormals normals;

    explicit Prepared(HeightMap heights)
        : map(std::move(heights)), errors(nest_errors(map, {.ranges = true})), layout(errors.lattice), view(map, errors),
          normals(layout, map.spacing, 1)
    {
    }
};

class MovingMap : public MovingTerrain {
public:
    MovingMap(HeightMap map, double factor) : true_map_(std::move(map)) { exaggerate(factor); }

    TerrainStep step(const Camera& camera, const ViewTolerance& tolerance) override
    {
        const HeightMap& map = prepared_->map;
        prepared_->view.update(camera, tolerance);
        Mesh mesh = terrain_mesh(map, prepared_->errors.lattice, prepared_->view.triangles());
        TerrainStep step;
        gpu::TerrainModel& model = step.model.emplace();
        model.middle = camera.eye;
        model.triangles = std::move(mesh.triangles);
        model.met = model.triangles.size();
        model.vertices.resize(mesh.positions.size());
        const double relief = std::max(heights_.y - heights_.x, 1e-30);
        parallel_each(mesh.positions.size(), 4096, [&](std::size_t i) {
            const dvec3& p = mesh.positions[i];
            model.vertices[i] = vec4(vec3(p - camera.eye), float((p.z - heights_.x) / relief));
        });
        const PyramidLayout& tiles = prepared_->layout;
        const std::vector<TileId> wanted = shading_tiles(map, tiles, camera, gpu::TerrainPainter::pixels_between_normals,
                                                         [&](const TileId& id) { return heights_of(id); });
        step.light = prepared_->normals.give(
            wanted, [&](const TileId& id) { return std::make_shared<const TerrainTile>(tile_of_map(map, tiles, id)); });
        step.triangles = model.triangles.size();
        step.under_ground = under_ground(camera);
        return step;
    }
    void wait() override {}
    void retry() override {}
    void exaggerate(double factor) override
    {
        prepared_ = std::make_unique<Prepared>(exaggerated(true_map_, factor));
        heights_ = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
        for (const float h : prepared_->map.heights)
            if (!std::isnan(h))
                heights_ = {std::min(heights_.x, double(h)), std::max(heights_.y, double(h))};
    }
    const HeightMap& frame() const override { return true_map_; }
    const PyramidLayout& layout() const override { return prepared_->layout; }
    Mesh coarse() override { return build_terrain(prepared_->map, {}).mesh; }

private:
    dvec2 heights_of(const TileId& id) const
    {
        const int samples = prepared_->layout.tile_samples(id.level);
        if (samples < 2)
            return heights_;
        // The point in the middle splits the tile's diagonal, so all of the tile is in its two triangles.
        const PointBounds bounds = prepared_->errors.bounds(prepared_->layout.first_sample(id) + samples / 2);
        return {double(bounds.low), double(bounds.high)};
    }
    double under_ground(const Camera& camera) const
    {
        const HeightMap& map = prepared_->map;
        const dvec2 at = {camera.eye.x / map.spacing.x, double(map.rows - 1) - camera.eye.y / map.spacing.y};
        if (camera.orthographic || !(at.x >= 0 && at.y >= 0 && at.x <= map.columns - 1 && at.y <= map.rows - 1))
            return 0;
        const double depth = double(map.height(int(at.x + 0.5), int(at.y + 0.5))) - camera.eye.z;
        return depth > 0 ? depth : 0;
    }

    HeightMap true_map_;
    std::unique_ptr<Prepared> prepared_;
    dvec2 heights_ = dvec2(0); ///< lowest and highest, metres, exaggerated
};

} // namespace

std::unique_ptr<MovingTerrain> moving_map(HeightMap map, double exaggerate)
{
    return std::make_unique<MovingMap>(std::move(map), exaggerate);
}

} // namespace limn
