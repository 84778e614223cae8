#include "frame_methods.h"

#include <cmath>
#include <memory>
#include <numbers>

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "console.h"
#include "limn/gpu/field_view.h"
#include "limn/gpu/line_extraction.h"
#include "limn/gpu/line_view.h"
#include "limn/gpu/lit_view.h"
#include "limn/gpu/surface_view.h"
#include "limn/lines/feature_size.h"
#include "limn/lines/regions.h"
#include "limn/lines/stochastic.h"

using namespace limn;

namespace {

Shape shape_of(const std::string& name, std::size_t triangles) { return make_shape({.name = name, .triangles = triangles}); }

LineModel model_of(const Shape& shape)
{
    const PlacedSurface placed = {&shape.mesh, &shape.exact};
    return build_line_model({&placed, 1});
}

double finished(Stopwatch& watch)
{
    glFinish();
    return 1e3 * watch.lap();
}

/// Object space on the processor: strokes with hidden lines removed.
FrameMethod strokes(const FrameSubject& subject, std::string name, std::vector<LineType> types, std::array<int, 5> study)
{
    LineOptions options;
    options.lines = std::move(types);
    auto features = std::make_shared<LineFeatures>(find_line_features(subject.model, options, 1000));
    auto history = std::make_shared<ClusterHistory>();
    auto frame = [&subject, options, features, history](const Camera& camera) {
        DrawReport report;
        draw_lines(subject.model, subject.rays, *features, camera, options, &report, history.get());
        return StageTimes{1e3 * report.extract_seconds, 1e3 * report.visibility_seconds, 1e3 * report.chain_seconds};
    };
    return {std::move(name), {"extract", "visibility", "strokes"}, false, study, frame};
}

/// Segments from a hundredth of the faces and the lines of the frame before, on the processor.
FrameMethod stochastic(const FrameSubject& subject)
{
    struct State {
        SeedSet contours, suggestive;
        SuggestiveOptions limits;
    };
    const LineOptions usual;
    auto state = std::make_shared<State>();
    state->contours = seeds_of_contours(subject.model, 1);
    state->suggestive = seeds_of_suggestive(subject.model, find_suggestive_faces(subject.model), 1);
    state->limits.feature_size = model_feature_size(subject.model, usual.feature_size);
    state->limits.limit = float(usual.suggestive_limit);
    auto frame = [&subject, state](const Camera& camera) {
        const View view = subject.model.view(camera);
        Stopwatch watch;
        extract_contours_stochastic(subject.model, view, {}, state->contours);
        extract_suggestive_stochastic(subject.model, view, state->limits, {}, state->suggestive);
        return StageTimes{1e3 * watch.lap()};
    };
    return {"M5 stochastic, segments, processor", {"extract"}, false, {}, frame};
}

/// Object space on the GPU: segments extracted and drawn where they are, hidden by the depth of the surface.
FrameMethod segments(const FrameSubject& subject, std::string name, std::array<int, 5> study)
{
    struct State {
        gpu::LineExtractor lines;
        gpu::LineRenderer renderer;
        SuggestiveOptions limits;
        std::optional<gpu::Framebuffer> depth, ink;
        State(const LineModel& model, const LineOptions& options) : lines(model), renderer(lines)
        {
            limits.feature_size = model_feature_size(model, options.feature_size);
            limits.limit = float(options.suggestive_limit);
        }
    };
    const LineOptions usual;
    auto state = std::make_shared<State>(subject.model, usual);
    auto frame = [&subject, state](const Camera& camera) {
        if (!state->ink || state->ink->size() != camera.size) {
            state->depth.emplace(camera.size, std::vector<gpu::Format>());
            state->ink.emplace(camera.size, std::vector{gpu::Format::rgba8});
        }
        Stopwatch watch;
        state->lines.extract(subject.model.view(camera), {.contours = true, .suggestive = &state->limits});
        StageTimes times = {finished(watch)};
        state->renderer.draw_depth(*state->depth, camera);
        times.push_back(finished(watch));
        state->ink->clear(0, vec4(0));
        state->renderer.draw(*state->ink, *state->depth, camera);
        times.push_back(finished(watch));
        return times;
    };
    return {std::move(name), {"extract", "depth", "lines"}, true, study, frame};
}

/// Lines found in a picture, on the GPU.
FrameMethod filter(std::shared_ptr<gpu::FieldRenderer> renderer, std::string name, const ImageLineOptions& options, std::array<int, 5> study)
{
    auto finder = std::make_shared<gpu::ImageLineFinder>();
    auto found = std::make_shared<gpu::Buffer>();
    auto frame = [=](const Camera& camera) {
        const std::size_t bytes = std::size_t(camera.size.x) * std::size_t(camera.size.y) * sizeof(unsigned);
        if (found->bytes() != bytes)
            *found = gpu::Buffer(bytes);
        Stopwatch watch;
        const gpu::DeviceFields& fields = renderer->fields(camera, {ivec2(0), camera.size});
        StageTimes times = {finished(watch)};
        finder->run(fields, options, *found);
        times.push_back(finished(watch));
        return times;
    };
    return {std::move(name), {"model", "filter"}, true, study, frame};
}

/// Lines decided by the fragment shader of the model's own pass.
FrameMethod shader(std::shared_ptr<gpu::SurfaceRenderer> renderer, std::string name, const ShaderLineOptions& options, std::array<int, 5> study)
{
    auto picture = std::make_shared<std::optional<gpu::Framebuffer>>();
    auto frame = [=](const Camera& camera) {
        if (!*picture || (*picture)->size() != camera.size)
            picture->emplace(camera.size, std::vector{gpu::Format::rgba32f});
        Stopwatch watch;
        (*picture)->clear(0, vec4(0));
        renderer->draw(**picture, camera, {ivec2(0), camera.size}, options);
        return StageTimes{finished(watch)};
    };
    return {std::move(name), {"model"}, true, study, frame};
}

FrameMethod lit_on_gpu(const FrameSubject& subject)
{
    auto renderer = std::make_shared<gpu::LitRenderer>(subject.model, 1 << 14);
    auto frame = [renderer](const Camera& camera) {
        Stopwatch watch;
        renderer->render(camera);
        return StageTimes{finished(watch)};
    };
    return {"lit picture, 16 samples on edges, GPU, read back", {"picture"}, true, {}, frame};
}

FrameMethod lit_on_processor(const FrameSubject& subject)
{
    auto frame = [&subject](const Camera& camera) {
        Stopwatch watch;
        shade(seen_scene(subject.model, subject.rays), camera);
        return StageTimes{1e3 * watch.lap()};
    };
    return {"lit picture, 16 samples on edges, processor", {"picture"}, true, {}, frame};
}

} // namespace

