#include "limn/lines/draw.h"

#include <chrono>

#include "limn/lines/clip.h"
#include "limn/lines/contour.h"
#include "limn/lines/strokes.h"
#include "limn/lines/visibility.h"

namespace limn {
namespace {

class Stopwatch {
public:
    /// Seconds since the last call.
    double lap()
    {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// The segments of one type, chained.
struct ChainedLines {
    LineType type;
    VisibilityRule rule;
    std::vector<Segment> segments;
    Chains chains;
};

ChainedLines chained(LineType type, VisibilityRule rule, std::vector<Segment> segments, const Projector& projector)
{
    clip_to_near_plane(segments, projector);
    Chains chains = chain_segments(segments);
    return {type, rule, std::move(segments), std::move(chains)};
}

void count(DrawReport& report, const Stroke& stroke)
{
    DrawReport::PerType& type = report.types[std::size_t(stroke.type)];
    type.strokes += stroke.visible;
    (stroke.visible ? type.visible_pixels : type.hidden_pixels) += length_in_picture(stroke);
}

} // namespace

RayScene build_ray_scene(const LineModel& model)
{
    const RayTriangles all = {{model.positions.data(), model.vertex_count()}, model.faces};
    return RayScene({&all, 1});
}

Drawing draw_lines(const LineModel& model, const RayScene& rays, const Camera& camera, const LineOptions& options, DrawReport* report)
{
    DrawReport unread;
    DrawReport& measured = report ? *report : unread;
    measured = {};
    Stopwatch watch;

    const View view = model.view(camera);
    const Projector projector(model, camera);
    const std::vector<float> facing = facing_of_vertices(model, view);
    const ViewContext context = {model, rays, view, projector, facing};
    std::vector<Segment> contour_segments = extract_contours(model, facing);
    measured.extract_seconds = watch.lap();

    const ChainedLines contours = chained(LineType::contour, VisibilityRule::contour, std::move(contour_segments), projector);
    const LinkCurvature curvature = curvature_along_contours(context, contours.segments, contours.chains);
    measured.chain_seconds = watch.lap();
    const OccluderGrid occluders(occluders_of_contours(context, contours.segments, contours.chains, curvature), camera);
    const ChainElements decided = find_visibility(context, contours.rule, contours.segments, contours.chains, curvature, occluders);
    measured.visibility_seconds = watch.lap();

    Drawing drawing;
    drawing.camera = camera;
    if (options.has(LineType::contour)) {
        StrokeOptions stroke_options;
        stroke_options.type = LineType::contour;
        stroke_options.size = camera.size;
        stroke_options.keep_hidden = options.hidden != Hidden::remove;
        drawing.strokes = make_strokes(context, contours.segments, contours.chains, decided, stroke_options);
        measured.types[std::size_t(LineType::contour)].segments = contours.segments.size();
        for (const Stroke& stroke : drawing.strokes)
            count(measured, stroke);
    }
    measured.chain_seconds += watch.lap();
    return drawing;
}

Drawing draw(const Mesh& mesh, const Surface& surface, const Camera& camera, const LineOptions& options)
{
    const PlacedSurface placed = {&mesh, &surface};
    const LineModel model = build_line_model({&placed, 1});
    return draw_lines(model, build_ray_scene(model), camera, options);
}

} // namespace limn
