#include <gtest/gtest.h>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/shadow/place_look_up.h"
#include "limn/shadow/shadow_error.h"
#include "shadow/baked.h"
#include "shadow/shadow_meshes.h"

namespace limn::test {
namespace {

MapLayout square_layout(int side, int size) { return {{DirectionSpread::even, {side, side}}, MapOrder::theta_zigzag, size}; }

template <class Look> AskShadows asking(const Look& look)
{
    return [&look](std::span<const ShadowQuery> queries, std::span<Verdict> verdicts) { look.at(queries, verdicts); };
}

/// Anchors of 8.3: the knot, 64 x 64 texels, within 10 %.
TEST(ShadowError, IsThatOfTheAnchorsOnTheObject)
{
    struct Row {
        int side;
        double of_facing, of_pixels;
    };
    const ShadowCaster knot = anchor_caster(anchor_knot());
    const CasterRays truth(knot);
    ObjectErrorOptions options;
    options.images = 60;
    for (const Row& row : {Row{8, 19.6, 4.3}, Row{16, 13.9, 3.0}, Row{32, 10.6, 2.3}, Row{64, 8.2, 1.8}}) {
        const MapLayout layout = square_layout(row.side, 64);
        const SegmentLists lists = baked(knot, layout);
        const LookUp look(layout, lists);
        const ObjectShadowError error = object_shadow_error(truth, asking(look), options);
        fmt::print("{} maps: {:.2f} % of lit-facing places ({} wanted), {:.2f} % of the object's, {:.2f} % of all pixels ({} wanted)\n", row.side * row.side, error.of_facing(), row.of_facing,
                   error.of_object(), error.of_pixels(), row.of_pixels);
        EXPECT_NEAR(error.of_facing(), row.of_facing, 0.1 * row.of_facing);
        EXPECT_EQ(error.unknown, 0u) << "lamps are outside";
        EXPECT_LT(error.facing, error.object);
        EXPECT_LT(error.object, error.pixels);
    }
}

/// Anchors of 6.4: on a floor, by the texel of the place itself as the seed does, and by the line's place nearest to the middle.
TEST(ShadowError, IsSeveralTimesSmallerOnAFloorByTheMiddleOfTheLine)
{
    struct Row {
        bool blob;
        int side, size;
        double by_place, by_middle;
    };
    for (const Row& row : {Row{false, 32, 64, 19.4, 5.1}, Row{true, 32, 128, 7.9, 1.1}}) {
        const ShadowCaster caster = anchor_caster(row.blob ? anchor_blob() : anchor_knot());
        const CasterRays truth(caster);
        const MapLayout layout = square_layout(row.side, row.size);
        const SegmentLists lists = baked(caster, layout);
        const LookUp look(layout, lists);
        const PlaceLookUp as_seed(layout, lists);
        const FloorShadowError by_place = floor_shadow_error(truth, asking(as_seed)), by_middle = floor_shadow_error(truth, asking(look));
        fmt::print("{} {} maps of {} px: {:.2f} % by place ({} wanted), {:.2f} % by the middle ({} wanted), {} queries\n", row.blob ? "blob" : "knot", row.side * row.side, row.size,
                   by_place.of_queries(), row.by_place, by_middle.of_queries(), row.by_middle, by_middle.queries);
        EXPECT_NEAR(by_place.of_queries(), row.by_place, 0.1 * row.by_place);
        EXPECT_NEAR(by_middle.of_queries(), row.by_middle, 0.1 * row.by_middle);
    }
}

TEST(ShadowError, IsNoneForRays)
{
    const ShadowCaster knot = anchor_caster(anchor_knot());
    const CasterRays truth(knot);
    const AskShadows rays = [&](std::span<const ShadowQuery> queries, std::span<Verdict> verdicts) {
        for (std::size_t i = 0; i < queries.size(); ++i)
            verdicts[i] = truth.at(queries[i]);
    };
    const AskShadows light = [](std::span<const ShadowQuery>, std::span<Verdict> verdicts) { std::fill(verdicts.begin(), verdicts.end(), Verdict::lit); };
    const ObjectErrorOptions few = {.images = 4, .size = 48};
    EXPECT_EQ(object_shadow_error(truth, rays, few).wrong, 0u);
    EXPECT_EQ(floor_shadow_error(truth, rays, {2000}).wrong, 0u);
    EXPECT_GT(object_shadow_error(truth, light, few).of_facing(), 5);
    EXPECT_GT(floor_shadow_error(truth, light, {2000}).of_queries(), 5);
    EXPECT_THROW(object_shadow_error(truth, rays, {.images = 0}), Error::Input);
    EXPECT_THROW(object_shadow_error(truth, rays, {.nearest = 0.5}), Error::Input);
    EXPECT_THROW(floor_shadow_error(truth, rays, {0}), Error::Input);
}

} // namespace
} // namespace limn::test
