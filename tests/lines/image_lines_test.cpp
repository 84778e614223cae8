// Checklist items 23 to 25 of the contour-lines specification, on the processor.

#include "limn/lines/image_lines.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/formulas/formulas.h"
#include "limn/lines/draw.h"
#include "limn/lines/regions.h"
#include "limn/surface/shapes.h"

namespace limn {
namespace {

/// Fields that show nothing but an intensity.
LineFields intensity_only(ivec2 size, const std::function<float(int x, int y)>& f)
{
    LineFields fields;
    fields.size = size;
    const std::size_t count = std::size_t(size.x) * std::size_t(size.y);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            fields.intensity.push_back(f(x, y));
    fields.window_depth.assign(count, 1);
    fields.nearness.assign(count, 0);
    fields.normals.assign(count, vec4(0));
    fields.ids.assign(count, 0);
    return fields;
}

/// What an orthographic camera along -z sees of a shape; one unit is `size` / 2.4 pixels.
struct View {
    Shape shape;
    LineModel model;
    RayScene rays;
    LineFields fields;
    Camera camera;

    View(const std::string& name, std::size_t triangles, bool orthographic, dvec3 eye = {0, 0, 5}, bool flat = false)
        : shape(make_shape({.name = name, .triangles = triangles, .float_positions = false})), model(model_of(shape)), rays(build_ray_scene(model))
    {
        camera.eye = eye;
        camera.orthographic = orthographic;
        camera.ortho_height = 2.4;
        camera.size = {240, 240};
        SeenScene scene = seen_scene(model, rays);
        if (flat)
            scene.objects[0].normals = {};
        fields = line_fields(trace_gbuffer(scene, camera), camera, scene, model.scale);
    }
    static LineModel model_of(const Shape& shape)
    {
        const PlacedSurface placed = {&shape.mesh, &shape.exact};
        return build_line_model({&placed, 1});
    }
};

double radius_at(int x, int y) { return std::hypot(x + 0.5 - 120, y + 0.5 - 120); }

// 23: the inner edge of the dark ring of a sphere is at sqrt(1 - t^2) R.
TEST(ImageLines, ThresholdRingOfASphereHasItsAnalyticRadius)
{
    const View sphere("sphere", 50000, true);
    for (const float limit : {0.2f, 0.4f, 0.6f}) {
        ImageLineOptions options;
        options.method = ImageMethod::threshold;
        options.dark = limit;
        const Image lines = find_image_lines(sphere.fields, options);
        const double inner = std::sqrt(1 - double(limit) * double(limit)) * 100;
        for (int y = 0; y < 240; ++y)
            for (int x = 0; x < 240; ++x)
                if (const double r = radius_at(x, y); std::abs(r - inner) > 1 && std::abs(r - 100) > 1) {
                    ASSERT_EQ(*lines.at(x, y), r > inner && r < 100 ? 1.0f : 0.0f) << x << "," << y << " limit " << limit;
                }
    }
}

// 23: flat shading makes the ring's edge jagged.
TEST(ImageLines, ThresholdOfFlatNormalsIsJagged)
{
    ImageLineOptions options;
    options.method = ImageMethod::threshold;
    options.dark = 0.4f;
    const double inner = std::sqrt(1 - 0.16) * 100;
    const auto stray = [&](bool flat) {
        const View sphere("sphere", 2000, true, {0, 0, 5}, flat);
        const Image lines = find_image_lines(sphere.fields, options);
        int count = 0;
        for (int y = 0; y < 240; ++y)
            for (int x = 0; x < 240; ++x)
                if (const double r = radius_at(x, y); std::abs(r - inner) > 1 && r < 97)
                    count += *lines.at(x, y) != (r > inner ? 1.0f : 0.0f);
        return count;
    };
    EXPECT_GT(stray(true), 5 * stray(false) + 50);
}

// 24: the operator against its convolution, and its factor of 8.
TEST(ImageLines, SobelIsItsConvolution)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<float> value(0, 1);
    const float across[9] = {1, 0, -1, 2, 0, -2, 1, 0, -1}, along[9] = {-1, -2, -1, 0, 0, 0, 1, 2, 1};
    for (int i = 0; i < 1000; ++i) {
        float z[9], x = 0, y = 0;
        for (int k = 0; k < 9; ++k) {
            z[k] = value(random);
            x += across[k] * z[k];
            y += along[k] * z[k];
        }
        EXPECT_NEAR(formulas::sobel_strength(z), std::hypot(x, y), 1e-5);
    }
    float ramp[9];
    for (int k = 0; k < 9; ++k)
        ramp[k] = 0.25f * float(k % 3);
    EXPECT_NEAR(formulas::sobel_strength(ramp), 2, 1e-6);
}

// 24: the outline of a sphere, from both depth methods: the window of 3 x 3 around a marked pixel holds it, so that the pixel itself is within
// 1 px of it and its centre within sqrt(2).
TEST(ImageLines, DepthEdgesOfASphereAreItsOutline)
{
    for (const bool orthographic : {true, false}) {
        const View sphere("sphere", 50000, orthographic, {0, 0, 5});
        // The outline of the unit sphere from 5 away is a circle of radius 1 / sqrt(24) in the plane at depth 1.
        const double outline = orthographic ? 100 : sphere.camera.pixels_per_unit(1) / std::sqrt(24.0);
        for (const ImageMethod method : {ImageMethod::depth, ImageMethod::depth_raw}) {
            ImageLineOptions options;
            options.method = method;
            options.step = orthographic ? 0.3f : 0.1f;
            options.fold_degrees = 180;
            options.sobel = 0.9f;
            const Image lines = find_image_lines(sphere.fields, options);
            std::vector<bool> seen(360, false);
            for (int y = 0; y < 240; ++y)
                for (int x = 0; x < 240; ++x)
                    if (*lines.at(x, y) == 1) {
                        ASSERT_NEAR(radius_at(x, y), outline, std::numbers::sqrt2) << x << "," << y;
                        seen[std::size_t((std::atan2(y - 119.5, x - 119.5) + std::numbers::pi) / (2 * std::numbers::pi) * 359.99)] = true;
                    }
            EXPECT_GT(std::count(seen.begin(), seen.end(), true), 345) << "closed all round";
        }
    }
}

// 24: the slope of a plane is no line, however steep; raw depth takes it for one.
TEST(ImageLines, ASteepPlaneIsNoDepthEdge)
{
    LineFields fields = intensity_only({60, 60}, [](int, int) { return 1.0f; });
    fields.ids.assign(fields.ids.size(), 1);
    fields.normals.assign(fields.normals.size(), vec4(0, 0, 1, 0));
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 60; ++x) {
            fields.nearness[std::size_t(60 * y + x)] = 0.2f + 0.01f * float(x); // 1/depth of a plane is linear in the picture
            fields.window_depth[std::size_t(60 * y + x)] = 1 - 0.015f * float(x);
        }
    ImageLineOptions compensated, raw;
    compensated.method = ImageMethod::depth;
    raw.method = ImageMethod::depth_raw;
    const Image none_found = find_image_lines(fields, compensated), all_found = find_image_lines(fields, raw);
    for (int y = 2; y < 58; ++y)
        for (int x = 2; x < 58; ++x) {
            ASSERT_EQ(*none_found.at(x, y), 0.0f) << x << "," << y;
            ASSERT_EQ(*all_found.at(x, y), 1.0f) << x << "," << y;
        }
}

