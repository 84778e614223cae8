#include "limn/terrain/terrain_pyramid_view.h"

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/base/random.h"
#include "limn/terrain/measure_terrain.h"
#include "limn/terrain/terrain_mesh.h"
#include "terrain/pyramid_support.h"

namespace limn::test {
namespace {

/// Smooth enough that few tiles are needed at once.
HeightMap hills(int columns, int rows)
{
    HeightMap map = map_of(columns, rows, [&](int x, int y) {
        return 40 * std::sin(0.011 * x + 0.3) * std::cos(0.013 * y) + 6 * std::sin(0.09 * x - 0.07 * y) + 0.02 * ((x * 7 + y * 13) % 11);
    });
    for (int y = rows / 3; y < rows / 3 + 40; ++y)
        for (int x = columns / 2; x < columns / 2 + 70; ++x)
            map.heights[map.index(x, y)] = std::numeric_limits<float>::quiet_NaN();
    return map;
}

/// One map and its pyramid for all tests.
class PyramidView : public testing::Test {
protected:
    struct Shared {
        TemporaryFolder folder;
        std::filesystem::path path = folder.path() / "t.pyramid";
        HeightMap map = hills(2000, 2030);
        NestedErrors errors = nest_errors(map, {.ranges = true});
        TerrainPyramid pyramid{(build_pyramid(rows_of(map), path), path)};
    };
    static void SetUpTestSuite() { shared_ = std::make_unique<Shared>(); }
    static void TearDownTestSuite() { shared_.reset(); }
    Camera camera(double along) const
    {
        Camera camera;
        camera.eye = {along * map_.columns, 100, 120};
        camera.look = {along * map_.columns + 200, 700, 0};
        camera.up = {0, 0, 1};
        camera.size = {400, 300};
        return camera;
    }
    /// Of a tile below the coarsest level.
    std::size_t tile_bytes() const { return pyramid_->read({0, {0, 0}}).bytes(); }
    /// Of the whole coarsest level.
    std::size_t coarsest_bytes() const
    {
        const int coarsest = pyramid_->layout().top();
        const ivec2 tops = pyramid_->layout().tiles(coarsest);
        return std::size_t(tops.x) * std::size_t(tops.y) * pyramid_->read({coarsest, {0, 0}}).bytes();
    }
    /// Each edge inside belongs to two triangles: no cracks.
    void expect_conforming(const std::vector<PyramidLeaf>& leaves) const
    {
        const ivec2 last = pyramid_->lattice().points() - 1;
        const auto uses = edge_uses(leaves, [](const PyramidLeaf& leaf) {
            return std::array<ivec2, 3>{leaf.triangle.apex, leaf.triangle.a, leaf.triangle.b};
        });
        std::size_t open = 0;
        for (const auto& [edge, count] : uses) {
            const auto& [p, q] = edge;
            const bool border = p.first >= map_.columns - 1 || p.second >= map_.rows - 1 || q.first >= map_.columns - 1 ||
                                q.second >= map_.rows - 1 || (p.first == q.first && (p.first == 0 || p.first == last.x)) ||
                                (p.second == q.second && (p.second == 0 || p.second == last.y));
            open += count != 2 && !border;
        }
        EXPECT_EQ(open, 0u);
    }
    static inline std::unique_ptr<Shared> shared_;
    const HeightMap& map_ = shared_->map;
    const NestedErrors& errors_ = shared_->errors;
    const TerrainPyramid* const pyramid_ = &shared_->pyramid;
    const std::filesystem::path& path_ = shared_->path;
};

TEST_F(PyramidView, EndsWithTheMeshOfTheWholeMapWhateverCameWhen)
{
    for (const int loaders : {1, 3}) {
        TerrainPyramidView view(*pyramid_, {.loaders = loaders});
        for (const double along : {0.1, 0.6, 0.2}) {
            const TerrainPyramidView::Frame& frame = view.finish(camera(along), {.pixels = 0.5});
            EXPECT_TRUE(frame.is_met());
            EXPECT_FALSE(frame.over_budget);
            const Mesh found = pyramid_mesh(*pyramid_, frame.leaves),
                       wanted = terrain_mesh(map_, errors_.lattice, triangles_in_view(map_, errors_, camera(along), {.pixels = 0.5}));
            EXPECT_EQ(found.positions, wanted.positions);
            EXPECT_EQ(found.triangles, wanted.triangles);
        }
    }
}

TEST_F(PyramidView, HasNoCracksAndTellsWhereItIsTooCoarseWhileTilesArrive)
{
    TerrainPyramidView view(*pyramid_);
    std::size_t frames = 0, before = 0;
    for (bool done = false; !done; ++frames) {
        const TerrainPyramidView::Frame& frame = view.update(camera(0.3), {.pixels = 0.5});
        expect_conforming(frame.leaves);
        EXPECT_GE(frame.leaves.size(), before);
        before = frame.leaves.size();
        done = frame.is_met();
        EXPECT_EQ(done, frame.missing == 0);
        if (frames == 0) {
            EXPECT_FALSE(done);
            EXPECT_GT(frame.missing, 0u);
        }
        view.wait();
    }
    EXPECT_GE(frames, std::size_t(pyramid_->layout().top())); // a tile is asked for when the ones above it are there
    const MeasuredTerrain measured =
        measure_terrain(map_, pyramid_mesh(*pyramid_, view.update(camera(0.3), {.pixels = 0.5}).leaves), 0.5, camera(0.3), 0.01);
    EXPECT_EQ(measured.over, 0u);
}

TEST_F(PyramidView, StaysWithinItsBudgetAndShowsWhatFits)
{
    const std::size_t tile = tile_bytes(), top = coarsest_bytes();
    for (const std::size_t tiles : {std::size_t(0), std::size_t(7)}) {
        TerrainPyramidView view(*pyramid_, {.budget = tiles * tile, .loaders = 2});
        for (const double along : {0.1, 0.7}) {
            const TerrainPyramidView::Frame& frame = view.finish(camera(along), {.pixels = 0.1});
            EXPECT_TRUE(frame.over_budget);
            EXPECT_FALSE(frame.is_met());
            expect_conforming(frame.leaves);
            EXPECT_LE(view.most_bytes(), top + tiles * tile);
        }
    }
}

// What is being read cannot be called back when something that shows more comes in between.
TEST_F(PyramidView, StaysWithinItsBudgetWhileTheCameraJumps)
{
    const std::size_t tile = tile_bytes(), top = coarsest_bytes();
    for (const std::size_t tiles : {std::size_t(3), std::size_t(7)}) {
        TerrainPyramidView view(*pyramid_, {.budget = tiles * tile, .loaders = 2});
        Random random(8, tiles);
        for (int i = 0; i < 120; ++i) {
            view.update(camera(random.uniform(0.05, 0.9)), {.pixels = 0.1});
            if (i % 3 == 0)
                view.wait();
        }
        EXPECT_LE(view.most_bytes(), top + tiles * tile);
    }
}

TEST_F(PyramidView, ReadsHeightsOfOtherTilesBesideAndLeavesTheMeshAsItIs)
{
    TerrainPyramidView view(*pyramid_);
    std::vector<TileId> others;
    const ivec2 count = pyramid_->layout().tiles(0);
    for (int y = 0; y < count.y; ++y)
        for (int x = 0; x < count.x; ++x)
            others.push_back({0, {x, y}});
    const std::size_t of_mesh = [&] {
        TerrainPyramidView alone(*pyramid_);
        alone.finish(camera(0.3), {.pixels = 2});
        return alone.bytes();
    }();
    std::size_t with_bounds = 0, heights = 0, leaves = 0;
    bool was_met = false;
    for (;;) {
        const TerrainPyramidView::Frame& frame = view.update(camera(0.3), {.pixels = 2}, others);
        if (was_met) {
            EXPECT_FALSE(frame.is_new);
            EXPECT_EQ(frame.leaves.size(), leaves);
        }
        was_met = frame.is_met() && view.bytes() == of_mesh, leaves = frame.leaves.size();
        std::erase_if(others, [&](const TileId& id) {
            const SharedTile tile = view.find(id);
            if (tile) {
                with_bounds += !tile->bounds.empty();
                heights += tile->bounds.empty();
                EXPECT_EQ(tile->heights.size(), pyramid_->read(id).heights.size());
            }
            return tile != nullptr;
        });
        if (frame.missing == 0)
            break;
        view.wait();
    }
    EXPECT_TRUE(others.empty());
    EXPECT_GT(heights, 0u);
    EXPECT_EQ(heights + with_bounds, std::size_t(count.x) * std::size_t(count.y));
    EXPECT_EQ(view.bytes(), of_mesh) << "heights pass by";
    EXPECT_TRUE(view.update(camera(0.31), {.pixels = 2}).is_new);
}

TEST_F(PyramidView, ForgetsTilesThatAreNotSeenAnyMoreForOthers)
{
    const auto down = [&](double along) {
        Camera camera = this->camera(along);
        camera.eye.z = 400, camera.fov_degrees = 20;
        camera.look = camera.eye + dvec3(30, 60, -200);
        return camera;
    };
    const std::size_t tile = tile_bytes();
    TerrainPyramidView all(*pyramid_);
    std::size_t most = 0;
    for (const double along : {0.1, 0.5, 0.9}) {
        TerrainPyramidView one(*pyramid_);
        one.finish(down(along), {.pixels = 0.05});
        most = std::max(most, one.bytes());
    }
    TerrainPyramidView view(*pyramid_, {.budget = most + tile});
    for (const double along : {0.1, 0.5, 0.9, 0.1}) {
        EXPECT_TRUE(view.finish(down(along), {.pixels = 0.05}).is_met());
        EXPECT_EQ(view.update(down(along), {.pixels = 0.05}).leaves.size(), all.finish(down(along), {.pixels = 0.05}).leaves.size());
    }
    EXPECT_LT(view.bytes(), all.bytes());
}

TEST_F(PyramidView, NamesTheTileThatCannotBeReadAndGoesOnWithoutIt)
{
    const TileId damaged = {pyramid_->layout().top() - 1, {0, 1}};
    const std::uint64_t at = pyramid_->entry(damaged).offset + 100;
    TerrainPyramidView view(*pyramid_);
    flip_bit(path_, at);
    try {
        view.finish(camera(0.1), {.pixels = 0.5});
        ADD_FAILURE() << "the tile was read";
    } catch (const Error::Read& error) {
        EXPECT_EQ(std::string(error.what()),
                  fmt::format("{}: tile 0,1 of level {} is damaged: its checksum does not match", path_.string(), damaged.level));
    }
    const TerrainPyramidView::Frame& frame = view.update(camera(0.1), {.pixels = 0.5});
    EXPECT_FALSE(frame.fault.empty());
    EXPECT_FALSE(frame.is_met());
    expect_conforming(frame.leaves);
    flip_bit(path_, at);
    view.retry();
    EXPECT_TRUE(view.finish(camera(0.1), {.pixels = 0.5}).is_met());
}

} // namespace
} // namespace limn::test
