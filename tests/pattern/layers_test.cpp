// Checklist 19 to 22 of the procedural structures specification: layers of a print, held against rays that meet real steps.

#include <cmath>
#include <complex>
#include <numbers>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/base/random.h"
#include "limn/pattern/pattern_shader.h"

namespace limn {
namespace {

using namespace formulas;

LayerPattern layers(int model, const vec3& up = {0, 1, 0}) { return {model, up, 0, 0.2f, 0.5f, 0, {1, 0, 0}, 0.02f}; }
Finish plastic() { return {FINISH_BLINN_PHONG, vec3(0.6f), 0.1f, 100, 0.3f, 0.4f, 0.04f}; }
PatternLight light(const vec3& to) { return {{glm::normalize(to), vec3(2), 0, {0, 1, 0}, vec3(0.1f), vec3(0.05f)}, {}, {}, {}}; }

vec3 direction(Random& random) { return glm::normalize(vec3(dvec3(random.normal(), random.normal(), random.normal()))); }

TEST(Checklist19, TheLiteralShareOfTreadsIsThatOfTheLineOfSight)
{
    const float l = 0.02f;
    for (const float sight : {-0.9f, -0.5f, -0.1f, 0.1f, 0.3f, 0.5f, 0.9f}) {
        int treads = 0;
        const int n = 20000;
        for (int i = 0; i < n; ++i) {
            const float at = 50 * (float(i) + 0.5f) / n;
            treads += seed_tread(layers(LAYERS_SEED), {at, l, vec2(0)}, sight) > 0.5f;
        }
        EXPECT_NEAR(double(treads) / n, double(std::abs(sight)), 0.01);
    }
}

TEST(Checklist19, TheNextLayerPlaneIsThatOfTheLineOfSight)
{
    // l - t, where t is the way to the plane below or above.
    EXPECT_NEAR(seed_gap(3.25f, 0.02f, -0.5f), 0.02f - 0.25f * 0.02f / 0.5f, 1e-6f);
    EXPECT_NEAR(seed_gap(3.25f, 0.02f, 0.5f), 0.02f - 0.75f * 0.02f / 0.5f, 1e-6f);
}

TEST(Checklist19, NothingIsNotANumber)
{
    for (int i = 0; i < 20000; ++i) {
        Random random(10, std::uint64_t(i));
        vec3 n = direction(random), w = direction(random);
        if (i % 7 == 0)
            n = {1, 0, 0};
        if (i % 11 == 0)
            n = {0, i % 2 == 0 ? 1.0f : -1.0f, 0};
        if (i % 5 == 0)
            w = glm::normalize(vec3(w.x, 0, w.z));
        if (i % 13 == 0)
            w = {0, i % 3 == 0 ? 1.0f : -1.0f, 0};
        const PatternPoint p = {vec3(0), n, -w, vec3(0.01f, 0, 0), vec3(0, 0.01f, 0)};
        for (const int model : {LAYERS_SEED, LAYERS_SOFT, LAYERS_SLOPE, LAYERS_BEAD, LAYERS_VOXEL})
            for (const int kernel : {KERNEL_NONE, KERNEL_GAUSS, KERNEL_BOX}) {
                const vec3 c = layers_through(layers(model), plastic(), p,
                                              {float(random.uniform(-9, 9)), 0.02f, vec2(0.3f, i % 17 == 0 ? 1e30f : 0.1f)}, kernel, 1,
                                              light({1, 1, 1}).lighting);
                EXPECT_TRUE(std::isfinite(c.x + c.y + c.z)) << model << " " << kernel;
            }
    }
    EXPECT_EQ(seed_layer_normal({1, 0, 0}, {0, 1, 0}, 1), vec3(1, 0, 0));
    EXPECT_EQ(seed_layer_normal({0, 1, 0}, {0, 1, 0}, 0), vec3(0, 1, 0));
}

/// Steps on a slope x = -y cot in the plane of the line of sight, layer j between heights j and j + 1, its edge where the slope is at mid-layer.
struct Steps {
    double cot;
    double bulge; ///< 0: flat risers
    double edge(int j) const { return -(j + 0.5) * cot; }
};

struct Met {
    bool tread = false;
    dvec2 normal = dvec2(0); ///< out and up
    dvec2 place = dvec2(0);
    bool any = false;
};

/// What a line of sight through a place meets first: from far outside, or from `start` of it on. Directions are out and up.
Met meet(const Steps& steps, const dvec2& place, const dvec2& sight, double start = -1e30)
{
    double first = 1e30;
    Met met;
    const int middle = int(std::floor(place.y));
    const auto is_first = [&](double t) { return t > start && t < first; };
    for (int j = middle - 40; j <= middle + 40; ++j) {
        const double half = steps.bulge * 0.5, centre = steps.edge(j) - half, next = steps.edge(j + 1) - half;
        if (sight.y != 0) { // the tread on layer j
            const double t = (j + 1 - place.y) / sight.y, x = place.x + t * sight.x;
            if (x <= std::max(centre, next) && x >= std::min(centre, next) && is_first(t))
                first = t, met = {true, {0, next <= centre ? 1 : -1}, {x, j + 1}};
        }
        if (half == 0) {
            const double t = (centre - place.x) / sight.x, y = place.y + t * sight.y;
            if (y >= j && y <= j + 1 && is_first(t))
                first = t, met = {false, {1, 0}, {centre, y}};
            continue;
        }
        const dvec2 scale = {1 / half, 2}, from = (place - dvec2(centre, j + 0.5)) * scale, along = sight * scale;
        const double a = glm::dot(along, along), b = glm::dot(from, along), d = b * b - a * (glm::dot(from, from) - 1);
        if (d < 0)
            continue;
        const double t = (-b - std::sqrt(d)) / a;
        const dvec2 at = from + t * along;
        if (at.x >= 0 && is_first(t))
            first = t, met = {false, glm::normalize(at * scale), place + t * sight};
    }
    met.any = first < 1e30;
    return met;
}

struct Look {
    double cot, at;
    dvec2 normal, sight; ///< of the slope; of the eye's ray
};

/// A random slope, view and place; the eye is in the plane of slope and print direction. @param widest  angle of the eye from level, degrees: beyond 90 it is behind the steps
Look look(std::uint64_t i, double widest = 85)
{
    Random random(12, i);
    Look l;
    const double tilt = random.uniform(-80, 80) * std::numbers::pi / 180;
    l.normal = {std::cos(tilt), std::sin(tilt)};
    l.cot = std::tan(tilt);
    do {
        const double angle = random.uniform(-widest, widest) * std::numbers::pi / 180;
        l.sight = {-std::cos(angle), -std::sin(angle)};
    } while (glm::dot(l.normal, l.sight) > -0.05);
    l.at = random.uniform(-3, 3);
    return l;
}

TEST(Checklist20, TheSlopeModelSeesWhatRaysSeeOfRealSteps)
{
    int checked = 0, wrong = 0;
    for (std::uint64_t i = 0; i < 20000; ++i) {
        const Look l = look(i);
        const float share = tread_share(float(l.normal.y), float(-l.sight.y), float(-glm::dot(l.normal, l.sight)));
        const double off = std::abs(std::abs(l.at - std::round(l.at)) - 0.5 * double(share));
        if (off < 0.002)
            continue;
        ++checked;
        wrong += (slope_tread(float(l.at), share) > 0.5f) != meet({l.cot, 0}, {-l.at * l.cot, l.at}, l.sight).tread;
    }
    EXPECT_GT(checked, 19000);
    EXPECT_LE(wrong, checked / 1000);
}

TEST(Checklist20, AVerticalWallShowsNoTreads)
{
    EXPECT_EQ(tread_share(0, 0.5f, 0.866f), 0.0f);
    EXPECT_EQ(tread_share(-0.3f, 0.5f, 0.4f), 0.0f) << "nor does an overhang from above";
}

TEST(Beads, AreWhatRaysSeeOfRoundedStepsFromBeforeAndBehind)
{
    int checked = 0, wrong = 0, behind = 0;
    for (std::uint64_t i = 0; i < 20000; ++i) {
        const Look l = look(i, 170);
        const float bulge = 0.2f + 0.8f * float(i % 5) / 4;
        const BeadView view = bead_view(bulge, float(l.normal.x), float(l.normal.y), float(-l.sight.x), float(-l.sight.y));
        const Met met = meet({l.cot, double(bulge)}, {-l.at * l.cot, l.at}, l.sight);
        const float phase = bead_phase(view, float(l.at)), turns = phase - std::floor(phase), across = view.from + turns * view.period;
        if (std::min({turns, 1 - turns, std::abs(across - view.to) / view.period}) < 0.003f)
            continue;
        ++checked;
        behind += l.sight.x > 0;
        dvec2 n = {0, double(view.turned)};
        if (across < view.to) {
            const vec2 bent = bead_normal(bulge, bead_point(view, across));
            n = {double(bent.x), double(view.turned * bent.y)};
        }
        wrong += met.tread != (across > view.to) || glm::length(n - met.normal) > 0.02;
    }
    EXPECT_GT(checked, 18000);
    EXPECT_GT(behind, 2000);
    EXPECT_LE(wrong, checked / 500);
}

/// A stack under one light, sky and floor, as its pixels see it on average.
struct Groove {
    double tilt, bulge;    ///< of the slope, radians from upright; of its edges
    vec3 to_eye, to_light; ///< out, along the beads, up
    vec3 sky = vec3(1), light = vec3(1);
};

Groove groove(std::uint64_t i)
{
    Random random(31, i);
    Groove g;
    g.tilt = random.uniform(-1.2, 1.2);
    g.bulge = i % 3 == 0 ? 0 : i % 3 == 1 ? 1 : 0.5;
    const vec3 n = {float(std::cos(g.tilt)), 0, float(std::sin(g.tilt))};
    do
        g.to_eye = direction(random);
    while (glm::dot(g.to_eye, n) < 0.2f);
    do
        g.to_light = direction(random);
    while (glm::dot(g.to_light, n) < 0.1f);
    return g;
}

Illumination illumination(const Groove& g) { return {g.to_light, g.light, 0, {0, 0, 1}, g.sky, 0.3f * g.sky}; }

Finish matte() { return {FINISH_MATTE, vec3(1), 0, 1, 1, 1, 0}; }

/// The model's mean over many layers.
double modelled(const Groove& g)
{
    const LayerPattern s = {g.bulge > 0 ? LAYERS_BEAD : LAYERS_SLOPE, {0, 0, 1}, 0, 1, float(g.bulge), 0, {1, 0, 0}, 1};
    const PatternPoint p = {vec3(0), {float(std::cos(g.tilt)), 0, float(std::sin(g.tilt))}, g.to_eye, vec3(0), vec3(0)};
    return double(layers_through(s, matte(), p, {0, 1, vec2(20, 20)}, KERNEL_GAUSS, 0.5f, illumination(g)).x);
}

/// The same by rays: lines of sight in even steps, each with a line to the light and some to sky and floor.
double traced(const Groove& g)
{
    const Steps steps = {std::tan(g.tilt), g.bulge};
    const Illumination lit = illumination(g);
    const auto is_open = [&](const dvec2& from, const vec3& way) {
        const dvec2 flat = {double(way.x), double(way.z)};
        return glm::length(flat) < 1e-4 || !meet(steps, from, glm::normalize(flat), 1e-6).any;
    };
    constexpr int sights = 48, rings = 6, spokes = 24;
    double sum = 0;
    for (int k = 0; k < sights; ++k) {
        const double at = (k + 0.5) / sights;
        const Met met = meet(steps, {-at * steps.cot, at}, -glm::normalize(dvec2(double(g.to_eye.x), double(g.to_eye.z))));
        const vec3 n = {float(met.normal.x), 0, float(met.normal.y)}, aside = {-n.z, 0, n.x};
        vec3 light(0);
        if (is_open(met.place, g.to_light))
            light += lit.light * facing(n, g.to_light) / std::numbers::pi_v<float>;
        for (int i = 0; i < rings; ++i)
            for (int j = 0; j < spokes; ++j) { // as often as the cosine is high
                const float radius = std::sqrt((float(i) + 0.5f) / rings),
                            turn = 2 * std::numbers::pi_v<float> * (float(j) + 0.5f) / spokes;
                const vec3 way =
                    radius * std::cos(turn) * aside + radius * std::sin(turn) * vec3(0, 1, 0) + std::sqrt(1 - radius * radius) * n;
                if (is_open(met.place, way))
                    light += radiance_around(lit, way) / float(rings * spokes);
            }
        sum += double(light.x) / sights;
    }
    return sum;
}

// The mean radiance of prints whose layers are finer than pixels, with what edges hide from each other.
TEST(Grooves, HideAsMuchLightAsRaysFindHidden)
{
    double hidden = 0;
    for (std::uint64_t i = 0; i < 90; ++i) {
        Groove g = groove(i);
        g.light = vec3(3), g.sky = vec3(0);
        const double wanted = traced(g),
                     open = double(facing({float(std::cos(g.tilt)), 0, float(std::sin(g.tilt))}, g.to_light)) * 3 / std::numbers::pi;
        EXPECT_NEAR(modelled(g), wanted, 0.03 + 0.05 * wanted)
            << i << " tilt " << g.tilt << " bulge " << g.bulge << " light " << g.to_light.x << " " << g.to_light.z;
        hidden += std::max(0.0, open - wanted);
    }
    EXPECT_GT(hidden, 1) << "some of them have shadows";
}

TEST(Grooves, SeeAsMuchOfTheSkyAsRaysDo)
{
    double least = 1;
    for (std::uint64_t i = 0; i < 90; ++i) {
        Groove g = groove(i);
        g.light = vec3(0);
        const double wanted = traced(g);
        EXPECT_NEAR(modelled(g), wanted, 0.02 + 0.02 * wanted)
            << i << " tilt " << g.tilt << " bulge " << g.bulge << " eye " << g.to_eye.x << " " << g.to_eye.z;
        least = std::min(least, wanted);
    }
    EXPECT_LT(least, 0.4);
}

TEST(Grooves, OfNoDepthSeeTheLightOfTheirSurface)
{
    Random random(33);
    for (int i = 0; i < 1000; ++i) {
        const vec3 n = direction(random), aside = glm::normalize(glm::cross(n, direction(random)));
        const Illumination lit = {{0, 0, 1}, vec3(0), 0, direction(random), vec3(1, 2, 3), vec3(0.5f)};
        EXPECT_LT(glm::length(ambient_between(lit, n, aside, {-1, 1}) - ambient_around(lit, n)), 1e-5f);
        EXPECT_LT(glm::length(ambient_between(lit, n, aside, {0.4f, 0.4f})), 1e-5f);
    }
}

TEST(Ambient, IsTheMeanOfSkyAndFloor)
{
    for (int i = 0; i < 20; ++i) {
        Random random(34, std::uint64_t(i));
        const Illumination lit = {{0, 0, 1}, vec3(0), 0, {0, 1, 0}, vec3(0.4f, 0.5f, 0.6f), vec3(0.1f)};
        const vec3 n = direction(random), a = glm::normalize(glm::cross(n, std::abs(n.x) < 0.9f ? vec3(1, 0, 0) : vec3(0, 1, 0))),
                   b = glm::cross(n, a);
        vec3 sum(0);
        const int rings = 40, spokes = 80;
        for (int r = 0; r < rings; ++r)
            for (int k = 0; k < spokes; ++k) {
                const float radius = std::sqrt((float(r) + 0.5f) / rings),
                            turn = 2 * std::numbers::pi_v<float> * (float(k) + 0.5f) / spokes;
                sum += radiance_around(lit, radius * (std::cos(turn) * a + std::sin(turn) * b) + std::sqrt(1 - radius * radius) * n) /
                       float(rings * spokes);
            }
        EXPECT_LT(glm::length(ambient_around(lit, n) - sum), 2e-3f);
    }
}

TEST(Beads, GoOverIntoFlatStepsAsTheyGetFlatter)
{
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const Look l = look(i);
        const BeadView view = bead_view(1e-3f, float(l.normal.x), float(l.normal.y), float(-l.sight.x), float(-l.sight.y));
        EXPECT_NEAR(1 - (view.to - view.from) / view.period,
                    tread_share(float(l.normal.y), float(-l.sight.y), float(-glm::dot(l.normal, l.sight))), 0.02f);
    }
}

TEST(Checklist21, TheSoftStepsReachTheHeightOfTheSpecification)
{
    const double expected[5][2] = {{0.008, 0.0047}, {0.02, 0.028}, {0.032, 0.069}, {0.048, 0.145}, {0.064, 0.242}};
    for (const auto& [l, amplitude] : expected) {
        float most = 0;
        for (float at = 0; at < 1; at += 0.001f)
            most = std::max(most, seed_tread(layers(LAYERS_SOFT), {at, float(l), vec2(0)}, -0.7f));
        EXPECT_NEAR(double(most), amplitude, 0.0012);
    }
}

// Two axes: a voxel look.
TEST(Checklist21, BlocksAreTreadsAndRisersOfBothAxes)
{
    const vec3 n = glm::normalize(vec3(0.5f, 0.6f, 0.62f)), to_eye = glm::normalize(vec3(0.4f, 0.3f, 1));
    const LayerPattern blocks = layers(LAYERS_VOXEL);
    int both = 0, up = 0, side = 0, none = 0, wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        Random random(24, std::uint64_t(i));
        const PatternPoint p = {{float(random.uniform(-1, 1)), float(random.uniform(-1, 1)), 0}, n, to_eye, vec3(0), vec3(0)};
        const LayerPlace place = {p.position.y / 0.02f, 0.02f, vec2(0)};
        const bool tread = seed_tread(layers(LAYERS_SEED), place, -to_eye.y) > 0.5f;
        const bool beside = seed_tread(layers(LAYERS_SEED), {p.position.x / 0.02f, 0.02f, vec2(0)}, -to_eye.x) > 0.5f;
        (tread ? (beside ? both : up) : (beside ? side : none)) += 1;
        const vec3 bent = block_normal(n, {0, 1, 0}, {1, 0, 0}, tread, beside);
        wrong += (std::abs(bent.y) > 1e-6f) != tread || (std::abs(bent.x) > 1e-6f) != beside;
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_NEAR(both / 20000.0, double(to_eye.x * to_eye.y), 0.012);
    EXPECT_NEAR(up / 20000.0, double(to_eye.y * (1 - to_eye.x)), 0.012);
    EXPECT_NEAR(side / 20000.0, double(to_eye.x * (1 - to_eye.y)), 0.012);
    EXPECT_GT(none, 0);
    // A pixel that sees many blocks sees their mean, in which the axes are alike.
    const PatternPoint wide = {vec3(0), n, to_eye, vec3(1, 0.3f, 0), vec3(0.2f, 1, 0)};
    const vec3 seen = layers_through(blocks, plastic(), wide, {0, 0.02f, change_per_pixel(wide, {0, 1, 0}) / 0.02f}, KERNEL_GAUSS, 0.5f,
                                     light({1, 1, 1}).lighting);
    vec3 mean(0);
    for (int i = 0; i < 20000; ++i) {
        Random random(25, std::uint64_t(i));
        const PatternPoint p = {{float(random.uniform(-1, 1)), float(random.uniform(-1, 1)), 0}, n, to_eye, vec3(0), vec3(0)};
        mean += layers_through(blocks, plastic(), p, {p.position.y / 0.02f, 0.02f, vec2(0)}, KERNEL_NONE, 0, light({1, 1, 1}).lighting) /
                20000.0f;
    }
    EXPECT_NEAR(seen.x, mean.x, 0.02f * mean.x);
}

TEST(Checklist21, LayersAlongAnotherAxisAreTheTurnedLayers)
{
    for (int i = 0; i < 2000; ++i) {
        Random random(14, std::uint64_t(i));
        const vec3 n = direction(random), to_eye = glm::dot(n, direction(random)) < 0 ? n : glm::normalize(n + 0.5f * direction(random));
        const auto turn = [](const vec3& v) { return vec3(v.y, -v.x, v.z); }; // y becomes x
        const LayerPlace place = {float(random.uniform(0, 5)), 0.02f, vec2(0.2f, 0.3f)};
        PatternLight lit = light({1, 2, 1}), turned = lit;
        turned.lighting.to_light = turn(lit.lighting.to_light);
        turned.lighting.up = turn(lit.lighting.up);
        for (const int model : {LAYERS_SEED, LAYERS_SOFT, LAYERS_SLOPE, LAYERS_BEAD}) {
            const vec3 a =
                layers_through(layers(model), plastic(), {vec3(0), n, to_eye, vec3(0), vec3(0)}, place, KERNEL_GAUSS, 0.5f, lit.lighting);
            const vec3 b = layers_through(layers(model, {1, 0, 0}), plastic(), {vec3(0), turn(n), turn(to_eye), vec3(0), vec3(0)}, place,
                                          KERNEL_GAUSS, 0.5f, turned.lighting);
            EXPECT_LT(glm::length(a - b), 1e-3f);
        }
    }
}

TEST(Checklist21, RunningOverTwoAxesGivesCubes)
{
    // Normals of voxels: after both axes each is a tread of one of them, or a corner where both are.
    const vec3 n = glm::normalize(vec3(0.5f, 0.6f, 0.2f));
    const vec3 both = seed_layer_normal(seed_layer_normal(n, {0, 1, 0}, 1), {1, 0, 0}, 0);
    EXPECT_NEAR(both.x, 0, 1e-6f);
    EXPECT_GT(both.y, 0.9f);
}

/// The strongest frequency of a wall's brightness from its foot to its top, periods over the wall, by refining the spectrum's peak.
double bands(double layer_height)
{
    const int n = 4096;
    std::vector<double> values(n);
    const LayerShader shader = {layers(LAYERS_BEAD), plastic(), light({0.3f, 1, 1}), LayerStack(layer_height)};
    double mean = 0;
    for (int i = 0; i < n; ++i) {
        const float y = 2 * (float(i) + 0.5f) / float(n);
        values[std::size_t(i)] =
            double(shader
                       .at({{0, y, 0}, {0, 0, 1}, glm::normalize(vec3(0, 0.5f, 1)), vec3(2.0f / n, 0, 0), vec3(0, -2.0f / n, 0)},
                           KERNEL_GAUSS, 0.5f)
                       .x);
        mean += values[std::size_t(i)] / n;
    }
    double best = 0, at = 0;
    for (double f = 3; f < 300; f += 0.25) {
        std::complex<double> sum = 0;
        for (int i = 0; i < n; ++i)
            sum += (values[std::size_t(i)] - mean) * std::polar(1.0, -2 * std::numbers::pi * f * i / n);
        if (std::abs(sum) > best)
            best = std::abs(sum), at = f;
    }
    return at;
}

TEST(Checklist22, HalfTheHeightGivesTwiceTheBands)
{
    const double thick = bands(0.04), thin = bands(0.02);
    EXPECT_NEAR(thick, 50, 1);
    EXPECT_NEAR(thin / thick, 2, 0.04);
}

TEST(LayerStack, CountsFromTheBottomWithAFirstLayerOfItsOwn)
{
    const LayerStack stack(0.2, 1, 0.3);
    EXPECT_NEAR(stack.layers_below(1), 0, 1e-6);
    EXPECT_NEAR(stack.layers_below(1.15), 0.5, 1e-5);
    EXPECT_NEAR(stack.layers_below(1.3), 1, 1e-5);
    EXPECT_NEAR(stack.layers_below(1.7), 3, 1e-5);
    const LayerPlace place = stack.scaled(10, 5).place(15.0f + 1.5f, vec2(0.001f, 0), 0.5f);
    EXPECT_NEAR(place.at, 0.5f, 1e-4f);
    EXPECT_NEAR(place.height, 3, 1e-4f);
    EXPECT_THROW(LayerStack(0), Error::Input);
    EXPECT_THROW(LayerStack(0.2, 0, -1), Error::Input);
    EXPECT_THROW(LayerStack(std::vector<double>{0.2, 0}, 0), Error::Input);
}

TEST(LayerStack, ATableOfHeightsIsFollowedAndSmearedAsItIsOnAverage)
{
    const LayerStack stack({0.3, 0.1, 0.1, 0.1, 0.2}, 0);
    EXPECT_NEAR(stack.layers_below(0.35), 1.5, 1e-5);
    EXPECT_NEAR(stack.layers_below(0.7), 4.5, 1e-5);
    EXPECT_NEAR(stack.layers_below(1.0), 6, 1e-5) << "the last height goes on";
    EXPECT_NEAR(stack.place(0.45f, vec2(0.001f, 0), 0.5f).change.x, 0.01f, 1e-5f);
    EXPECT_NEAR(stack.place(0.4f, vec2(0.4f, 0), 0.5f).change.x, 10.0f / 3, 1e-3f);
}

TEST(LayerHeights, AreReadFromEitherTableAndMistakesAreNamed)
{
    EXPECT_EQ(layer_heights_from_text("# mine\n0.3\n0.2 # thin\n\n0.1\r\n", "t.txt"), (std::vector<double>{0.3, 0.2, 0.1}));
    EXPECT_EQ(layer_heights_from_text("0 0.5\n1 0.25\n1.5 0.1\n", "t.txt"), (std::vector<double>{0.5, 0.5, 0.25, 0.25, 0.1}));
    const auto message = [](const char* text) {
        try {
            layer_heights_from_text(text, "t.txt");
        } catch (const Error::Read& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(message("0.2\nthick\n"), "t.txt, line 2: 'thick' is not a number");
    EXPECT_EQ(message("0.2\n0\n"), "t.txt, line 2: a layer height of 0 mm is not above 0 and below 1000");
    EXPECT_EQ(message("0 0.2\n0 0.1\n"), "t.txt, line 2: Z 0 does not follow the one before");
    EXPECT_EQ(message("0 0.2\n0.1\n"), "t.txt, line 2: 1 numbers, where the lines before have 2");
    EXPECT_EQ(message("1 2 3\n"), "t.txt, line 1: more than a height, or a Z and a height");
    EXPECT_EQ(message("# nothing\n"), "t.txt: no layer heights");
}

} // namespace
} // namespace limn
