// Prints from G-code as pictures (the procedural structures specification, 7.6): real beads near and the filtered layers far, with one mean radiance.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/base/random.h"
#include "limn/base/srgb.h"
#include "limn/scene/depth_plane.h"
#include "limn/scene/print_picture.h"

namespace limn {
namespace {

/// Two walls side by side, 40 mm long and 24 mm high.
PrintPath wall()
{
    std::string text = "G90\nM83\n";
    for (int layer = 1; layer <= 120; ++layer)
        text += fmt::format(";LAYER_CHANGE\n;HEIGHT:0.2\nG1 Z{:.1f} F6000\n;TYPE:External perimeter\n;WIDTH:0.45\nG1 X0 Y0\nG1 X40 E2 "
                            "F1200\nG1 X40 Y0.4\n;TYPE:Perimeter\nG1 X0 Y0.4 E2 F2400\n",
                            0.2 * layer);
    return gcode_from_text(text, "wall");
}

/// A wall whose layers step back, three beads thick.
PrintPath slope()
{
    std::string text = "G90\nM83\n";
    for (int layer = 1; layer <= 120; ++layer) {
        text += fmt::format(";LAYER_CHANGE\n;HEIGHT:0.2\nG1 Z{:.1f} F6000\n;TYPE:External perimeter\n;WIDTH:0.45\n", 0.2 * layer);
        for (int bead = 0; bead < 3; ++bead)
            text += fmt::format("G1 X0 Y{0:.2f}\nG1 X40 Y{0:.2f} E2 F1200\n", 0.12 * layer + 0.4 * bead);
    }
    return gcode_from_text(text, "slope");
}

/// Beads side by side, as they fill the space.
PrintPath slab()
{
    std::string text = "G90\nM83\n;LAYER_CHANGE\n;HEIGHT:0.2\nG1 Z0.2 F6000\n;TYPE:Top solid infill\n;WIDTH:0.45\n";
    for (int k = 0; k < 100; ++k)
        text += fmt::format("G1 X0 Y{0:.5f}\nG1 X40 Y{0:.5f} E2\n", 0.40708 * k);
    return gcode_from_text(text, "slab");
}

struct Shot {
    Image picture;
    vec3 mean = vec3(0); ///< linear, of the middle
    double spread = 0;   ///< standard deviation there
};

Shot shoot(const PrintPath& path, const std::string& view, double detail, int samples, ivec2 size = {160, 90})
{
    PrintOptions options;
    options.detail = detail;
    PatternOptions pattern;
    pattern.variety = 0;
    ShadeOptions shade;
    shade.samples = samples;
    shade.up = {0, 0, 1};
    const SeenPrint print = see_print(path, options);
    const Camera camera = Camera::framing(print.bounds, {.view = view, .up_axis = 'z', .size = size, .orthographic = true});
    Shot shot = {paint_print(print, path, camera, options, pattern, shade)};
    double sum = 0, squares = 0, count = 0;
    for (int y = size.y / 2 - size.y / 8; y < size.y / 2 + size.y / 8; ++y)
        for (int x = size.x / 2 - size.x / 8; x < size.x / 2 + size.x / 8; ++x) {
            const float* c = shot.picture.at(x, y);
            const vec3 linear = {linear_from_srgb(c[0]), linear_from_srgb(c[1]), linear_from_srgb(c[2])};
            shot.mean += linear;
            sum += double(linear.y);
            squares += double(linear.y) * double(linear.y);
            ++count;
        }
    shot.mean /= float(count);
    shot.spread = std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count)));
    return shot;
}

TEST(PrintPicture, BeadsAndTheLayersTheyMakeHaveOneMeanRadiance)
{
    const PrintPath walls = wall();
    for (const std::string view : {"0,0", "40,20", "60,50", "0,-20"}) {
        const vec3 near = shoot(walls, view, 0, 64).mean, far = shoot(walls, view, 1000, 64).mean;
        EXPECT_NEAR(far.y / near.y, 1, 0.03) << view;
    }
    const PrintPath leaning = slope();
    for (const std::string view : {"0,0", "40,20", "-30,40"}) {
        const vec3 near = shoot(leaning, view, 0, 64).mean, far = shoot(leaning, view, 1000, 64).mean;
        EXPECT_NEAR(far.y / near.y, 1, 0.09) << view << ": bodies know what hides the sky right above them, not before a step";
    }
    const PrintPath floor = slab();
    for (const std::string view : {"0,35", "40,20", "-50,60"}) {
        const vec3 near = shoot(floor, view, 0, 64).mean, far = shoot(floor, view, 1000, 64).mean;
        EXPECT_NEAR(far.y / near.y, 1, 0.06) << view;
    }
}

TEST(PrintPicture, FarLayersDoNotShimmer)
{
    // At about one and a half layers a pixel a single ray sees moire; the filter sees a wall.
    const PrintPath walls = wall();
    const Shot one_ray = shoot(walls, "10,5", 0, 1), filtered = shoot(walls, "10,5", 3, 16);
    EXPECT_GT(one_ray.spread, 0.05);
    EXPECT_LT(filtered.spread, one_ray.spread / 10);
}

