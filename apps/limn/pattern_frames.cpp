#include "pattern_frames.h"

#include <optional>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/gpu/context.h"
#include "limn/gpu/pattern_view.h"
#include "limn/lines/regions.h"
#include "limn/scene/pattern_picture.h"
#include "limn/scene/render.h"
#include "limn/surface/shapes.h"
#include "timed.h"

using namespace limn;

namespace {

/// The study's cases: a print of about as many triangles as the bunny and a large one, a box of bricks, a ball of thread.
struct Case {
    PatternKind kind;
    const char *name, *shape;
    std::size_t triangles;
};
constexpr Case cases[] = {{PatternKind::layers, "layers", "blob", 70000},
                          {PatternKind::layers, "layers", "blob", 400000},
                          {PatternKind::bricks, "bricks", "cube", 12},
                          {PatternKind::thread, "thread", "sphere", 5000}};
const ivec2 sizes[] = {{500, 500}, {1920, 1080}};

std::optional<gpu::Context> context_if_any()
{
    try {
        return std::optional<gpu::Context>(std::in_place);
    } catch (const Error::Device&) {
        return std::nullopt;
    }
}

struct Frame {
    SeenScene seen;
    Camera camera;
    PatternOptions options;
    PatternPlace place = {0, {}, dvec3(0, 0, 1)};

    ShadeOptions shade(int samples) const
    {
        ShadeOptions shade;
        shade.samples = samples;
        return shade;
    }
    double on_processor(int runs) const
    {
        return median_ms(runs, [&] { paint_pattern(seen, camera, options, place, shade(1)); });
    }
    /// @param pattern_samples  of the study, instead of the filter; 0: none
    double on_device(gpu::PatternRenderer& renderer, int runs, int edge_samples, int pattern_samples) const
    {
        PatternOptions with = options;
        if (pattern_samples > 0) {
            with.filter = PatternFilter::seed;
            with.pattern_samples = pattern_samples;
        }
        const ShadeOptions light = shade(edge_samples);
        const PatternPaint paint = compose_pattern(seen, with, place, light, pattern_lights(seen, camera, light, place));
        return median_ms(runs, [&] { renderer.draw_frame(camera, paint); });
    }
};

} // namespace

FrameTimes time_pattern_frames(int runs, Console& console)
{
    FrameTimes times;
    const std::optional<gpu::Context> context = context_if_any();
    times.device = context ? context->info().renderer : "none";
    int done = 0;
    for (const Case& subject : cases) {
        Scene scene;
        SceneObject object;
        object.mesh = std::make_shared<const Mesh>(make_shape({.name = subject.shape, .triangles = subject.triangles}).mesh);
        scene.objects = {object};
        const SceneModel model = prepare_scene(scene);
        std::optional<gpu::PatternRenderer> renderer;
        if (context)
            renderer.emplace(model.lines);
        for (const ivec2& size : sizes) {
            console.progress(fmt::format("frames of {}, {} triangles", subject.name, subject.triangles),
                             double(done++) / double(std::size(cases) * std::size(sizes)));
            Frame frame = {
                seen_scene(model.lines, model.rays), Camera::framing(model.bounds, {.view = "35,22", .up_axis = 'z', .size = size}), {}};
            frame.options.kind = subject.kind;
            frame.options.layer_height = 0.6;
            std::vector<std::string> row = {subject.name, fmt::format("{}, {}", subject.shape, model.lines.faces.size()),
                                            fmt::format("{} x {}", size.x, size.y), fmt::format("{:.1f}", frame.on_processor(runs))};
            if (renderer) {
                const double filter = frame.on_device(*renderer, runs, 1, 0);
                row.insert(row.end(),
                           {fmt::format("{:.1f}", filter), fmt::format("{:.1f}", frame.on_device(*renderer, runs, 4, 0)),
                            fmt::format("{:.0f}", frame.on_device(*renderer, runs, 1, 50)), fmt::format("{:.0f}", 1000 / filter)});
            } else {
                row.insert(row.end(), 4, "-");
            }
            times.table.add(row);
        }
    }
    return times;
}
