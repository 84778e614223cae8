// Checklist item 22 of the contour-lines specification: lines by look-up in a mip-mapped texture (M6), on the processor.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/base/distance_transform.h"
#include "limn/base/error.h"
#include "limn/drawing/agreement.h"
#include "limn/lines/bar_texture.h"
#include "limn/lines/draw.h"
#include "limn/lines/regions.h"
#include "limn/lines/shader_lines.h"
#include "support/staged_shape.h"

namespace limn::test {
namespace {

Image find_lines(const StagedShape& stage, const Camera& camera, const ShaderLineOptions& options)
{
    return find_shader_lines(stage.model, trace_gbuffer(stage.seen(), camera), camera, options);
}

// 22: every level holds a bar of as many texels, capped at a quarter of the level; what is too small to hold one is empty.
TEST(TextureLines, EveryLevelHoldsTheSameBar)
{
    for (const float width : {2.0f, 5.0f, 8.0f}) {
        const std::vector<Image> levels = bar_texture(128, width);
        ASSERT_EQ(levels.size(), 8u);
        for (const Image& level : levels)
            for (int t = 0; t < level.height; ++t) {
                float sum = 0, moment = 0;
                for (int s = 0; s < level.width; ++s) {
                    sum += *level.at(s, t);
                    moment += *level.at(s, t) * (float(s) + 0.5f - 0.5f * float(level.width));
                }
                const bool drawn = level.width >= 4 && 2 * t >= level.height;
                EXPECT_EQ(sum, drawn ? std::min(width, 0.25f * float(level.width)) : 0.0f) << level.width << " row " << t;
                EXPECT_EQ(moment, 0.0f) << "lies across the middle";
            }
    }
    for (const int size : {0, 2, 100, 8192})
        EXPECT_THROW(bar_texture(size, 8), Error::Input) << size;
    EXPECT_THROW(bar_texture(128, 0), Error::Input);
}

// Between texels and levels the ink is mixed; at their centres it is theirs; beyond the border it goes on.
TEST(TextureLines, FiltersBetweenTexelsAndLevels)
{
    std::vector<Image> levels = {Image({4, 4}, 1), Image({2, 2}, 1, 0.5f), Image({1, 1}, 1, 1)};
    for (int k = 0; k < 16; ++k)
        levels[0].samples[std::size_t(k)] = float(k % 4) / 4 + float(k / 4) / 16;
    EXPECT_FLOAT_EQ(filtered(levels, {0.375f, 0.625f}, 0), 1 / 4.0f + 2 / 16.0f);
    EXPECT_FLOAT_EQ(filtered(levels, {0.5f, 0.625f}, 0), 1.5f / 4 + 2 / 16.0f);
    EXPECT_FLOAT_EQ(filtered(levels, {0.375f, 0.5f}, -3), 1 / 4.0f + 1.5f / 16);
    EXPECT_FLOAT_EQ(filtered(levels, {-7.0f, 9.0f}, 0), 3 / 16.0f);
    EXPECT_FLOAT_EQ(filtered(levels, {0.375f, 0.625f}, 0.25f), 0.75f * 0.375f + 0.25f * 0.5f);
    EXPECT_FLOAT_EQ(filtered(levels, {0.2f, 0.3f}, 1.5f), 0.75f);
    EXPECT_FLOAT_EQ(filtered(levels, {0.2f, 0.3f}, 99), 1);
}

/// Ink over the length of the object space's lines, px: their mean width where the two are at the same places.
double mean_width(const StagedShape& stage, const Camera& camera, const ShaderLineOptions& options, LineType type)
{
    LineOptions lines;
    lines.lines = {type};
    lines.fade = lines.min_length = 0;
    const Drawing drawing = draw_lines(stage.model, stage.rays, camera, lines);
    const Image wanted = line_pixels(drawing), ink = find_lines(stage, camera, options);
    std::vector<std::uint8_t> marks(wanted.samples.begin(), wanted.samples.end());
    const DistanceTransform near = distance_transform(marks, camera.size);
    double sum = 0, length = 0;
    for (int y = 0; y < ink.height; ++y)
        for (int x = 0; x < ink.width; ++x)
            sum += near.distance(x, y) <= 8 ? double(*ink.at(x, y)) : 0;
    for (const Stroke& stroke : drawing.strokes)
        for (std::size_t i = 1; i < stroke.points.size(); ++i)
            length += glm::distance(stroke.points[i - 1], stroke.points[i]);
    return sum / length;
}

// 22: zoomed by four in two steps, the lines keep their width within 50 % of the middle one.
TEST(TextureLines, KeepTheirWidthOverThreeZooms)
{
    struct Case {
        const char* shape;
        LineType type;
    };
    for (const Case& c : {Case{"torus", LineType::contour}, Case{"ellipsoid", LineType::contour}, Case{"sine-sheet", LineType::suggestive}}) {
        const StagedShape stage(c.shape, 100000);
        ShaderLineOptions options = {.method = ShaderMethod::texture};
        options.contour_width = options.suggestive_width = 4;
        options.suggestive = c.type == LineType::suggestive;
        double widths[3];
        for (int zoom = 0; zoom < 3; ++zoom) {
            const Camera camera = stage.camera({300 << zoom, 240 << zoom}, false, "35,45"); // the sheet has no contour from there
            widths[zoom] = mean_width(stage, camera, options, c.type);
        }
        fmt::print("[ zoom     ] {}: {:.2f}, {:.2f}, {:.2f} px\n", c.shape, widths[0], widths[1], widths[2]);
        for (const double width : widths)
            EXPECT_NEAR(width, widths[1], 0.5 * widths[1]) << c.shape;
        EXPECT_NEAR(widths[1], 4, 2) << c.shape;
    }
}

// 22: artefacts are inked pixels without a line of the objects' space within 3 px, and lines without ink; M7 has fewer.
TEST(TextureLines, HaveMoreArtefactsThanTheWidthMethod)
{
    std::size_t texture = 0, width = 0, lines = 0;
    for (const char* name : {"bumpy-torus", "knot", "blob"}) {
        const StagedShape stage(name, 100000);
        const Camera camera = stage.camera({400, 300});
        LineOptions options;
        options.lines = {LineType::contour, LineType::suggestive};
        options.fade = options.min_length = 0;
        const Image wanted = line_pixels(draw_lines(stage.model, stage.rays, camera, options));
        const auto count = [](const Image& image) { return double(std::count_if(image.samples.begin(), image.samples.end(), [](float s) { return s > 0.5f; })); };
        const auto artefacts = [&](ShaderMethod method) {
            const Image ink = find_lines(stage, camera, {.method = method});
            const LineAgreement agreement = compare_lines(ink, wanted, 3);
            return std::size_t(std::lround((1 - agreement.precision) * count(ink) + (1 - agreement.recall) * count(wanted)));
        };
        const std::size_t of_texture = artefacts(ShaderMethod::texture), of_width = artefacts(ShaderMethod::width);
        fmt::print("[ artefacts ] {}: {} px by texture, {} px by width, of {} px of lines\n", name, of_texture, of_width, count(wanted));
        texture += of_texture;
        width += of_width;
        lines += std::size_t(count(wanted));
    }
    EXPECT_GT(texture, width);
    EXPECT_LT(double(texture), 0.15 * double(lines));
}

} // namespace
} // namespace limn::test