TEST(PrintPicture, IsTheSameForAnyNumberOfThreads)
{
    const PrintPath walls = wall();
    const Shot one = with_threads(1, [&] { return shoot(walls, "40,20", 3, 16); }),
               four = with_threads(4, [&] { return shoot(walls, "40,20", 3, 16); });
    EXPECT_EQ(one.picture.samples, four.picture.samples);
}

TEST(PrintPicture, ABeadCoversThePixelsThatItsBodyDoes)
{
    const PrintPath path = gcode_from_text("M83\n;LAYER_CHANGE\n;HEIGHT:1\nG1 Z1 F600\n;WIDTH:4\nG1 X10 E1\n", "bead");
    PrintOptions options;
    ShadeOptions shade;
    shade.up = {0, 0, 1};
    shade.background = vec3(1, 0, 0); // grey beads have as much green as red; the rest has none
    const SeenPrint print = see_print(path, options);
    const Camera camera = Camera::framing(print.bounds, {.view = "top", .up_axis = 'z', .size = {200, 100}, .orthographic = true});
    PatternOptions pattern;
    pattern.colour = vec3(0.6f);
    const Image image = paint_print(print, path, camera, options, pattern, shade);
    const float* middle = image.at(100, 50);
    const double green = double(linear_from_srgb(middle[1]));
    double covered = 0; // the body is flat on top but for its rim, which is not brighter than its middle
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 200; ++x) {
            const double red = double(linear_from_srgb(image.at(x, y)[0])), share = (1 - red) / (1 - double(linear_from_srgb(middle[0])));
            covered += image.at(x, y)[1] > 0 ? std::min(1.0, share) : 0;
        }
    const double pixels = camera.pixels_per_unit(1) * camera.pixels_per_unit(1);
    EXPECT_GT(green, 0.05);
    EXPECT_NEAR(covered / pixels / (10 * 4 + 3.14159265 * 4), 1, 0.02);
}

TEST(PrintPicture, LayersTravelAndColoursAreThoseAskedFor)
{
    const PrintPath path = wall();
    PrintOptions options;
    EXPECT_EQ(see_print(path, options).moves.size(), 240u);
    options.first_layer = 3;
    options.last_layer = 4;
    EXPECT_EQ(see_print(path, options).moves.size(), 4u);
    options.travel = true;
    EXPECT_GT(see_print(path, options).moves.size(), 4u);
    options.first_layer = 121;
    options.last_layer = 200;
    EXPECT_THROW(see_print(path, options), Error::Input);

    PrintOptions coloured;
    coloured.colour = PrintColour::feature;
    const BeadColours features(path, coloured, vec3(0.5f));
    ASSERT_EQ(features.legend().swatches.size(), 2u);
    EXPECT_EQ(features.legend().swatches[0].text, "outer wall");
    coloured.colour = PrintColour::speed;
    const BeadColours speeds(path, coloured, vec3(0.5f));
    EXPECT_TRUE(speeds.legend().scale);
    EXPECT_NEAR(speeds.legend().low, 20, 1e-5);
    EXPECT_NEAR(speeds.legend().high, 40, 1e-5);
    EXPECT_NE(speeds.of(path.moves[1]), speeds.of(path.moves[3]));
}

TEST(DepthPicture, FindsThePlaneOfAWallInWhatItsReliefLeaves)
{
    for (const bool orthographic : {false, true}) {
        Camera camera;
        camera.eye = {0, 0, 5};
        camera.look = {0.3, -0.2, 0};
        camera.orthographic = orthographic;
        camera.size = {80, 60};
        const vec3 n = glm::normalize(vec3(0.3f, 0.5f, 1));
        DepthPicture depths(camera, 1);
        Random random(3);
        const double thick = 0.02;
        for (int y = 0; y < 60; ++y)
            for (int x = 0; x < 80; ++x) {
                const Camera::Ray ray = camera.ray({x + 0.5, y + 0.5});
                const double t = -glm::dot(ray.origin, dvec3(n)) / glm::dot(ray.direction, dvec3(n)) + thick * (random.uniform() - 0.5);
                const bool other = x > 60; // another surface, far behind
                depths.depth(x, y) = float(glm::dot(ray.origin + t * ray.direction - camera.eye, camera.forward())) + (other ? 1.0f : 0.0f);
            }
        for (const ivec2& at : {ivec2(20, 30), ivec2(40, 10), ivec2(57, 30)})
            EXPECT_GT(glm::dot(depths.normal_at(at.x, at.y, 8, float(thick)), n), 0.999f) << at.x;
        EXPECT_EQ(DepthPicture(camera, 1).normal_at(20, 30, 8, 0.02f), vec3(0)); // nothing is seen
    }
}

} // namespace
} // namespace limn
