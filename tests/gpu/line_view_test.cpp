#include "limn/gpu/line_view.h"

#include <algorithm>

#include <fmt/format.h>

#include "gpu/gpu.h"
#include "limn/lines/draw.h"
#include "limn/lines/prepare.h"
#include "limn/surface/shapes.h"

namespace limn::test {
namespace {

class GpuLineView : public Gpu {};

/// A shape split along its creases, with rays to ask what is hidden.
struct Subject {
    PreparedMesh prepared;
    LineModel model;
    RayScene rays;
    Subject(const std::string& name, std::size_t triangles)
        : prepared(prepare_mesh(make_shape({.name = name, .triangles = triangles, .float_positions = false}).mesh)), model(model_of(prepared)), rays(build_ray_scene(model))
    {
    }
    static LineModel model_of(const PreparedMesh& prepared)
    {
        const PlacedSurface placed = prepared.placed();
        return build_line_model({&placed, 1});
    }
    Camera camera(const std::string& view, bool orthographic) const
    {
        return Camera::framing(prepared.mesh.bounds(), {.view = view, .up_axis = 'z', .size = {500, 400}, .orthographic = orthographic});
    }
};

/// Every half pixel of the strokes that the processor finds visible.
std::vector<dvec2> visible_places(const Subject& subject, const Camera& camera, const LineOptions& options)
{
    std::vector<dvec2> places;
    for (const Stroke& stroke : draw_lines(subject.model, subject.rays, camera, options).strokes)
        for (std::size_t i = stroke.closed ? 0 : 1; stroke.visible && i < stroke.points.size(); ++i) {
            const dvec2 &from = stroke.points[i > 0 ? i - 1 : stroke.points.size() - 1], &to = stroke.points[i];
            const double length = glm::distance(from, to);
            for (double s = 0; s < length; s += 0.5)
                places.push_back(glm::mix(from, to, s / length));
        }
    return places;
}

/// Visits the pixels whose middle lies within `reach` of a place.
template <class Visit> void around(const Image& image, const dvec2& p, double reach, Visit&& visit)
{
    for (int y = int(p.y - reach); y <= int(p.y + reach); ++y)
        for (int x = int(p.x - reach); x <= int(p.x + reach); ++x)
            if (x >= 0 && y >= 0 && x < image.width && y < image.height && glm::distance(dvec2(x + 0.5, y + 0.5), p) <= reach)
                visit(x, y);
}

// As checklist item 21 asks of shaders: the lines have ink within 2 px, and the ink a line.
TEST_F(GpuLineView, ShowsTheLinesThatTheProcessorFindsVisible)
{
    for (const bool orthographic : {false, true})
        for (const char* name : {"torus", "blob", "knot", "bumpy-torus", "cube", "cylinder"}) {
            const Subject subject(name, 60000);
            const Camera camera = subject.camera("35,25", orthographic);
            LineOptions options;
            options.lines = {LineType::contour, LineType::suggestive};
            options.fade = options.min_length = 0;
            SuggestiveOptions limits;
            limits.feature_size = find_line_features(subject.model, options).feature_size;
            limits.limit = float(options.suggestive_limit);
            limits.fade = 0;
            const bool curved = subject.model.has_derivative();
            gpu::LineExtractor lines(subject.model);
            const gpu::LineView view = gpu::draw_lines(lines, gpu::LineRenderer(lines), camera, {.suggestive = curved ? &limits : nullptr});
            Image ink = view.contours, near(camera.size, 1);
            for (std::size_t i = 0; i < ink.samples.size(); ++i)
                ink.samples[i] = std::max(ink.samples[i], view.suggestive.samples[i]);

            const std::vector<dvec2> places = visible_places(subject, camera, options);
            std::size_t found = 0, dark = 0, explained = 0;
            for (const dvec2& p : places) {
                bool inked = false;
                around(ink, p, 2, [&](int x, int y) { inked = inked || *ink.at(x, y) > 0.5f; });
                found += inked;
                around(near, p, 3, [&](int x, int y) { *near.at(x, y) = 1; }); // half of the width, and 2 px
            }
            for (std::size_t i = 0; i < ink.samples.size(); ++i)
                if (ink.samples[i] > 0.5f) {
                    ++dark;
                    explained += near.samples[i] == 1;
                }
            fmt::print("[ picture  ] {}{}: {:.1f} % of the lines have ink within 2 px, {:.1f} % of the ink a line\n", name, orthographic ? ", orthographic" : "",
                       100.0 * double(found) / double(places.size()), 100.0 * double(explained) / double(dark));
            EXPECT_GT(places.size(), 500u) << name;
            EXPECT_GE(double(found), 0.95 * double(places.size())) << name;
            EXPECT_GE(double(explained), 0.95 * double(dark)) << name;
        }
}

// The ink over the length of the visible lines.
TEST_F(GpuLineView, DrawsLinesAsWideAsAsked)
{
    const Subject subject("torus", 40000);
    const Camera camera = subject.camera("0,90", true); // two circles
    LineOptions options;
    options.lines = {LineType::contour};
    options.fade = options.min_length = 0;
    const double length = 0.5 * double(visible_places(subject, camera, options).size());
    gpu::LineExtractor lines(subject.model);
    const gpu::LineRenderer renderer(lines);
    for (const float width : {1.0f, 2.0f, 3.5f, 6.0f}) {
        const gpu::LineView view = gpu::draw_lines(lines, renderer, camera, {}, {.contour = width});
        double ink = 0;
        for (const float sample : view.contours.samples)
            ink += double(sample);
        EXPECT_NEAR(ink / length, double(width), 0.08 * double(width)) << width;
    }
}

TEST_F(GpuLineView, HidesWhatLiesBehind)
{
    const Subject subject("cube", 3000);
    gpu::LineExtractor lines(subject.model);
    const gpu::LineRenderer renderer(lines);
    const gpu::LineView view = gpu::draw_lines(lines, renderer, subject.camera("front", true), {});
    double inside = 0, all = 0;
    for (int y = 0; y < view.contours.height; ++y)
        for (int x = 0; x < view.contours.width; ++x) {
            all += double(*view.contours.at(x, y));
            const bool middle = std::abs(x - 250) < 100 && std::abs(y - 200) < 100;
            inside += middle ? double(*view.contours.at(x, y)) : 0;
        }
    EXPECT_GT(all, 1000);
    EXPECT_EQ(inside, 0);
}

TEST_F(GpuLineView, HasNoInkWhereThereAreNoLines)
{
    const Subject subject("plane", 500);
    gpu::LineExtractor lines(subject.model);
    const gpu::LineView view = gpu::draw_lines(lines, gpu::LineRenderer(lines), subject.camera("0,90", true), {});
    EXPECT_EQ(*std::max_element(view.contours.samples.begin(), view.contours.samples.end()), 0);
}

// A later view draws from what is on the device, with nothing read back in between.
TEST_F(GpuLineView, NeedsNoReadingBackFromTheSecondViewOn)
{
    const Subject subject("bumpy-torus", 20000);
    const Camera first = subject.camera("35,25", false), second = subject.camera("60,40", false);
    gpu::LineExtractor lines(subject.model);
    const gpu::LineRenderer renderer(lines);
    const gpu::LineView whole = gpu::draw_lines(lines, renderer, second, {});
    gpu::draw_lines(lines, renderer, first, {});

    lines.extract(subject.model.view(second), {});
    const gpu::Framebuffer depth(second.size, {}), picture(second.size, {gpu::Format::rgba8});
    picture.clear(0, vec4(0));
    renderer.draw_depth(depth, second);
    renderer.draw(picture, depth, second);
    const std::vector<vec4> pixels = picture.read_floats(0);
    const std::size_t width = std::size_t(second.size.x), height = std::size_t(second.size.y);
    std::size_t differ = 0, dark = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const float other = whole.contours.samples[(height - 1 - i / width) * width + i % width];
        differ += pixels[i].x != other;
        dark += other > 0.5f;
    }
    EXPECT_EQ(differ, 0u);
    EXPECT_GT(dark, 1000u);
}

} // namespace
} // namespace limn::test