TEST(ImageLines, FoldsAndBordersOfObjectsAreOnePixelWide)
{
    LineFields fields = intensity_only({40, 40}, [](int, int) { return 1.0f; });
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 40; ++x) {
            const std::size_t i = std::size_t(40 * y + x);
            fields.nearness[i] = 0.5f;
            fields.normals[i] = x < 20 ? vec4(0, 0, 1, 0) : vec4(1, 0, 0, 0);
            fields.ids[i] = y < 20 ? 1 : 2;
        }
    const Image lines = find_image_lines(fields, {.method = ImageMethod::depth});
    for (int k = 2; k < 18; ++k) {
        EXPECT_EQ(*lines.at(18, k) + *lines.at(19, k) + *lines.at(20, k) + *lines.at(21, k), 1.0f) << "fold, row " << k;
        EXPECT_EQ(*lines.at(k, 18) + *lines.at(k, 19) + *lines.at(k, 20) + *lines.at(k, 21), 1.0f) << "border, column " << k;
    }
    EXPECT_EQ(*lines.at(5, 5), 0.0f);
}

// 25: a V-shaped valley is found at its centre line, for each radius; flat pictures and ramps hold none.
TEST(ImageLines, ValleysAreFoundAtTheirCentreLine)
{
    const LineFields valley = intensity_only({80, 80}, [](int x, int y) { return 0.2f + 0.02f * float(std::abs(x - 40)) + 0.0f * float(y); });
    const LineFields flat = intensity_only({80, 80}, [](int, int) { return 0.5f; });
    const LineFields ramp = intensity_only({80, 80}, [](int x, int) { return 0.01f * float(x); });
    for (const ImageMethod method : {ImageMethod::valley, ImageMethod::valley_printed})
        for (const int radius : {2, 3, 5, 10}) {
            ImageLineOptions options;
            options.method = method;
            options.radius = radius;
            options.contrast = 0.01f * float(radius);
            const Image in_valley = find_image_lines(valley, options), in_flat = find_image_lines(flat, options), in_ramp = find_image_lines(ramp, options);
            for (int y = radius; y < 80 - radius; ++y) {
                EXPECT_EQ(*in_valley.at(40, y), 1.0f) << radius;
                for (int x = radius; x < 80 - radius; ++x) {
                    if (std::abs(x - 40) > std::max(1, radius / 2)) {
                        ASSERT_EQ(*in_valley.at(x, y), 0.0f) << x << " radius " << radius;
                    }
                    ASSERT_EQ(*in_flat.at(x, y), 0.0f);
                    ASSERT_EQ(*in_ramp.at(x, y), 0.0f) << x << " radius " << radius;
                }
            }
        }
}

TEST(ImageLines, NoneIsNone)
{
    const Image lines = find_image_lines(intensity_only({4, 4}, [](int, int) { return 0.0f; }), {});
    EXPECT_EQ(lines.samples, std::vector<float>(16, 0));
}

TEST(ImageLines, RefusesOptionsOutOfRange)
{
    const LineFields fields = intensity_only({4, 4}, [](int, int) { return 1.0f; });
    ImageLineOptions options;
    options.radius = 0;
    EXPECT_THROW(find_image_lines(fields, options), Error::Input);
    options.radius = 3;
    options.dark = -1;
    EXPECT_THROW(find_image_lines(fields, options), Error::Input);
}

} // namespace
} // namespace limn
