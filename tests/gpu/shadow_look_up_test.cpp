#include "limn/gpu/shadow_look_up.h"

#include <fmt/format.h>

#include "gpu/gpu.h"
#include "limn/base/random.h"
#include "limn/shadow/shadow_error.h"
#include "shadow/baked.h"
#include "shadow/shadow_meshes.h"

namespace limn::test {
namespace {

vec3 random_direction(Random& random) { return glm::normalize(vec3(dvec3(random.normal(), random.normal(), random.normal()))); }

/// Of all kinds: from the object, from outside, to lamps near and far, and to lights at infinity.
std::vector<ShadowQuery> mixed_queries(const CasterRays& rays, std::size_t count)
{
    std::vector<ShadowQuery> queries(count);
    parallel_each(count, 4096, [&](std::size_t i) {
        Random random(17, i);
        ShadowQuery& query = queries[i];
        const vec3 from = 1.5f * random_direction(random), towards = 0.5f * random_direction(random) - from;
        const Hit hit = rays.rays().closest({from, towards});
        query.from = hit && i % 8 != 0 ? from + hit.distance * towards : 3.0f * from;
        const vec3 d = random_direction(random);
        query.to = i % 5 == 0 ? vec4(d, 0) : vec4(float(random.uniform(0.2, 3)) * d, 1);
        if (i % 2)
            query.among = vec2(float(random.uniform()), float(random.uniform()));
    });
    return queries;
}

/// Checklist 21: the device's answers are the processor's, for every grid and order.
TEST_F(Gpu, LooksShadowsUpAsTheProcessor)
{
    const ShadowCaster knot = anchor_caster(anchor_knot());
    const CasterRays rays(knot);
    const std::vector<ShadowQuery> queries = mixed_queries(rays, 350000);
    const MapLayout layouts[] = {{{DirectionSpread::even, {64, 16}}, MapOrder::theta_zigzag, 64},
                                 {{DirectionSpread::polar, {16, 20}}, MapOrder::phi_linear, 50},
                                 {{DirectionSpread::octahedral, {16, 16}}, MapOrder::hilbert, 64}};
    std::size_t total = 0, differ = 0;
    for (const MapLayout& layout : layouts) {
        const SegmentLists lists = baked(knot, layout);
        const LookUp look(layout, lists);
        std::vector<Verdict> wanted(queries.size());
        look.at_in_parallel(queries, wanted);
        const std::vector<Verdict> found = gpu::ShadowLookUp(layout, lists).at(queries);
        ASSERT_EQ(found.size(), wanted.size());
        std::array<std::size_t, 3> kinds = {};
        for (std::size_t i = 0; i < queries.size(); ++i) {
            differ += found[i] != wanted[i];
            ++kinds[std::size_t(wanted[i])];
        }
        EXPECT_GT(std::min({kinds[0], kinds[1], kinds[2]}), queries.size() / 100);
        total += queries.size();
    }
    fmt::print("{} of {} answers differ\n", differ, total);
    EXPECT_GE(total, 1000000u);
    EXPECT_LE(double(differ), 1e-4 * double(total));
}

} // namespace
} // namespace limn::test
