#include <gtest/gtest.h>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/shadow/bake_maps.h"
#include "limn/base/random.h"
#include "limn/shadow/candidate_triangles.h"
#include "shadow/shadow_meshes.h"
#include "support/instruction_sets.h"

namespace limn::test {
namespace {

/// Depths at which a line along a frame's direction meets the triangles, found one triangle after the other in double.
std::vector<double> depths_along(const ShadowCaster& caster, const MapFrame& frame, double u, double v)
{
    const dvec3 right(frame.right), up(frame.up), towards(frame.towards);
    std::vector<double> depths;
    const auto at = [&](std::uint32_t i) {
        const dvec3 p(caster.x[i], caster.y[i], caster.z[i]);
        return dvec3(glm::dot(p, right) - u, glm::dot(p, up) - v, 0.5 - 0.5 * glm::dot(p, towards));
    };
    for (const uvec3& t : caster.triangles) {
        const dvec3 a = at(t.x), b = at(t.y), c = at(t.z);
        const double wa = b.x * c.y - b.y * c.x, wb = c.x * a.y - c.y * a.x, wc = a.x * b.y - a.y * b.x;
        if ((wa >= 0 && wb >= 0 && wc >= 0) || (wa <= 0 && wb <= 0 && wc <= 0))
            if (wa + wb + wc != 0)
                depths.push_back((wa * a.z + wb * b.z + wc * c.z) / (wa + wb + wc));
    }
    std::sort(depths.begin(), depths.end());
    return depths;
}

/// Checklist 4 and 5.
TEST(DepthLayers, AreTheFirstAndSecondHitsOfRays)
{
    constexpr int size = 48;
    const ShadowCaster knot = make_shadow_caster(anchor_knot());
    DepthPainter painter(knot, size);
    const DirectionGrid grid{DirectionSpread::even, {16, 16}};
    std::size_t covered = 0, off = 0, open = 0;
    DepthLayers layers;
    for (const ivec2& cell : {ivec2(0, 0), ivec2(7, 3), ivec2(15, 9), ivec2(3, 12)}) {
        const MapFrame frame = grid.frame(cell);
        painter.paint(frame, layers);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const std::size_t i = std::size_t(y * size + x);
                const std::vector<double> hits = depths_along(knot, frame, (2 * x + 1.0) / size - 1, (2 * y + 1.0) / size - 1);
                const bool is_hit = layers.near[i] != no_surface;
                if (!is_hit && hits.empty())
                    continue;
                ++covered;
                open += hits.size() == 1;
                const bool agrees = is_hit && hits.size() >= 2 && std::abs(double(layers.near[i]) - hits[0]) < 1e-4 && std::abs(double(layers.far[i]) - hits[1]) < 1e-4;
                off += !agrees;
                if (is_hit) {
                    EXPECT_LT(layers.near[i], layers.far[i]);
                }
            }
    }
    fmt::print("{} of {} covered texels differ\n", off, covered);
    EXPECT_GT(covered, 2000u);
    EXPECT_LE(double(off), 0.001 * double(covered));
    EXPECT_LT(double(open), 1e-4 * double(covered) + 1);
}

/// Middles on edges and at vertices belong to one triangle: nothing is met twice, and nothing is missed.
TEST(DepthLayers, CountASurfaceOnceOnEdges)
{
    Mesh fan; // a square whose middle is the middle of a texel, and its corners' texels' too
    fan.positions = {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}, {0, 0, 0}};
    fan.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    ShadowCaster caster = make_shadow_caster(fan);
    caster.sphere = {{0, 0, 0}, 1};
    for (std::size_t i = 0; i < 5; ++i)
        caster.x[i] = float(fan.positions[i].x), caster.y[i] = float(fan.positions[i].y), caster.z[i] = float(fan.positions[i].z);
    MapFrame frame;
    frame.right = {1, 0, 0}, frame.up = {0, 1, 0}, frame.towards = {0, 0, 1};
    for (const int size : {5, 7, 9, 31}) {
        DepthLayers layers;
        DepthPainter(caster, size).paint(frame, layers);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const double u = (2 * x + 1.0) / size - 1, v = (2 * y + 1.0) / size - 1;
                const bool inside = std::abs(u) < 0.4999 && std::abs(v) < 0.4999, outside = std::abs(u) > 0.5001 || std::abs(v) > 0.5001;
                const float near = layers.near[std::size_t(y * size + x)], far = layers.far[std::size_t(y * size + x)];
                if (inside) {
                    EXPECT_EQ(near, 0.5f) << size << " " << x << " " << y;
                    EXPECT_NEAR(far, 0.5 + 0.5 * std::sqrt(1 - u * u - v * v), 1e-6); // the way out: there is no second surface
                } else if (outside) {
                    EXPECT_EQ(near, no_surface);
                    EXPECT_EQ(far, no_surface);
                }
            }
    }
    DepthLayers layers;
    DepthPainter(caster, 9, OpenBack::constant).paint(frame, layers);
    EXPECT_EQ(layers.far[40], 0.5f + open_thickness);
}

