#include <bit>

#include <gtest/gtest.h>

#include "limn/base/parallel.h"
#include "limn/terrain/nested_errors.h"
#include "limn/terrain/terrain_pyramid.h"
#include "terrain/pyramid_support.h"

namespace limn::test {
namespace {

bool same_bits(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

std::string text(const PointBounds& b) { return fmt::format("{} {} {}", b.error, b.low, b.high); }

/// Every tile against the whole map in memory: heights, those around the tile too, and bounds to the bit.
void expect_map_in_tiles(const HeightMap& map, const TerrainPyramid& pyramid)
{
    const NestedErrors errors = nest_errors(map, {.ranges = true});
    const PyramidLayout& layout = pyramid.layout();
    std::size_t points = 0, wrong = 0;
    for (int level = 0; level < layout.levels(); ++level)
        for (int row = 0; row < layout.tiles(level).y; ++row)
            for (int column = 0; column < layout.tiles(level).x; ++column) {
                const TileId id = {level, {column, row}};
                const TerrainTile tile = pyramid.read(id);
                const TileEntry& entry = pyramid.entry(id);
                float most = 0;
                for (int y = -1; y <= tile.points; ++y)
                    for (int x = -1; x <= tile.points; ++x) {
                        const ivec2 p = tile.first + ivec2(x, y) * tile.stride;
                        const bool inside = p.x >= 0 && p.y >= 0 && errors.lattice.is_sample(p);
                        const float found = tile.heights[std::size_t((y + 1) * (tile.points + 2) + x + 1)];
                        if (inside ? !same_bits(found, map.height(p.x, p.y)) : !std::isnan(found)) {
                            ADD_FAILURE() << level << ": " << p.x << "," << p.y << " has height " << found;
                            return;
                        }
                        const int own = std::countr_zero(unsigned(p.x | p.y));
                        if (!tile.contains(p) || (level == layout.top() ? own < level || own >= layout.lattice.level : own != level))
                            continue;
                        const PointBounds bounds = tile.bounds_of(p), wanted = errors.bounds(p);
                        if (text(bounds) != text(wanted) && ++wrong < 5) {
                            ADD_FAILURE() << "level " << level << ", " << p.x << "," << p.y << ": " << text(bounds) << ", not "
                                          << text(wanted);
                        }
                        EXPECT_GE(entry.bounds.error, wanted.error);
                        EXPECT_LE(entry.bounds.low, wanted.low);
                        EXPECT_GE(entry.bounds.high, wanted.high);
                        most = std::max(most, wanted.error);
                        ++points;
                    }
                EXPECT_EQ(entry.bounds.error, most);
            }
    EXPECT_EQ(wrong, 0u);
    EXPECT_GE(points, layout.lattice.level > 0 ? map.heights.size() / 2 : 0);
}

class PyramidBuild : public testing::Test {
protected:
    std::filesystem::path path() const { return folder_.path() / "t.pyramid"; }
    TemporaryFolder folder_;
};

TEST_F(PyramidBuild, HoldsHeightsAndErrorsOfMapsOfAnySize)
{
    for (const ivec2& size : {ivec2(2, 2), ivec2(3, 3), ivec2(5, 5), ivec2(3, 9), ivec2(33, 33), ivec2(34, 33), ivec2(100, 37),
                              ivec2(129, 65), ivec2(327, 210), ivec2(513, 513), ivec2(2, 70)}) {
        SCOPED_TRACE(fmt::format("{} x {}", size.x, size.y));
        const HeightMap map = rough_terrain(size.x, size.y);
        const BuiltPyramid built = build_pyramid(rows_of(map), path());
        EXPECT_EQ(built.samples, map.heights.size());
        EXPECT_EQ(built.bytes, std::filesystem::file_size(path()));
        expect_map_in_tiles(map, TerrainPyramid(path()));
    }
}

TEST_F(PyramidBuild, HoldsTheBordersOfHoles)
{
    for (const ivec2& size : {ivec2(65, 65), ivec2(150, 90), ivec2(700, 611)}) {
        SCOPED_TRACE(fmt::format("{} x {}", size.x, size.y));
        const HeightMap map = holey_terrain(size.x, size.y);
        build_pyramid(rows_of(map), path());
        expect_map_in_tiles(map, TerrainPyramid(path()));
    }
}

/// Errors of triangles too large for the rows in memory: 512 samples and more.
TEST_F(PyramidBuild, HoldsTheErrorsOfTrianglesThatAreLargerThanATile)
{
    for (const HeightMap& map : {rough_terrain(1025, 1025), holey_terrain(1000, 980)}) {
        build_pyramid(rows_of(map), path());
        const TerrainPyramid pyramid(path());
        EXPECT_GT(pyramid.lattice().level, 9);
        expect_map_in_tiles(map, pyramid);
    }
}

TEST_F(PyramidBuild, WritesTheSameBytesWithAnyNumberOfThreads)
{
    const HeightMap map = holey_terrain(600, 520);
    std::string first;
    for (const int threads : {1, 2, 3}) {
        with_threads(threads, [&] { build_pyramid(rows_of(map), path()); });
        const std::string bytes = read_text(path());
        EXPECT_TRUE(first.empty() || bytes == first) << threads;
        first = bytes;
    }
}

} // namespace
} // namespace limn::test
