#include <gtest/gtest.h>

#include <fmt/format.h>

#include "limn/base/random.h"
#include "limn/shadow/bake_maps.h"
#include "limn/shadow/pixel_codec.h"
#include "shadow/shadow_meshes.h"

namespace limn::test {
namespace {

SegmentLists compressed(const ShadowCaster& caster, int size, int side, MapOrder order)
{
    PixelCodec codec(std::size_t(size) * std::size_t(size));
    bake_maps(caster, {DirectionSpread::even, {side, side}}, order, size, [&](std::uint32_t, const DepthLayers& layers) { codec.add(layers); });
    return codec.finish();
}

/// Checklist 11 and 13: the anchors of section 8.3, within 3 %.
TEST(PixelCodec, HasAsManySegmentsAsTheAnchors)
{
    struct Row {
        bool blob;
        int size, side;
        std::size_t theta_zigzag, theta_linear, hilbert, phi_linear, phi_zigzag;
    };
    const Row rows[] = {{true, 32, 32, 65891, 68323, 81190, 116037, 113097},
                        {false, 64, 8, 64549, 64651, 77816, 99951, 94451},
                        {false, 64, 16, 157151, 161170, 218380, 313203, 300908},
                        {false, 64, 32, 362067, 382582, 502194, 758309, 736662}};
    const ShadowCaster blob = anchor_caster(anchor_blob()), knot = anchor_caster(anchor_knot());
    for (const Row& row : rows) {
        const auto check = [&](MapOrder order, std::size_t wanted) {
            const std::size_t found = compressed(row.blob ? blob : knot, row.size, row.side, order).segments.size();
            fmt::print("{} {} px, {} maps, order {}: {} segments, {} wanted\n", row.blob ? "blob" : "knot", row.size, row.side * row.side, int(order), found, wanted);
            EXPECT_NEAR(double(found), double(wanted), 0.03 * double(wanted));
        };
        check(MapOrder::theta_zigzag, row.theta_zigzag);
        check(MapOrder::theta_linear, row.theta_linear);
        check(MapOrder::hilbert, row.hilbert);
        check(MapOrder::phi_linear, row.phi_linear);
        check(MapOrder::phi_zigzag, row.phi_zigzag);
    }
}

/// Checklist 7 and 9: what is found stands between both surfaces of every texel of every map, and is what a search from the start finds.
TEST(PixelCodec, LosesNothing)
{
    constexpr int size = 32;
    const ShadowCaster knot = make_shadow_caster(anchor_knot());
    const DirectionGrid grid{DirectionSpread::even, {16, 16}};
    for (const float margin : {0.0f, 0.1f, 0.4f}) {
        PixelCodec codec(std::size_t(size * size), margin);
        std::vector<DepthLayers> maps;
        bake_maps(knot, grid, MapOrder::theta_zigzag, size, [&](std::uint32_t, const DepthLayers& layers) {
            codec.add(layers);
            maps.push_back(layers);
        });
        const SegmentLists lists = codec.finish();
        for (std::uint32_t rank = 0; rank < grid.count(); ++rank)
            for (std::size_t texel = 0; texel < std::size_t(size * size); ++texel) {
                const float near = maps[rank].near[texel], far = maps[rank].far[texel], found = lists.depth(texel, rank);
                if (near == no_surface) {
                    ASSERT_EQ(found, no_surface);
                    continue;
                }
                const float away = 0.999f * margin * (far - near);
                ASSERT_GE(found, near + away) << margin;
                ASSERT_LE(found, far - away) << margin;
                ASSERT_LT(found, far);
                const std::span<const DepthSegment> list = lists.list(texel);
                std::size_t i = 0;
                while (list[i].last < rank)
                    ++i;
                ASSERT_EQ(list[i].depth, found);
            }
        EXPECT_EQ(lists.list(0).size(), 1u); // a corner sees the background in all maps
    }
}

/// The fewest pieces of a list of intervals, by trying all cuts.
std::size_t fewest_pieces(const DepthLayers& intervals)
{
    const std::size_t n = intervals.near.size();
    std::vector<std::size_t> fewest(n + 1, 0);
    for (std::size_t end = 1; end <= n; ++end) {
        fewest[end] = n;
        float low = -1, high = 2;
        bool any_background = false, any_hit = false;
        for (std::size_t begin = end; begin-- > 0;) {
            any_background |= intervals.near[begin] == no_surface, any_hit |= intervals.near[begin] != no_surface;
            if (intervals.near[begin] != no_surface)
                low = std::max(low, intervals.near[begin]), high = std::min(high, intervals.far[begin]);
            if ((any_background && any_hit) || !(low < high))
                break;
            fewest[end] = std::min(fewest[end], fewest[begin] + 1);
        }
    }
    return fewest[n];
}

/// Checklist 8.
TEST(PixelCodec, HasAsFewPiecesAsThereCanBe)
{
    for (std::uint64_t seed = 0; seed < 10000; ++seed) {
        Random random(seed);
        DepthLayers list;
        const std::size_t length = 1 + random.below(12);
        PixelCodec codec(1);
        for (std::size_t i = 0; i < length; ++i) {
            const float low = float(random.uniform(0, 0.8)), high = low + float(random.uniform(0.01, 0.5));
            const bool background = random.below(6) == 0;
            list.near.push_back(background ? no_surface : low);
            list.far.push_back(background ? no_surface : high);
            codec.add({1, {list.near.back()}, {list.far.back()}});
        }
        ASSERT_EQ(codec.finish().segments.size(), fewest_pieces(list)) << seed;
    }
}

} // namespace
} // namespace limn::test
