#include "limn/scene/tile_normals.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

#include "limn/terrain/shading_tiles.h"
#include "terrain/terrain_support.h"

namespace limn::test {
namespace {

PyramidLayout layout_of(int samples, int tile_level)
{
    PyramidLayout layout(make_lattice(samples, samples));
    layout.tile_level = tile_level;
    return layout;
}

/// What a device does with light.
class Device {
public:
    explicit Device(const PyramidLayout& layout) : layout_(layout) {}
    void take(const gpu::TileLight& light)
    {
        EXPECT_LE(light.tiles.size(), light.room);
        std::map<std::size_t, std::vector<std::uint32_t>> next;
        for (const gpu::NormalTile& tile : light.fresh)
            EXPECT_TRUE(next.emplace(layout_.index(tile.id), tile.normals).second) << "twice";
        for (const TileId& id : light.tiles)
            if (!next.contains(layout_.index(id))) {
                const auto held = held_.find(layout_.index(id));
                ASSERT_NE(held, held_.end()) << "promised and never sent";
                next.insert(*held);
            }
        EXPECT_EQ(next.size(), light.tiles.size());
        held_ = std::move(next);
    }
    const std::vector<std::uint32_t>* normals(const TileId& id) const
    {
        const auto held = held_.find(layout_.index(id));
        return held == held_.end() ? nullptr : &held->second;
    }
    std::size_t count() const { return held_.size(); }

private:
    PyramidLayout layout_;
    std::map<std::size_t, std::vector<std::uint32_t>> held_;
};

class NormalsOfTiles : public testing::Test {
protected:
    SharedTile tile(const TileId& id) const { return std::make_shared<const TerrainTile>(tile_of_map(map_, layout_, id)); }
    std::vector<TileId> row(int y, int from, int count) const
    {
        std::vector<TileId> tiles = {{layout_.top(), {0, 0}}};
        for (int x = 0; x < count; ++x)
            tiles.push_back({0, {from + x, y}});
        return tiles;
    }
    HeightMap map_ = map_of(60, 60, [](int x, int y) { return 3 * std::sin(0.2 * x) + 2 * std::cos(0.3 * y); });
    PyramidLayout layout_ = layout_of(60, 1); // 32 tiles a side on the finest level
    TileNormals normals_{layout_, map_.spacing, 1};
};

TEST_F(NormalsOfTiles, ComeOnceAndStayWhileThereIsRoom)
{
    const auto here = [&](const TileId& id) { return tile(id); };
    gpu::TileLight light = normals_.give(row(3, 0, 20), here);
    EXPECT_EQ(light.fresh.size(), 21u);
    EXPECT_EQ(light.room, 32u);
    EXPECT_TRUE(normals_.give(row(3, 0, 20), here).fresh.empty());
    EXPECT_EQ(normals_.give(row(3, 5, 20), here).fresh.size(), 5u);
    EXPECT_TRUE(normals_.give(row(3, 0, 20), here).fresh.empty()) << "there was room for all";
    light = normals_.give(row(7, 0, 20), here);
    EXPECT_EQ(light.fresh.size(), 20u);
    EXPECT_EQ(light.tiles.size(), 32u);
    EXPECT_TRUE(normals_.lacking(row(3, 9, 11)).empty()) << "those that were used last";
    EXPECT_FALSE(normals_.lacking(row(3, 20, 5)).empty());
    for (const gpu::NormalTile& t : light.fresh)
        EXPECT_EQ(t.normals, tile_normals(*tile(t.id), map_.spacing, 1));
}

TEST_F(NormalsOfTiles, WaitForHeights)
{
    const auto even = [&](const TileId& id) { return id.at.x % 2 == 0 ? tile(id) : nullptr; };
    EXPECT_EQ(normals_.give(row(2, 0, 10), even).fresh.size(), 6u);
    EXPECT_EQ(normals_.lacking(row(2, 0, 10)).size(), 5u);
    EXPECT_EQ(normals_.give(row(2, 0, 10), [&](const TileId& id) { return tile(id); }).fresh.size(), 5u);
}

// Steps that nobody took, heights that are not there and tiles that come back: a device always gets what it is to hold.
TEST_F(NormalsOfTiles, ReachADeviceThatTakesOnlySomeOfTheSteps)
{
    unsigned state = 7;
    const auto draw = [&](unsigned n) { return int((state = state * 1664525 + 1013904223) >> 8) % int(n); };
    Device device(layout_);
    gpu::TileLight skipped;
    for (int step = 0; step < 400; ++step) {
        const int y = draw(3), from = draw(25), count = 1 + draw(7);
        const std::vector<TileId> wanted = row(y, from, count);
        const int absent = draw(32);
        gpu::TileLight light = gpu::after_skipped(
            normals_.give(wanted, [&](const TileId& id) { return id.at.x == absent ? nullptr : tile(id); }), std::move(skipped));
        skipped = {};
        if (draw(3) == 0) {
            skipped = std::move(light);
            continue;
        }
        device.take(light);
        for (const TileId& id : wanted)
            if (id.at.x != absent) {
                const std::vector<std::uint32_t>* held = device.normals(id);
                ASSERT_TRUE(held) << step;
                EXPECT_EQ(*held, tile_normals(*tile(id), map_.spacing, 1));
            }
    }
    EXPECT_EQ(device.count(), 32u);
}

TEST_F(NormalsOfTiles, NeverGoBeyondTheLayersOfATexture)
{
    TileNormals normals(layout_of(4097, 5), dvec2(1), 1);
    std::vector<TileId> wanted;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            wanted.push_back({0, {x, y}});
    const auto none = [](const TileId&) { return SharedTile(); };
    EXPECT_EQ(normals.give(wanted, none).room, TileNormals::most_tiles);
    EXPECT_EQ(normals.lacking(wanted).size(), TileNormals::most_tiles);
}

} // namespace
} // namespace limn::test
