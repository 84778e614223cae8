#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "limn/base/random.h"
#include "limn/shadow/shadow_error.h"
#include "shadow/baked.h"
#include "shadow/shadow_meshes.h"

namespace limn::test {
namespace {

/// Maps of a ball about the middle, which look alike from all sides: the middle of its two surfaces in each texel.
struct Ball {
    int size;
    float radius;
    float depth(std::size_t texel, std::uint32_t) const
    {
        const float u = (2 * float(int(texel) % size) + 1) / float(size) - 1, v = (2 * float(int(texel) / size) + 1) / float(size) - 1;
        return u * u + v * v < radius * radius ? 0.5f : no_surface;
    }
};

vec4 place(const vec3& p) { return {p, 1}; }
vec4 far_towards(const vec3& d) { return {d, 0}; }

vec3 random_direction(Random& random) { const double z = random.normal(), y = random.normal(), x = random.normal(); // in an order that no compiler chooses
    return glm::normalize(vec3(dvec3(x, y, z))); }

const MapLayout fine = {{DirectionSpread::even, {64, 64}}, MapOrder::theta_zigzag, 256};

/// Checklist 21: each guard of section 2.8.
TEST(LookUp, AnswersWithoutMapsWhereTheObjectCannotBeBetween)
{
    const Ball ball{fine.size, 0.5f};
    const LookUp look(fine, ball);
    const auto at = [&](const vec3& p, const vec4& q) { return look.at({p, q}); };
    EXPECT_EQ(at({0, -3, 0}, place({0, 3, 0})), Verdict::dark) << "through the ball";
    EXPECT_EQ(at({0, -3, 0}, place({3, -3, 0})), Verdict::lit) << "misses the sphere";
    EXPECT_EQ(at({0, -3, 0}, place({0, -1.5f, 0})), Verdict::lit) << "the light is before the object";
    EXPECT_EQ(at({0, 1.5f, 0}, place({0, 3, 0})), Verdict::lit) << "the receiver is behind the object, seen from the light";
    EXPECT_EQ(at({0, 3, 0}, place({0, 1.5f, 0})), Verdict::lit) << "and the other way round";
    EXPECT_EQ(at({0, 0.9f, 0}, place({0, 3, 0})), Verdict::lit) << "the receiver is in front of the surface, in the sphere";
    EXPECT_EQ(at({0, -0.9f, 0}, place({0, 3, 0})), Verdict::dark);
    EXPECT_EQ(at({0.8f, -0.5f, 0}, place({0.8f, 3, 0})), Verdict::lit) << "beside the ball: background";
    EXPECT_EQ(at({0, -3, 0}, far_towards({0, 2, 0})), Verdict::dark) << "light at infinity";
    EXPECT_EQ(at({0, -3, 0}, far_towards({0, -2, 0})), Verdict::lit);
    EXPECT_EQ(at({0, -3, 0}, far_towards({1, 0, 0})), Verdict::lit);
    EXPECT_EQ(at({0, -0.9f, 0}, far_towards({0, 1, 0})), Verdict::dark);
    EXPECT_EQ(at({0.2f, -0.9f, 0}, place({0.2f, -0.9f, 0})), Verdict::lit) << "no way between them";
}

TEST(LookUp, TakesTheEndInTheSphere)
{
    const Ball ball{fine.size, 0.5f};
    const LookUp look(fine, ball);
    const auto at = [&](const vec3& p, const vec3& q) { return look.at({p, place(q)}); };
    EXPECT_EQ(at({0, -3, 0}, {0, 0.8f, 0}), Verdict::dark) << "the light in the sphere, behind the ball";
    EXPECT_EQ(at({0, -3, 0}, {0, -0.8f, 0}), Verdict::lit) << "in front of it";
    EXPECT_EQ(at({0, 3, 0}, {0, 0.8f, 0}), Verdict::lit);
    EXPECT_EQ(at({0, -0.8f, 0}, {0, 0.8f, 0}), Verdict::dark) << "both in the sphere: the light in front of the depth";
    EXPECT_EQ(at({0, -0.8f, 0}, {0.02f, -0.7f, 0}), Verdict::unknown) << "the light behind it";
    EXPECT_EQ(at({0, 0.6f, 0}, {0, 0.9f, 0}), Verdict::lit) << "nothing between the receiver and the outside";
    EXPECT_EQ(at({0.9f, -0.1f, 0}, {0.9f, 0.1f, 0}), Verdict::lit);
}

/// Outside the map: a coarse grid's map looks from so far aside that a place in the sphere falls beside it.
TEST(LookUp, IsLitOutsideTheMap)
{
    EXPECT_EQ(formulas::texel_at({-0.01f, 3}, 8), formulas::NO_TEXEL);
    EXPECT_EQ(formulas::texel_at({8, 3}, 8), formulas::NO_TEXEL);
    EXPECT_EQ(formulas::texel_at({3, std::nanf("")}, 8), formulas::NO_TEXEL);
    EXPECT_EQ(formulas::texel_at({7.9f, 3}, 8), 31u);
    struct Wall {
        float depth(std::size_t, std::uint32_t) const { return 0; }
    };
    const MapLayout one = {{DirectionSpread::even, {2, 2}}, MapOrder::theta_zigzag, 1};
    const Wall wall;
    const LookUp look(one, wall);
    EXPECT_EQ(look.at({{0, 0, 0}, far_towards({0, 1, 0.1f})}), Verdict::dark);
}

/// Lines between random places, inside and outside the sphere, against the ball itself.
TEST(LookUp, FindsABallBetweenRandomPlaces)
{
    const float radius = 0.6f;
    const Ball ball{fine.size, radius};
    const LookUp look(fine, ball);
    Random random(3);
    std::array<std::size_t, 3> found = {};
    for (int i = 0; i < 200000; ++i) {
        const auto some_place = [&] {
            const float far = float(random.uniform(0.7, 2.5));
            return far * random_direction(random);
        };
        const vec3 p = some_place(), q = some_place();
        const float length = glm::distance(p, q), along = glm::clamp(-glm::dot(p, (q - p) / length), 0.0f, length);
        const float nearest = glm::length(p + along * (q - p) / length);
        if (std::abs(nearest - radius) < 0.13f) // cells are this coarse: those at the poles reach 14 degrees from them
            continue;
        const Verdict verdict = look.at({p, place(q)});
        ++found[std::size_t(verdict)];
        if (verdict == Verdict::unknown) {
            EXPECT_TRUE(glm::length(p) < 1 && glm::length(q) < 1);
            continue;
        }
        ASSERT_EQ(verdict == Verdict::dark, nearest < radius) << i << ": " << p.x << " " << p.y << " " << p.z << " to " << q.x << " " << q.y << " " << q.z;
    }
    fmt::print("{} lit, {} dark, {} unknown\n", found[0], found[1], found[2]);
    EXPECT_GT(found[0], 40000u);
    EXPECT_GT(found[1], 20000u);
    EXPECT_GT(found[2], 4u);
}

TEST(LookUp, TakesEachOfTheFourNearestMapsAsOftenAsItIsNear)
{
    const ivec2 cells(8, 8);
    const vec3 d = formulas::frame_of_place(formulas::EVEN_GRID, (vec2(3.75f, 7.75f)) / vec2(cells)).towards;
    EXPECT_EQ(formulas::cell_for(formulas::EVEN_GRID, cells, d, vec2(0.5f)), ivec2(3, 7));
    Random random(5);
    int beside = 0, around = 0;
    const int count = 40000;
    for (int i = 0; i < count; ++i) {
        const ivec2 cell = formulas::cell_for(formulas::EVEN_GRID, cells, d, vec2(float(random.uniform()), float(random.uniform())));
        ASSERT_TRUE((cell.x == 3 || cell.x == 4) && (cell.y == 7 || cell.y == 0)) << cell.x << " " << cell.y;
        beside += cell.x == 4, around += cell.y == 0;
    }
    EXPECT_NEAR(double(beside) / count, 0.25, 0.01);
    EXPECT_NEAR(double(around) / count, 0.25, 0.01);
    for (const int kind : {formulas::EVEN_GRID, formulas::POLAR_GRID, formulas::OCTAHEDRAL_GRID})
        for (int i = 0; i < 20000; ++i) {
            const vec3 any = random_direction(random);
            const DirectionGrid grid = {DirectionSpread(kind), {7, 5}};
            const ivec2 nearest = formulas::cell_for(kind, grid.cells, any, vec2(0.5f)), of = grid.cell_of(any);
            ASSERT_EQ(nearest, of);
        }
}

/// Places on an object that face the lamps around it.
std::vector<ShadowQuery> surface_queries(const CasterRays& rays, std::size_t count, std::uint64_t seed)
{
    std::vector<ShadowQuery> queries;
    Random random(seed);
    while (queries.size() < count) {
        const vec3 from = 1.5f * random_direction(random), towards = 0.7f * float(random.uniform()) * random_direction(random) - from;
        const Hit hit = rays.rays().closest({from, towards});
        if (!hit)
            continue;
        const uvec3& t = rays.triangle(hit.triangle);
        const vec3 p = from + hit.distance * towards, lamp = float(random.uniform(1.05, 3.05)) * random_direction(random);
        const vec3 normal = glm::cross(rays.positions()[t.y] - rays.positions()[t.x], rays.positions()[t.z] - rays.positions()[t.x]);
        if (glm::dot(normal, lamp - p) * glm::dot(normal, towards) < 0)
            queries.push_back({p, place(lamp)});
    }
    return queries;
}

TEST(LookUp, OfManyAtOnceIsThatOfEach)
{
    const ShadowCaster knot = anchor_caster(anchor_knot());
    const MapLayout layout = {{DirectionSpread::octahedral, {16, 16}}, MapOrder::hilbert, 48};
    const SegmentLists lists = baked(knot, layout);
    const LookUp look(layout, lists);
    const CasterRays rays(knot);
    std::vector<ShadowQuery> queries = surface_queries(rays, 20000, 1);
    Random random(2);
    for (std::size_t i = 0; i < queries.size(); i += 3) {
        queries[i].among = vec2(float(random.uniform()), float(random.uniform()));
        queries[i].to = i % 2 ? far_towards(random_direction(random)) : place(queries[i].from + 0.2f * random_direction(random));
    }
    std::vector<Verdict> at_once(queries.size()), in_parallel(queries.size());
    look.at(queries, at_once);
    look.at_in_parallel(queries, in_parallel);
    EXPECT_EQ(at_once, in_parallel);
    struct Plain { // reads one after the other
        const SegmentLists& lists;
        float depth(std::size_t texel, std::uint32_t rank) const { return lists.depth(texel, rank); }
    };
    const Plain plain{lists};
    const LookUp slowly(layout, plain);
    std::vector<Verdict> one_by_one(queries.size());
    slowly.at(queries, one_by_one);
    EXPECT_EQ(at_once, one_by_one);
    std::array<std::size_t, 3> found = {};
    for (std::size_t i = 0; i < queries.size(); ++i) {
        ASSERT_EQ(look.at(queries[i]), at_once[i]);
        ++found[std::size_t(at_once[i])];
    }
    EXPECT_GT(std::min({found[0], found[1], found[2]}), 200u);
}

/// Of lights from one place: of a small light many lie in the direction of one map, and places lie in and outside the sphere.
TEST(LookUp, FromOnePlaceIsThatOfEach)
{
    const ShadowCaster knot = anchor_caster(anchor_knot());
    const MapLayout layout = {{DirectionSpread::even, {32, 16}}, MapOrder::theta_zigzag, 48};
    const SegmentLists lists = baked(knot, layout);
    const LookUp look(layout, lists);
    const CasterRays rays(knot);
    Random random(4);
    std::array<std::size_t, 3> found = {};
    for (const ShadowQuery& query : surface_queries(rays, 2000, 3)) {
        const vec3 from = query.from * float(random.uniform(0.9, 1.6)), lamp(query.to);
        std::vector<ShadowEnd> ends;
        for (int k = 0; k < 100; ++k) { // more than are looked up together
            const vec3 near = lamp + 0.3f * random_direction(random);
            const vec4 to = k % 10 == 0 ? far_towards(near - from) : k % 10 == 1 ? place(0.8f * random_direction(random)) : place(near);
            ends.push_back({to, {float(random.uniform()), float(random.uniform())}});
        }
        std::vector<Verdict> together(ends.size());
        look.at(from, ends, together);
        for (std::size_t k = 0; k < ends.size(); ++k) {
            ASSERT_EQ(look.at({from, ends[k].to, ends[k].among}), together[k]) << k << " of " << glm::length(from);
            ++found[std::size_t(together[k])];
        }
    }
    EXPECT_GT(std::min({found[0], found[1], found[2]}), 500u);
}

/// Checklist 7: what compression chose is what the uncompressed maps say wherever a place is not between both surfaces of its texel.
TEST(LookUp, LosesNothingForPlacesThatAreNotBetweenBothSurfaces)
{
    const ShadowCaster knot = anchor_caster(anchor_knot());
    const MapLayout layout = {{DirectionSpread::even, {16, 16}}, MapOrder::theta_zigzag, 64};
    const DrawnMaps drawn(knot, layout);
    const CasterRays rays(knot);
    const std::vector<ShadowQuery> queries = surface_queries(rays, 400000, 11);
    std::array<double, 2> disagreeing = {};
    for (const float margin : {0.0f, 0.2f}) {
        const SegmentLists lists = baked(knot, layout, margin);
        const LookUp packed(layout, lists);
        const LookUp whole(layout, drawn);
        std::size_t between = 0, differ = 0;
        for (const ShadowQuery& query : queries) {
            const ShadowLine line = formulas::shadow_line(query.from, query.to);
            const ivec2 cell = formulas::cell_for(int(layout.grid.spread), layout.grid.cells, line.direction, query.among);
            const MapProbe probe = formulas::map_probe(layout.grid.frame(cell), layout.size, line);
            const std::uint32_t texel = formulas::texel_at(probe.place, layout.size), rank = rank_of(layout.order, layout.grid.cells, cell);
            const DepthLayers& map = drawn.maps[rank];
            const bool differs = packed.at(query) != whole.at(query);
            if (line.kind == formulas::LINE_FROM && texel != formulas::NO_TEXEL && probe.depth > map.near[texel] && probe.depth < map.far[texel]) {
                ++between, differ += differs;
                continue;
            }
            ASSERT_FALSE(differs) << margin;
        }
        disagreeing[margin > 0] = double(differ) / double(between);
        fmt::print("margin {}: {} of {} queries between both surfaces, of which {:.1f} % differ\n", margin, between, queries.size(), 100 * disagreeing[margin > 0]);
        EXPECT_GT(between, queries.size() / 20);
    }
    EXPECT_GT(disagreeing[0], 0.03);
    EXPECT_LT(disagreeing[0], 0.15);
    EXPECT_LT(disagreeing[1], 0.5 * disagreeing[0]);
}

/// Checklist 24: the more texels of one map, the nearer to rays.
TEST(LookUp, IsNearerToRaysTheMoreTexelsItTakes)
{
    const ShadowCaster knot = anchor_caster(anchor_knot());
    const MapLayout layout = {{DirectionSpread::even, {32, 32}}, MapOrder::theta_zigzag, 128};
    const SegmentLists lists = baked(knot, layout, 0.1f);
    const LookUp look(layout, lists);
    const CasterRays rays(knot);
    const std::vector<ShadowQuery> queries = surface_queries(rays, 40000, 21);
    const auto error = [&](MapTaps taps) {
        double sum = 0;
        for (const ShadowQuery& query : queries) {
            const std::optional<float> share = look.lit_share(query, taps);
            EXPECT_TRUE(share) << "the lamp is outside";
            const double off = double(share.value_or(0)) - (rays.at(query) == Verdict::lit ? 1 : 0);
            sum += off * off;
        }
        return std::sqrt(sum / double(queries.size()));
    };
    const double one = error(MapTaps::one), four = error(MapTaps::four), sixteen = error(MapTaps::sixteen), maps = error(MapTaps::four_maps), maps_four = error(MapTaps::four_maps_four);
    fmt::print("root mean square error of 1, 4, 16 texels of one map, 1 and 4 of four maps: {:.4f} {:.4f} {:.4f} {:.4f} {:.4f}\n", one, four, sixteen, maps, maps_four);
    EXPECT_LT(four, one);
    EXPECT_LT(sixteen, four);
    EXPECT_LT(maps, one);
    EXPECT_LT(maps_four, maps);
    const ShadowQuery free = {{3, 0, 0}, far_towards({1, 0, 0})};
    EXPECT_EQ(look.lit_share(free, MapTaps::four_maps), 1.0f);
}

} // namespace
} // namespace limn::test
