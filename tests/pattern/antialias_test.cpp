// Checklist 24, 26 and 27 of the procedural structures specification, and the filter that takes the place of samples.

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "limn/base/parallel.h"
#include "limn/base/random.h"
#include "limn/pattern/antialias.h"

namespace limn {
namespace {

using namespace formulas;

Camera camera_at(const dvec3& eye, int edge, bool orthographic = false)
{
    Camera camera;
    camera.eye = eye;
    camera.size = {edge, edge};
    camera.orthographic = orthographic;
    return camera;
}

TEST(Checklist24, SamplesWithoutOffsetAreTheSpotAndOthersProjectToTheirPixels)
{
    for (const bool orthographic : {false, true}) {
        const Camera camera = camera_at({1, 2, 5}, 500, orthographic);
        const PatternCamera pattern(camera, dvec3(0), 1, {});
        for (int i = 0; i < 2000; ++i) {
            Random random(16, std::uint64_t(i));
            const dvec3 place = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
            const vec2 pixel = vec2(camera.project(place).pixel);
            vec3 n = glm::normalize(vec3(dvec3(random.normal(), random.normal(), random.normal())));
            if (std::abs(glm::dot(n, pattern.to_eye(vec3(place)))) < 0.1f)
                continue;
            const PatternSpot spot = {vec3(place), n, n, pattern.to_eye(vec3(place))};
            EXPECT_LT(glm::length(dvec3(pattern.on_plane(spot, pixel, pixel)) - place), 1e-4 * 5);
            const vec2 other = pixel + vec2(float(random.uniform(-1, 1)), float(random.uniform(-1, 1)));
            const vec3 on = pattern.on_plane(spot, pixel, other);
            EXPECT_LT(glm::length(camera.project(dvec3(on)).pixel - dvec2(other)), 0.01);
            EXPECT_LT(std::abs(glm::dot(on - vec3(place), n)), 1e-5f * 6);
        }
    }
}

TEST(Checklist24, TheSeedsWayThroughThePipelineGivesTheSameDirections)
{
    const Camera camera = camera_at({0, 0, 5}, 500);
    const float cot = 1 / std::tan(0.5f * float(camera.fov_degrees) * 3.14159265f / 180), near = 0.1f, far = 100;
    glm::mat4 projection(0);
    projection[0][0] = cot;
    projection[1][1] = cot;
    projection[2][2] = (near + far) / (near - far);
    projection[3][2] = 2 * near * far / (near - far);
    projection[2][3] = -1;
    const PatternCamera pattern(camera, dvec3(0), 1, {});
    for (int i = 0; i < 500; ++i) {
        Random random(18, std::uint64_t(i));
        const vec3 place = {float(random.uniform(-1, 1)), float(random.uniform(-1, 1)), float(random.uniform(-1, 1))};
        const vec4 clip = projection * vec4(place - vec3(0, 0, 5), 1);
        const vec3 window = {250 * (clip.x / clip.w + 1), 250 * (clip.y / clip.w + 1), 0.5f * (clip.z / clip.w + 1)}; // y up
        const vec2 offset = {float(random.uniform(-1, 1)), float(random.uniform(-1, 1))};
        const vec3 seed = window_direction(glm::inverse(projection), window + vec3(offset.x, offset.y, 0), clip.w, vec2(500));
        const vec3 ours = glm::normalize(pattern.sight({window.x + offset.x, 500 - window.y - offset.y}));
        EXPECT_LT(glm::length(seed - ours), 1e-4f);
    }
}

TEST(Checklist24, TheSphereVariantLiesOnTheSphereAndKnowsItsFarSide)
{
    for (const bool orthographic : {false, true}) {
        const PatternCamera pattern(camera_at({0, 0, 5}, 200, orthographic), dvec3(0), 1, {});
        int met = 0;
        for (int y = 0; y < 200; y += 3)
            for (int x = 0; x < 200; x += 3) {
                vec3 near_place, far_place;
                const vec2 pixel = {float(x) + 0.5f, float(y) + 0.5f};
                if (!pattern.on_sphere({0.2f, 0, 0}, 0.8f, false, pixel, near_place))
                    continue;
                ASSERT_TRUE(pattern.on_sphere({0.2f, 0, 0}, 0.8f, true, pixel, far_place));
                EXPECT_NEAR(glm::length(near_place - vec3(0.2f, 0, 0)), 0.8f, 1e-5f);
                EXPECT_NEAR(glm::length(far_place - vec3(0.2f, 0, 0)), 0.8f, 1e-5f);
                EXPECT_GE(glm::dot(near_place - far_place, pattern.to_eye(near_place)), -1e-3f);
                ++met;
            }
        EXPECT_GT(met, 500);
    }
}

/// One of the three patterns on a plane or sphere, seen at a slant.
struct Case {
    const char* name;
    std::function<vec4(const PatternCamera&, const PatternSpot&, const vec2&, std::span<const vec2>)> sampled;
    std::function<vec4(const PatternPoint&, int, float)> at;
    bool sphere = false;
};

constexpr int edge = 28;

PatternLight light() { return {{glm::normalize(vec3(-0.4f, 0.8f, 0.7f)), vec3(2), 0.1f, {0, 1, 0}, vec3(0.3f), vec3(0.1f)}, {}, {}, {}}; }

/// @param period  of the pattern, in pixels at the middle of the picture
std::vector<Case> cases(double period)
{
    const float unit = float(period * 2.68 / edge); // the picture shows so much at the middle
    const BrickShader bricks = {{vec3(1.5f * unit, unit, unit), 0.12f * unit, 2, vec3(0.03f), vec3(0.5f, 0.2f, 0.1f), vec3(0.7f), 0, 0},
                                {FINISH_MATTE, vec3(1), 0, 1, 1, 1, 0},
                                light()};
    const float cell = 1 / std::round(6.2831853f / unit); // of the way around: whole cells
    const ThreadShader thread = {{0.6f * cell, 0.4f * cell, vec3(0.2f, 0.35f, 0.6f), 0.2f, 8, -1, 1, 0}, light(), vec3(0, 0, -1), 1};
    LayerShader seed = {{LAYERS_SEED, {0, 1, 0}, 0, 0.2f, 0.5f, 0, {1, 0, 0}, unit},
                        {FINISH_BLINN_PHONG, vec3(0.6f), 0.1f, 100, 0, 0, 0},
                        light(),
                        LayerStack(double(unit), -20)};
    LayerShader slope = seed, bead = seed;
    slope.pattern.model = LAYERS_SLOPE;
    bead.pattern.model = LAYERS_BEAD;
    bead.finish = {FINISH_GGX, vec3(0.6f), 0, 1, 0.25f, 0.35f, 0.04f};
    const auto plane = [](const char* name, const auto& shader) {
        return Case{name,
                    [shader](const PatternCamera& c, const PatternSpot& s, const vec2& p, std::span<const vec2> samples) {
                        return supersample(shader, c, s, p, samples);
                    },
                    [shader](const PatternPoint& p, int kernel, float width) { return shader.at(p, kernel, width); }};
    };
    return {plane("bricks", bricks),
            plane("layers, seed", seed),
            plane("layers, slope", slope),
            plane("layers, bead", bead),
            {"thread",
             [thread](const PatternCamera& c, const PatternSpot&, const vec2& p, std::span<const vec2> samples) {
                 return supersample_sphere(thread, c, false, p, samples);
             },
             [thread](const PatternPoint& p, int kernel, float width) { return thread.at(p, kernel, width); }, true}};
}

struct Spots {
    PatternCamera camera = PatternCamera(camera_at({0, 0, 5}, edge), dvec3(0), 1, {});
    /// The spot of a pixel of a tilted plane, or of a sphere that fills the picture.
    PatternSpot at(const vec2& pixel, bool sphere) const
    {
        if (sphere) {
            vec3 place;
            EXPECT_TRUE(camera.on_sphere({0, 0, -1}, 1, false, 0.25f * (pixel - 0.5f * edge) + 0.5f * edge, place));
            const vec3 n = place - vec3(0, 0, -1);
            return {place, n, n, camera.to_eye(place)};
        }
        const vec3 n = glm::normalize(vec3(0.3f, 0.4f, 1));
        const PatternSpot middle = {vec3(0), n, n, {0, 0, 1}};
        const vec3 place = camera.on_plane(middle, vec2(0.5f * edge), pixel);
        return {place, n, n, camera.to_eye(place)};
    }
};

double luminance(const vec4& c) { return double(0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z); }

using PixelValue = std::function<vec4(const PatternSpot&, const vec2&)>;

std::vector<double> picture(const Spots& spots, bool sphere, const PixelValue& value)
{
    std::vector<double> image(edge * edge);
    parallel_each(edge * edge, 16, [&](std::size_t i) {
        const vec2 pixel = {float(i % edge) + 0.5f, float(i / edge) + 0.5f};
        // Spheres are looked at in their middle quarter, away from outline and poles.
        const vec2 place = sphere ? 0.25f * (pixel - 0.5f * edge) + 0.5f * edge : pixel;
        image[i] = luminance(value(spots.at(pixel, sphere), place));
    });
    return image;
}

double rmse(const std::vector<double>& a, const std::vector<double>& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / double(a.size()));
}

double mean(const std::vector<double>& a)
{
    double sum = 0;
    for (const double v : a)
        sum += v / double(a.size());
    return sum;
}

TEST(Checklist26, MoreSamplesOfTheSeedComeNearerToTheReference)
{
    const Spots spots;
    const std::vector<vec2> many = stratified_samples(32, KERNEL_BOX, 2, 1);
    for (const Case& c : cases(6)) {
        const auto sampled = [&](std::span<const vec2> samples) {
            return picture(spots, c.sphere, [&](const PatternSpot& s, const vec2& p) { return c.sampled(spots.camera, s, p, samples); });
        };
        const std::vector<double> reference = sampled(many);
        double last = 1e30;
        for (const int count : {1, 10, 32, 50}) {
            const std::vector<double> image = sampled(seed_samples(count, 2, 1));
            const double error = rmse(image, reference);
            EXPECT_LT(error, last * (count == 50 ? 1.05 : 1.0)) << c.name << " with " << count;
            last = error;
            if (count == 50) {
                EXPECT_NEAR(mean(image) / mean(reference), 1, 0.01) << c.name;
            }
            for (const double v : image)
                EXPECT_TRUE(std::isfinite(v));
        }
    }
}

TEST(Filter, IsNearerToTheReferenceOfItsOwnKernelThanFiftySamples)
{
    const Spots spots;
    const std::vector<vec2> gauss = stratified_samples(32, KERNEL_GAUSS, 0.5f, 2), box = stratified_samples(32, KERNEL_BOX, 2, 3),
                            seed = seed_samples(50, 2, 1);
    for (const double period : {10.0, 2.2, 0.4}) // pixels
        for (const Case& c : cases(period)) {
            const auto sampled = [&](std::span<const vec2> samples) {
                return picture(spots, c.sphere,
                               [&](const PatternSpot& s, const vec2& p) { return c.sampled(spots.camera, s, p, samples); });
            };
            const auto filtered = [&](int kernel, float width) {
                return picture(spots, c.sphere, [&](const PatternSpot& s, const vec2& p) {
                    if (!c.sphere)
                        return c.at(spots.camera.point(s), kernel, width);
                    vec3 place;
                    EXPECT_TRUE(spots.camera.on_sphere({0, 0, -1}, 1, false, p, place));
                    const vec3 n = place - vec3(0, 0, -1);
                    return c.at(spots.camera.point({place, n, n, spots.camera.to_eye(place)}), kernel, width);
                });
            };
            const std::vector<double> reference = sampled(gauss), wide = sampled(box);
            const double ours = rmse(filtered(KERNEL_GAUSS, 0.5f), reference), ours_box = rmse(filtered(KERNEL_BOX, 2), wide),
                         theirs = rmse(sampled(seed), wide);
            EXPECT_LT(ours, theirs) << c.name << ", period " << period;
            EXPECT_LT(ours_box, theirs) << c.name << ", period " << period;
            EXPECT_LT(ours, c.sphere ? 0.016 : 0.01) << c.name << ", period " << period;
        }
}

TEST(Filter, AlmostNoKernelGivesTheHardPatternAndAVeryWideOneItsMean)
{
    const Spots spots;
    for (const Case& c : cases(10)) {
        int differ = 0;
        for (int i = 0; i < 400; ++i) {
            Random random(20, std::uint64_t(i));
            const PatternPoint p = spots.camera.point(spots.at({float(random.uniform(0, edge)), float(random.uniform(0, edge))}, c.sphere));
            differ += std::abs(luminance(c.at(p, KERNEL_GAUSS, 1e-3f)) - luminance(c.at(p, KERNEL_NONE, 0))) > 0.01;
        }
        EXPECT_LE(differ, 8) << c.name; // on an edge
        const PatternPoint here = spots.camera.point(spots.at({18, 21}, c.sphere)),
                           there = spots.camera.point(spots.at({22.7f, 19.1f}, c.sphere));
        PatternPoint moved = here;
        moved.position = there.position;
        const vec4 a = c.at(here, KERNEL_GAUSS, 60), b = c.at(moved, KERNEL_GAUSS, 60);
        EXPECT_NEAR(a.w, c.sphere ? 0.64f : 1.0f, 0.002f) << c.name;
        EXPECT_NEAR(b.w, a.w, 0.002f) << c.name;
        if (!c.sphere) { // thread shines differently from place to place
            EXPECT_NEAR(luminance(a), luminance(b), 0.02 * luminance(a)) << c.name;
        }
    }
}

/// How much a pattern varies from place to place within a few periods, under a kernel: in luminance, on spheres, whose light
/// varies too, in how much of them it covers.
double contrast(const Spots& spots, const Case& c, double period, int kernel, float width)
{
    const PatternPoint middle = spots.camera.point(spots.at({18, 25}, c.sphere)); // seen from above a little
    const vec3 centre = {0, 0, -1};
    std::vector<double> values(600);
    for (std::size_t i = 0; i < values.size(); ++i) {
        Random random(21, i);
        const float right = float(random.uniform(-1.5 * period, 1.5 * period)), down = float(random.uniform(-1.5 * period, 1.5 * period));
        PatternPoint p = middle;
        p.position += right * middle.right + down * middle.down;
        if (c.sphere) {
            p.normal = glm::normalize(p.position - centre);
            p.position = centre + p.normal;
        }
        const vec4 seen = c.at(p, kernel, width);
        values[i] = c.sphere ? double(seen.w) : luminance(seen);
    }
    return rmse(values, std::vector<double>(values.size(), mean(values)));
}

// A Gauss kernel lets less of each wave through the wider it is; of a square some waves come back.
TEST(Filter, LosesContrastFromTheHardPatternToItsMeanAsTheKernelGrows)
{
    const Spots spots;
    const double period = 10;
    for (const Case& c : cases(period)) {
        const double hard = contrast(spots, c, period, KERNEL_NONE, 0);
        double last = hard;
        EXPECT_NEAR(contrast(spots, c, period, KERNEL_GAUSS, 0.02f), hard, 0.05 * hard) << c.name;
        for (float width = 0.05f; width < 30; width *= 1.3f) {
            const double now = contrast(spots, c, period, KERNEL_GAUSS, width);
            EXPECT_LT(now, last + 0.005 * hard) << c.name << ", width " << width;
            last = now;
        }
        EXPECT_LT(last, 0.05 * hard) << c.name;
        EXPECT_LT(contrast(spots, c, period, KERNEL_BOX, 100), 0.05 * hard) << c.name;
    }
}

/// RMS of what is left of black and white stripes around their mean, over all phases.
double residue(double cycles, float side, std::span<const vec2> samples)
{
    double sum = 0;
    const int n = 2000;
    for (int i = 0; i < n; ++i) {
        double value = 0;
        for (const vec2& s : samples) {
            const double at = double(i) / n + cycles * double(s.y * side);
            value += (at - std::floor(at) < 0.5 ? 1.0 : 0.0) / double(samples.size());
        }
        sum += (value - 0.5) * (value - 0.5) / n;
    }
    return std::sqrt(sum);
}

TEST(Checklist27, WhatTheSeedLeavesOfStripesIsThatOfTheSpecification)
{
    const std::vector<vec2> unit = seed_samples(50, 1, 1);
    const double expected[4][3] = {{0.45, 0.326, 0.095}, {0.55, 0.273, 0.057}, {0.9, 0.095, 0.044}, {2.3, 0.106, 0.129}};
    for (const auto& [cycles, small, large] : expected) {
        EXPECT_NEAR(residue(cycles, 1, unit) / small, 1, 0.2) << cycles;
        EXPECT_NEAR(residue(cycles, 2, unit) / large, 1, 0.2) << cycles;
    }
    EXPECT_LT(residue(0.55, 2, unit), residue(0.55, 1, unit)) << "less moiré with 2 x 2";
}

TEST(Checklist27, TheFilterLeavesLessThanSamplesDo)
{
    const std::vector<vec2> unit = seed_samples(50, 1, 1);
    for (const double cycles : {0.9, 1.3, 2.3, 3.9}) {
        const Blur blur = blur_along(KERNEL_GAUSS, 0.5f, vec2(float(cycles), 0));
        double sum = 0;
        for (int i = 0; i < 200; ++i) {
            const double d = double(blurred_pulse(float(i) / 200, 0, 0.5f, blur)) - 0.5;
            sum += d * d / 200;
        }
        EXPECT_LT(std::sqrt(sum), 0.35 * residue(cycles, 2, unit)) << cycles;
    }
}

TEST(Samples, OfKernelsHaveTheirMomentsAndStayInside)
{
    for (const int kernel : {KERNEL_BOX, KERNEL_GAUSS})
        for (const std::vector<vec2>& samples :
             {even_samples(1024, kernel, 0.5f, vec2(0.3f, 0.7f)), stratified_samples(32, kernel, 0.5f, 5)}) {
            dvec2 middle(0), square(0);
            for (const vec2& s : samples) {
                middle += dvec2(s) / 1024.0;
                square += dvec2(s) * dvec2(s) / 1024.0;
            }
            EXPECT_LT(glm::length(middle), 0.01);
            const double variance = kernel == KERNEL_BOX ? 0.25 / 12 : 0.25;
            EXPECT_NEAR(square.x, variance, 0.03 * variance + 0.002);
            EXPECT_NEAR(square.y, variance, 0.03 * variance + 0.002);
        }
}

} // namespace
} // namespace limn
