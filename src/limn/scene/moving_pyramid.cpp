#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/scene/moving_terrain.h"
#include "limn/scene/tile_normals.h"
#include "limn/terrain/shading_tiles.h"
#include "limn/terrain/terrain_pyramid_view.h"

namespace limn {
namespace {

class MovingPyramid : public MovingTerrain {
public:
    MovingPyramid(const std::filesystem::path& file, std::size_t budget, double factor) : pyramid_(file), budget_(budget)
    {
        exaggerate(factor);
    }

    TerrainStep step(const Camera& camera, const ViewTolerance& tolerance) override
    {
        const PyramidLayout& tiles = pyramid_.layout();
        const std::vector<TileId> wanted =
            shading_tiles(pyramid_.frame(), tiles, camera, gpu::TerrainPainter::pixels_between_normals, [&](const TileId& id) {
                const PointBounds& bounds = pyramid_.entry(id).bounds;
                return factor_ * dvec2(bounds.low, bounds.high);
            });
        const TerrainPyramidView::Frame& frame = view_->update(camera, tolerance, normals_->lacking(wanted));
        TerrainStep step;
        step.missing = frame.missing;
        step.tile_bytes = view_->bytes();
        step.over_budget = frame.over_budget;
        step.fault = frame.fault;
        step.light = normals_->give(wanted, [&](const TileId& id) { return view_->find(id); });
        if (frame.is_new) {
            step.model = model(frame, camera.eye);
            triangles_ = step.model->triangles.size();
            unmet_ = triangles_ - step.model->met;
        }
        step.triangles = triangles_;
        step.unmet = unmet_;
        step.under_ground = under_ground(camera);
        return step;
    }
    void wait() override { view_->wait(); }
    void retry() override { view_->retry(); }
    void exaggerate(double factor) override
    {
        if (!(factor > 0) || !std::isfinite(factor))
            throw Error::Input(fmt::format("heights times {}: the factor has to be above 0", factor));
        view_.reset(); // its tiles go before those of the next one come
        factor_ = factor;
        normals_.emplace(pyramid_.layout(), pyramid_.frame().spacing, factor);
        view_ = std::make_unique<TerrainPyramidView>(pyramid_, TerrainPyramidViewOptions{.budget = budget_, .exaggerate = factor});
    }
    const HeightMap& frame() const override { return pyramid_.frame(); }
    const PyramidLayout& layout() const override { return pyramid_.layout(); }
    Mesh coarse() override
    {
        TileCache tiles(pyramid_, budget_);
        return coarse_pyramid_mesh(tiles, factor_);
    }

private:
    gpu::TerrainModel model(const TerrainPyramidView::Frame& frame, const dvec3& middle) const
    {
        if (frame.is_met())
            return model(pyramid_mesh(pyramid_, frame.leaves, factor_), {}, middle);
        std::vector<PyramidLeaf> met, unmet;
        unmet.reserve(frame.unmet.size());
        met.reserve(frame.leaves.size() - frame.unmet.size());
        std::size_t next = 0; // of those that are not met
        for (std::size_t i = 0; i < frame.leaves.size(); ++i) {
            const bool is_unmet = next < frame.unmet.size() && frame.unmet[next] == i;
            next += is_unmet;
            (is_unmet ? unmet : met).push_back(frame.leaves[i]);
        }
        return model(pyramid_mesh(pyramid_, met, factor_), pyramid_mesh(pyramid_, unmet, factor_), middle);
    }
    gpu::TerrainModel model(const Mesh& met, const Mesh& unmet, const dvec3& middle) const
    {
        gpu::TerrainModel model;
        model.middle = middle;
        model.vertices.reserve(met.positions.size() + unmet.positions.size());
        model.triangles.reserve(met.triangles.size() + unmet.triangles.size());
        add(model, met);
        model.met = model.triangles.size();
        add(model, unmet);
        return model;
    }
    void add(gpu::TerrainModel& model, const Mesh& mesh) const
    {
        const auto first = std::uint32_t(model.vertices.size());
        const double low = double(pyramid_.lowest()) * factor_, relief = std::max(double(pyramid_.highest()) * factor_ - low, 1e-30);
        model.vertices.resize(first + mesh.positions.size());
        parallel_each(mesh.positions.size(), 4096, [&](std::size_t i) {
            const dvec3& p = mesh.positions[i];
            model.vertices[first + i] = vec4(vec3(p - model.middle), float((p.z - low) / relief));
        });
        for (const uvec3& t : mesh.triangles)
            model.triangles.push_back(t + first);
    }
    /// By the finest tile that is here.
    double under_ground(const Camera& camera) const
    {
        const HeightMap& frame = pyramid_.frame();
        const PyramidLayout& tiles = pyramid_.layout();
        const dvec2 at = {camera.eye.x / frame.spacing.x, double(frame.rows - 1) - camera.eye.y / frame.spacing.y};
        if (camera.orthographic || !(at.x >= 0 && at.y >= 0 && at.x <= frame.columns - 1 && at.y <= frame.rows - 1))
            return 0;
        for (int level = 0; level < tiles.levels(); ++level)
            if (const SharedTile tile = view_->find({level, glm::min(ivec2(at) / tiles.tile_samples(level), tiles.tiles(level) - 1)})) {
                const ivec2 point = ivec2((at - dvec2(tile->first)) / double(tile->stride) + 0.5);
                const double depth = double(tile->height(tile->first + tile->stride * point)) * factor_ - camera.eye.z;
                return depth > 0 ? depth : 0;
            }
        return 0;
    }

    TerrainPyramid pyramid_;
    std::size_t budget_;
    double factor_ = 1;
    std::optional<TileNormals> normals_;
    std::size_t triangles_ = 0, unmet_ = 0; ///< of the last model
    std::unique_ptr<TerrainPyramidView> view_;
};

} // namespace

std::unique_ptr<MovingTerrain> moving_pyramid(const std::filesystem::path& file, std::size_t budget, double exaggerate)
{
    return std::make_unique<MovingPyramid>(file, budget, exaggerate);
}

} // namespace limn