TEST(DepthLayers, AreDrawnInAnyNumberOfThreadsAlike)
{
    EXPECT_THROW(make_shadow_caster(Mesh()), Error::Input);
    const ShadowCaster caster = make_shadow_caster(anchor_knot());
    const DirectionGrid grid{DirectionSpread::octahedral, {5, 9}};
    DepthPainter one(caster, 20);
    std::uint32_t ranks = 0;
    bake_maps(caster, grid, MapOrder::phi_zigzag, 20, [&](std::uint32_t rank, const DepthLayers& layers) {
        ASSERT_EQ(rank, ranks++);
        DepthLayers wanted;
        one.paint(grid.frame(cell_of_rank(MapOrder::phi_zigzag, grid.cells, rank)), wanted);
        ASSERT_EQ(layers.near, wanted.near);
        ASSERT_EQ(layers.far, wanted.far);
    });
    EXPECT_EQ(ranks, 45u);
}

/// Every instruction set draws the same, and no triangle that covers a middle is left out.
TEST(DepthLayers, AreTheSameForEveryInstructionSet)
{
    const ShadowCaster blob = make_shadow_caster(anchor_blob());
    const MapFrame frame = DirectionGrid{DirectionSpread::even, {5, 7}}.frame({2, 3});
    std::vector<DepthLayers> all;
    with_each_instruction_set([&](const char* name) {
        DepthPainter(blob, 48).paint(frame, all.emplace_back());
        EXPECT_EQ(all.back().near, all.front().near) << name;
        EXPECT_EQ(all.back().far, all.front().far) << name;
    });
    EXPECT_GE(all.size(), 2u);
}

TEST(CandidateTriangles, HoldAllThatCoverAMiddleAndFewOthers)
{
    constexpr std::int32_t one = 1 << map_fraction_bits, half = one / 2;
    Random random(4);
    std::vector<MapVertex> vertices;
    std::vector<uvec3> triangles;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        const auto u = std::int32_t(random.below(16 * one)), v = std::int32_t(random.below(16 * one));
        for (int k = 0; k < 3; ++k) // now and then on a middle itself
            vertices.push_back(random.below(20) == 0 ? MapVertex{(u / one) * one + half, (v / one) * one + half, 0}
                                                     : MapVertex{u + std::int32_t(random.below(one)), v + std::int32_t(random.below(one)), 0});
        triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const auto covers = [&](const uvec3& t) {
        const MapVertex p[3] = {vertices[t.x], vertices[t.y], vertices[t.z]};
        for (std::int64_t y = half; y < 18 * one; y += one)
            for (std::int64_t x = half; x < 18 * one; x += one) {
                bool left = true, right = true;
                for (int k = 0; k < 3; ++k) {
                    const MapVertex &a = p[k], &b = p[(k + 1) % 3];
                    const std::int64_t side = std::int64_t(b.u - a.u) * (y - a.v) - std::int64_t(b.v - a.v) * (x - a.u);
                    left = left && side >= 0, right = right && side <= 0;
                }
                if (left || right)
                    return true;
            }
        return false;
    };
    std::vector<char> wanted(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i)
        wanted[i] = covers(triangles[i]);
    with_each_instruction_set([&](const char* name) {
        std::vector<std::uint32_t> candidates;
        find_candidate_triangles(triangles, vertices, candidates);
        std::vector<char> found(triangles.size(), 0);
        for (const std::uint32_t i : candidates)
            found[i] = 1;
        std::size_t more = 0;
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            ASSERT_LE(wanted[i], found[i]) << name << " " << i;
            more += found[i] && !wanted[i];
        }
        EXPECT_LT(more, triangles.size() / 10) << name;
        EXPECT_TRUE(std::is_sorted(candidates.begin(), candidates.end()));
    });
}

} // namespace
} // namespace limn::test