FrameSubject::FrameSubject(const Shape& shape) : bounds(shape.mesh.bounds()), model(model_of(shape)), rays(build_ray_scene(model)) {}
FrameSubject::FrameSubject(const std::string& name, std::size_t triangles) : FrameSubject(shape_of(name, triangles)) {}

std::vector<FrameMethod> frame_methods(const FrameSubject& subject)
{
    std::vector<FrameMethod> methods;
    methods.push_back(strokes(subject, "M3, strokes, processor", {LineType::suggestive}, {78, 44, 27, 6, 4}));
    methods.push_back(strokes(subject, "M2 + M3, strokes, processor", {LineType::mesh_contour, LineType::suggestive}, {43, 19, 10, 3, 2}));
    methods.push_back(strokes(subject, "M1 + M3, strokes, processor", {LineType::contour, LineType::suggestive}, {65, 27, 16, 5, 3}));
    methods.push_back(strokes(subject, "M1 + M3 + M4, strokes, processor", {LineType::contour, LineType::suggestive, LineType::highlight}, {62, 24, 13, 4, 2}));
    methods.push_back(stochastic(subject));
    methods.push_back(segments(subject, "M1 + M3, segments, GPU", {65, 27, 16, 5, 3}));
    const auto surface = std::make_shared<gpu::SurfaceRenderer>(subject.model);
    ShaderLineOptions lines;
    lines.feature_size = model_feature_size(subject.model, LineOptions().feature_size);
    lines.method = ShaderMethod::texture;
    methods.push_back(shader(surface, "M6 texture", lines, {}));
    lines.method = ShaderMethod::width;
    methods.push_back(shader(surface, "M7 vertex and fragment shader", lines, {130, 0, 0, 0, 24}));
    const auto fields = std::make_shared<gpu::FieldRenderer>(subject.model);
    ImageLineOptions options;
    options.method = ImageMethod::threshold;
    methods.push_back(filter(fields, "M8 threshold", options, {126, 104, 74, 22, 31}));
    options.method = ImageMethod::depth_raw;
    methods.push_back(filter(fields, "M9 Sobel on depth", options, {135, 113, 81, 25, 34}));
    options.method = ImageMethod::depth;
    methods.push_back(filter(fields, "M9 linear, normals, ids", options, {}));
    const std::array<int, 5> valleys[] = {{81, 65, 50, 22, 29}, {75, 61, 45, 21, 28}, {61, 56, 43, 20, 26}, {45, 40, 36, 18, 22}};
    for (int k = 0; k < 4; ++k) {
        options.method = ImageMethod::valley_printed;
        options.radius = std::array{2, 3, 5, 10}[std::size_t(k)];
        methods.push_back(filter(fields, fmt::format("M10 valleys, r = {}", options.radius), options, valleys[k]));
    }
    methods.push_back(lit_on_gpu(subject));
    methods.push_back(lit_on_processor(subject));
    return methods;
}

std::vector<Camera> turning_cameras(const Bounds& bounds, int pixels, int steps)
{
    const dvec3 centre = bounds.centre(), half = 0.5 * (bounds.high - bounds.low);
    Camera front;
    front.size = ivec2(pixels);
    const double distance = half.z + std::max(half.x, half.y) / std::tan(0.5 * front.fov_degrees * std::numbers::pi / 180);
    std::vector<Camera> cameras;
    for (int axis = 0; axis < 3; ++axis)
        for (int step = 0; step < steps; ++step) {
            dvec3 about(0);
            about[axis] = 1;
            // The object turns one way where the camera goes the other.
            const dmat4 turn = glm::rotate(dmat4(1), -2 * std::numbers::pi * step / steps, about);
            Camera& camera = cameras.emplace_back(front);
            camera.look = centre;
            camera.eye = centre + dvec3(turn * dvec4(0, 0, distance, 0));
            camera.up = dvec3(turn * dvec4(0, 1, 0, 0));
        }
    return cameras;
}
