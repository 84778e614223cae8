#include <gtest/gtest.h>

#include <fmt/format.h>

#include "limn/base/random.h"
#include "limn/shadow/caster_rays.h"
#include "limn/shadow/map_occlusion.h"
#include "shadow/baked.h"
#include "shadow/shadow_meshes.h"

namespace limn::test {
namespace {

vec3 random_direction(Random& random) { return glm::normalize(vec3(dvec3(random.normal(), random.normal(), random.normal()))); }

/// A turn about an axis, a scale and a move.
dmat4 placed(const dvec3& axis, double angle, double scale, const dvec3& to)
{
    const dvec3 a = glm::normalize(axis);
    const double c = std::cos(angle), s = std::sin(angle);
    dmat4 m(1);
    for (int i = 0; i < 3; ++i) {
        dvec3 e(0);
        e[i] = 1;
        m[i] = dvec4(scale * (c * e + s * glm::cross(a, e) + (1 - c) * glm::dot(a, e) * a), 0);
    }
    m[3] = dvec4(to, 1);
    return m;
}

dvec3 transformed(const dmat4& m, const dvec3& p) { return dvec3(m * dvec4(p, 1)); }

/// A knot with its maps, and rays against it.
struct Knot {
    ShadowCaster caster = make_shadow_caster(anchor_knot());
    MapLayout layout = {{DirectionSpread::even, {32, 32}}, MapOrder::theta_zigzag, 64};
    SegmentLists lists = baked(caster, layout, 0.1f);
    std::shared_ptr<const LookUp<SegmentLists>> maps = std::make_shared<const LookUp<SegmentLists>>(layout, lists);
    CasterRays rays{caster};
};

using Occluder = MapOcclusion<SegmentLists>;

/// Pairs of places around an object as it stands in its own space: receivers on it and around it, lamps outside.
std::vector<std::pair<dvec3, dvec3>> pairs_around(const Knot& knot, std::size_t count)
{
    std::vector<std::pair<dvec3, dvec3>> pairs;
    Random random(3);
    const auto own = [&](const vec3& unit) { return knot.caster.sphere.centre + knot.caster.sphere.radius * dvec3(unit); };
    while (pairs.size() < count) {
        const vec3 from = 1.5f * random_direction(random), towards = 0.7f * float(random.uniform()) * random_direction(random) - from;
        const Hit hit = knot.rays.rays().closest({from, towards});
        if (hit)
            pairs.push_back({own(pairs.size() % 2 ? from + 0.999f * hit.distance * towards : from), own(float(random.uniform(1.2, 3)) * random_direction(random))});
    }
    return pairs;
}

/// Answers for pairs that stand where an object stands, in the frame of a scene.
std::vector<std::uint8_t> answers(const Occlusion& occlusion, const std::vector<std::pair<dvec3, dvec3>>& pairs, const dmat4& place, const dvec3& centre, double scale)
{
    std::vector<std::uint8_t> lit;
    for (const auto& [p, q] : pairs) {
        const LightPlace to = {vec4(vec3((transformed(place, q) - centre) / scale), 1), vec2(0.5f)};
        occlusion.look(vec3((transformed(place, p) - centre) / scale), {&to, 1}, &lit.emplace_back());
    }
    return lit;
}

/// Checklist 22: turning, scaling and moving an object and all around it changes nothing but rounding.
TEST(MapOcclusion, GoesWithItsObject)
{
    const Knot knot;
    const auto pairs = pairs_around(knot, 20000);
    const auto by_maps = [&](const dmat4& place, const dvec3& centre, double scale) {
        return answers(Occluder({{knot.maps, unit_placement(knot.caster.sphere, place, centre, scale)}}, knot.rays.rays()), pairs, place, centre, scale);
    };
    const std::vector<std::uint8_t> still = by_maps(dmat4(1), dvec3(0), 1);
    const std::size_t dark = std::size_t(std::count(still.begin(), still.end(), 0));
    EXPECT_GT(dark, 2000u);
    EXPECT_LT(dark, 18000u);
    for (const dmat4& place : {placed({1, 2, 3}, 1.1, 1, {0, 0, 0}), placed({0, 1, 0}, 0.3, 25, {100, -30, 7}), placed({3, -1, 1}, 2.5, 1e-3, {0.02, 0, 0.01})}) {
        const dvec3 centre = transformed(place, {0.3, -0.2, 0.1});
        const std::vector<std::uint8_t> moved = by_maps(place, centre, 2 * glm::length(dvec3(place[0])));
        std::size_t differ = 0;
        for (std::size_t i = 0; i < still.size(); ++i)
            differ += still[i] != moved[i];
        fmt::print("{} of {} answers differ\n", differ, still.size());
        EXPECT_LT(double(differ), 1e-3 * double(still.size()));
    }
}

/// Checklist 22: of several objects a place is lit if it is lit of each, and copies share their maps.
TEST(MapOcclusion, OfSeveralObjectsIsTheProductOfEach)
{
    const Knot knot;
    const dmat4 here(1), there = placed({0, 1, 1}, 1, 0.7, {4, 1, 0});
    const dvec3 centre(1, 0, 0);
    const Occluder::Object first = {knot.maps, unit_placement(knot.caster.sphere, here, centre, 3)}, second = {knot.maps, unit_placement(knot.caster.sphere, there, centre, 3)};
    EXPECT_EQ(first.maps.get(), second.maps.get());
    const RayScene& rays = knot.rays.rays(); // asked nowhere: all lamps are outside
    const auto pairs = pairs_around(knot, 8000);
    const std::vector<std::uint8_t> of_first = answers(Occluder({first}, rays), pairs, here, centre, 3), of_second = answers(Occluder({second}, rays), pairs, here, centre, 3),
                                    of_both = answers(Occluder({first, second}, rays), pairs, here, centre, 3);
    std::size_t only_second = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        ASSERT_EQ(of_both[i], of_first[i] && of_second[i]);
        only_second += of_first[i] && !of_second[i];
    }
    EXPECT_GT(only_second, 50u);
    const auto others = std::make_shared<const Occluder>(std::vector<Occluder::Object>{second}, rays);
    EXPECT_EQ(answers(Occluder({first}, rays, others), pairs, here, centre, 3), of_both) << "what has no maps hides light as well";
}

/// Where one depth cannot tell, rays do.
TEST(MapOcclusion, TakesRaysWhereMapsCannotTell)
{
    const Knot knot;
    const BoundingSphere unit = {{0, 0, 0}, 1};
    const Occluder maps({{knot.maps, unit_placement(unit, dmat4(1), dvec3(0), 1)}}, knot.rays.rays());
    const RayOcclusion rays(knot.rays.rays());
    Random random(8);
    std::size_t unknown = 0, wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        const vec3 p = 0.8f * random_direction(random);
        const LightPlace to = {vec4(p + 0.3f * random_direction(random), 1), vec2(0.5f)};
        if (knot.maps->at({p, to.place}) != Verdict::unknown)
            continue;
        ++unknown;
        std::uint8_t found = 0, wanted = 0;
        maps.look(p, {&to, 1}, &found);
        rays.look(p, {&to, 1}, &wanted);
        wrong += found != wanted;
    }
    EXPECT_GT(unknown, 200u);
    EXPECT_EQ(wrong, 0u);
}

} // namespace
} // namespace limn::test
