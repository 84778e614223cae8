// Checklist items 24 and 25 of the contour-lines specification on whole scenes: lines found per pixel against those of the objects' space.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/base/distance_transform.h"
#include "limn/drawing/agreement.h"
#include "limn/lines/draw.h"
#include "limn/lines/image_lines.h"
#include "support/staged_shape.h"

namespace limn::test {
namespace {

LineFields fields_of(const StagedShape& stage, const Camera& camera)
{
    return line_fields(trace_gbuffer(stage.seen(), camera), camera, stage.seen(), stage.model.scale);
}

Image lines_of_space(const StagedShape& stage, const Camera& camera, LineType type)
{
    LineOptions options;
    options.lines = {type};
    options.fade = options.min_length = 0;
    return line_pixels(draw_lines(stage.model, stage.rays, camera, options));
}

DistanceTransform distances(const std::vector<std::uint8_t>& marks, ivec2 size) { return distance_transform(marks, size); }
DistanceTransform distances(const Image& lines) { return distances({lines.samples.begin(), lines.samples.end()}, lines.size()); }

DistanceTransform distances_to_background(const LineFields& fields)
{
    std::vector<std::uint8_t> marks;
    for (const std::uint32_t id : fields.ids)
        marks.push_back(id == 0 ? 1 : 0);
    return distances(marks, fields.size);
}

/// The pixels of `lines` further than `margin` from the background.
Image inner(Image lines, const DistanceTransform& to_background, double margin)
{
    for (int y = 0; y < lines.height; ++y)
        for (int x = 0; x < lines.width; ++x)
            if (to_background.distance(x, y) <= margin)
                *lines.at(x, y) = 0;
    return lines;
}

double count(const Image& lines) { return double(std::count(lines.samples.begin(), lines.samples.end(), 1.0f)); }

/// What one limit of a depth method does.
struct Trial {
    double recall;          ///< of inner contours
    double false_positives; ///< found pixels without a contour within 3 px
};

struct Rings {
    StagedShape stage{"rings", 60000};
    Camera camera = stage.camera({400, 300});
    LineFields fields = fields_of(stage, camera);
    Image contours = lines_of_space(stage, camera, LineType::contour);
    Image inner_contours = inner(contours, distances_to_background(fields), 5);

    Trial trial(const ImageLineOptions& options) const
    {
        const Image found = find_image_lines(fields, options);
        return {compare_lines(found, inner_contours).recall, (1 - compare_lines(found, contours).precision) * count(found)};
    }
    Trial raw(float limit) const { return trial({.method = ImageMethod::depth_raw, .sobel = limit}); }
    Trial linear(float step) const { return trial({.method = ImageMethod::depth, .step = step, .fold_degrees = 180}); }
};

// 24: a higher limit loses the contours where one ring passes before another.
TEST(ImageLineScenes, RawDepthLosesTheInnerContoursOfRingsAsItsLimitRises)
{
    const Rings rings;
    ASSERT_GT(count(rings.inner_contours), 150);
    double before = 1;
    std::vector<double> recalls;
    for (const float limit : {0.03f, 0.1f, 0.3f, 0.6f, 1.0f, 1.5f, 2.5f}) {
        const Trial trial = rings.raw(limit);
        fmt::print("[ rings    ] raw, limit {}: {:.3f} of the inner contours, {:.0f} false px\n", limit, trial.recall, trial.false_positives);
        EXPECT_LE(trial.recall, before) << limit;
        before = trial.recall;
        recalls.push_back(trial.recall);
    }
    EXPECT_GT(recalls.front(), 0.95);
    EXPECT_LT(recalls.back(), 0.2);
}

// 24: with as many false pixels, steps of linear depth with the slope taken off find at least as much.
TEST(ImageLineScenes, LinearDepthRecallsAtLeastAsMuchAsRawDepthAtEqualFalsePositives)
{
    const Rings rings;
    std::vector<Trial> linear;
    for (float step = 0.0001f; step < 1; step *= 1.25f)
        linear.push_back(rings.linear(step));
    for (float limit = 0.02f; limit < 3; limit *= 1.5f) {
        const Trial raw = rings.raw(limit);
        double best = 0;
        for (const Trial& trial : linear)
            if (trial.false_positives <= raw.false_positives)
                best = std::max(best, trial.recall);
        fmt::print("[ rings    ] limit {:.3f}: {:.0f} false px, raw {:.3f}, linear {:.3f}\n", limit, raw.false_positives, raw.recall, best);
        EXPECT_GE(best, raw.recall) << limit;
    }
}

/// The sine sheet from where no slope turns away, so that all its lines are suggestive contours, and along its waves.
struct Sheet {
    StagedShape stage{"sine-sheet", 60000};
    Camera camera;
    LineFields fields;
    DistanceTransform to_background;
    Image wanted;

    explicit Sheet(int edge)
        : camera(stage.camera({edge, edge}, false, "90,45")), fields(fields_of(stage, camera)), to_background(distances_to_background(fields)),
          wanted(inner(lines_of_space(stage, camera, LineType::suggestive), to_background, margin(edge)))
    {
    }
    /// What the border of the sheet, dark before a bright background, reaches.
    static double margin(int edge) { return 0.09 * edge; }
    Image found(const ImageLineOptions& options) const { return inner(find_image_lines(fields, options), to_background, margin(camera.size.x)); }
};

// 25: both forms of the radial filter find the suggestive contours, and nothing but them.
TEST(ImageLineScenes, ValleysOfASineSheetAreItsSuggestiveContours)
{
    const Sheet sheet(160);
    ASSERT_GT(count(sheet.wanted), 60);
    const DistanceTransform to_wanted = distances(sheet.wanted);
    for (const ImageMethod method : {ImageMethod::valley, ImageMethod::valley_printed}) {
        const Image found = sheet.found({.method = method, .radius = 8});
        double farthest = 0;
        for (int y = 0; y < found.height; ++y)
            for (int x = 0; x < found.width; ++x)
                if (*found.at(x, y) == 1) {
                    farthest = std::max(farthest, to_wanted.distance(x, y));
                }
        const double recall = compare_lines(found, sheet.wanted, 2).recall;
        fmt::print("[ sheet    ] method {}: {:.1f} px from the lines at most, {:.3f} of them found\n", int(method), farthest, recall);
        EXPECT_LE(farthest, 2) << int(method);
        EXPECT_GE(recall, 0.9) << int(method);
    }
}

// 25: nearer by, a window of so many pixels no longer reaches out of the valley; one that grows with the shape does.
TEST(ImageLineScenes, ValleysAreLostByZoomingInUnlessTheWindowIsScaled)
{
    double raw = 1;
    for (const int edge : {120, 240, 480, 720}) {
        const Sheet sheet(edge);
        raw = compare_lines(sheet.found({.method = ImageMethod::valley, .radius = 7}), sheet.wanted).recall;
        const double scaled = compare_lines(sheet.found({.method = ImageMethod::valley, .radius_scale = 0.1f}), sheet.wanted).recall;
        fmt::print("[ zoom     ] {} px: raw {:.3f}, scaled {:.3f} of the suggestive contours\n", edge, raw, scaled);
        if (edge == 120) {
            EXPECT_GE(raw, 0.9);
        }
        EXPECT_GE(scaled, 0.9) << edge;
    }
    EXPECT_LE(raw, 0.1);
}

} // namespace
} // namespace limn::test
