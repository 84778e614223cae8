#include "limn/lines/draw.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "limn/base/error.h"
#include "limn/drawing/simplify.h"
#include "limn/lines/apparent.h"
#include "limn/lines/clip.h"
#include "limn/lines/cluster_extract.h"
#include "limn/lines/contour.h"
#include "limn/lines/inked_edges.h"
#include "limn/lines/inside.h"
#include "limn/lines/mesh_contour.h"
#include "limn/lines/outline.h"
#include "limn/lines/short_chains.h"
#include "limn/lines/stochastic.h"
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

/// The segments of one type.
struct TypedLines {
    LineType type;
    VisibilityRule rule;
    std::vector<Segment> segments;
};

/// Lines inside the shape that show too little ink to be read as a line. What bounds the shape is never left out.
bool is_speckle(const Stroke& stroke, const LineOptions& options)
{
    switch (stroke.type) {
    case LineType::suggestive:
    case LineType::highlight:
    case LineType::ridge:
    case LineType::valley:
    case LineType::apparent:
        return ink_in_picture(stroke) < options.min_length;
    default:
        return false;
    }
}

SuggestiveOptions suggestive_options(const LineOptions& options, const LineFeatures& features, bool highlight)
{
    SuggestiveOptions result;
    result.feature_size = features.feature_size;
    result.limit = float(highlight ? options.highlight_limit : options.suggestive_limit);
    result.fade = float(options.fade);
    result.speed_limit = float(options.speed_limit);
    result.highlight = highlight;
    return result;
}

ApparentOptions apparent_options(const LineOptions& options, const LineFeatures& features)
{
    ApparentOptions result;
    result.feature_size = features.feature_size;
    result.limit = float(options.apparent_limit);
    result.fade = float(options.fade);
    return result;
}

/// Those from random faces.
ClusterLines extract_view_lines_stochastic(const LineModel& model, const View& view, const LineFeatures& features, const LineOptions& options)
{
    const StochasticOptions sampling = {options.sample_fraction, options.discovery};
    ClusterLines lines;
    lines.contours = draw_contours_stochastic(model, view, sampling, options.seed);
    append_crease_outlines(model, view, lines.contours);
    const auto suggestive = [&](bool highlight) {
        return draw_suggestive_stochastic(model, view, features.suggestive, suggestive_options(options, features, highlight), sampling, options.seed);
    };
    if (options.has(LineType::suggestive))
        lines.suggestive = suggestive(false);
    if (options.has(LineType::highlight))
        lines.highlights = suggestive(true);
    return lines;
}

/// The lines that depend on the view and are found face by face. Contours are always among them, since they hide the others.
ClusterLines extract_view_lines(const LineModel& model, const View& view, std::span<const float> facing, const LineFeatures& features,
                                const LineOptions& options, ClusterHistory* history)
{
    if (options.method == ExtractMethod::stochastic)
        return extract_view_lines_stochastic(model, view, features, options);
    const bool contours_only = !options.has(LineType::suggestive) && !options.has(LineType::highlight);
    const SuggestiveOptions suggestive = suggestive_options(options, features, false), highlights = suggestive_options(options, features, true);
    if (features.clusters) {
        ClusterRequest request;
        request.suggestive = options.has(LineType::suggestive) ? &suggestive : nullptr;
        request.highlights = options.has(LineType::highlight) ? &highlights : nullptr;
        return extract_from_clusters(model, *features.clusters, view, request, history);
    }
    ClusterLines lines;
    lines.contours = extract_contours(model, facing);
    if (contours_only)
        return lines;
    const std::vector<std::uint8_t> codes = view_codes(model, view);
    if (options.has(LineType::suggestive))
        lines.suggestive = extract_suggestive(model, view, codes, suggestive, &features.suggestive);
    if (options.has(LineType::highlight))
        lines.highlights = extract_suggestive(model, view, codes, highlights, &features.suggestive);
    return lines;
}

/// Everything but contours.
std::vector<TypedLines> collect_other_lines(const LineModel& model, const View& view, const LineFeatures& features, const LineOptions& options,
                                            ClusterLines& found)
{
    std::vector<TypedLines> lines;
    const auto add = [&](LineType type, VisibilityRule rule, auto&& extract) {
        if (options.has(type))
            lines.push_back({type, rule, extract()});
    };
    const auto suggestive = [&](bool highlight) {
        const SuggestiveOptions wanted = suggestive_options(options, features, highlight);
        std::vector<Segment> segments = std::move(highlight ? found.highlights : found.suggestive);
        if (wanted.limit > 0) // a line that is not longer than a feature is speckle
            (wanted.fade > 0 ? fade_short_chains : drop_short_chains)(segments, 0.75 * double(features.feature_size));
        return segments;
    };
    add(LineType::highlight, VisibilityRule::surface, [&] { return suggestive(true); });
    add(LineType::valley, VisibilityRule::surface, [&] { return features.valleys; });
    add(LineType::ridge, VisibilityRule::surface, [&] { return features.ridges; });
    add(LineType::apparent, VisibilityRule::surface, [&] { return extract_apparent_ridges(model, view, apparent_options(options, features)); });
    add(LineType::suggestive, VisibilityRule::surface, [&] { return suggestive(false); });
    add(LineType::crease, VisibilityRule::edge, [&] { return features.creases; });
    add(LineType::border, VisibilityRule::edge, [&] { return features.borders; });
    add(LineType::mesh_contour, VisibilityRule::edge, [&] { return extract_mesh_contours(model, view); });
    return lines;
}

/// Borders hide what lies behind the face that they end.
void add_border_occluders(const ViewContext& c, std::span<const Segment> borders, std::vector<Occluder>& occluders)
{
    for (const Segment& s : borders) {
        const dvec3 a = c.projector.project(s.a), b = c.projector.project(s.b);
        if (!(std::min(a.z, b.z) > 0 || c.projector.orthographic))
            continue;
        const uvec3& t = c.model.faces[s.face];
        const dvec3 inner = c.projector.project((c.model.positions[t.x] + c.model.positions[t.y] + c.model.positions[t.z]) / 3.0f);
        dvec2 outward = {b.y - a.y, a.x - b.x};
        if (glm::dot(outward, dvec2(inner) - dvec2(a)) > 0)
            outward = -outward;
        occluders.push_back({a, b, outward, s.edge_a, s.edge_b});
    }
}

void count(DrawReport& report, const Stroke& stroke)
{
    DrawReport::PerType& type = report.types[std::size_t(stroke.type)];
    type.strokes += stroke.visible;
    (stroke.visible ? type.visible_pixels : type.hidden_pixels) += length_in_picture(stroke);
}

/// Draws the lines of a model whose closed components all have the eye outside.
Drawing draw_from_outside(const LineModel& model, const RayScene& rays, const LineFeatures& features, const Camera& camera,
                          const LineOptions& options, DrawReport* report, ClusterHistory* history)
{
    DrawReport unread;
    DrawReport& measured = report ? *report : unread;
    measured = {};
    Stopwatch watch;
    const View view = model.view(camera);
    const Projector projector(model, camera);
    const std::vector<float> facing = facing_of_vertices(model, view);
    const ViewContext context = {model, rays, view, projector, facing};
    ClusterLines found = extract_view_lines(model, view, facing, features, options, history);
    TypedLines contours = {LineType::contour, VisibilityRule::contour, std::move(found.contours)};
    std::vector<TypedLines> others = collect_other_lines(model, view, features, options, found);
    measured.extract_seconds = watch.lap();

    Drawing drawing;
    drawing.camera = camera;
    const auto add_strokes = [&](const TypedLines& lines, const Chains& chains, const ChainElements& decided) {
        StrokeOptions wanted;
        wanted.type = lines.type;
        wanted.size = camera.size;
        wanted.keep_hidden = options.hidden != Hidden::remove;
        std::vector<Stroke> strokes = make_strokes(context, lines.segments, chains, decided, wanted);
        measured.types[std::size_t(lines.type)].segments = lines.segments.size();
        for (const Stroke& stroke : strokes) {
            if (is_speckle(stroke, options))
                continue;
            count(measured, stroke);
            drawing.strokes.push_back(simplify(stroke, {options.tolerance}));
        }
        measured.chain_seconds += watch.lap();
    };

    clip_to_near_plane(contours.segments, projector);
    const Chains chains = chain_segments(contours.segments);
    const LinkCurvature curvature = curvature_along_contours(context, contours.segments, chains);
    measured.chain_seconds += watch.lap();
    std::vector<Occluder> hiding = occluders_of_contours(context, contours.segments, chains, curvature);
    add_border_occluders(context, features.borders, hiding);
    const OccluderGrid occluders(std::move(hiding), camera);
    std::vector<InkedPart> inked;
    if (options.has(LineType::contour)) {
        const ChainElements decided = find_visibility(context, contours.rule, contours.segments, chains, curvature, occluders);
        inked = find_inked_parts(model, contours.segments, decided);
        measured.visibility_seconds += watch.lap();
        add_strokes(contours, chains, decided);
    }
    for (TypedLines& lines : others) {
        clip_to_near_plane(lines.segments, projector);
        const Chains line_chains = chain_segments(lines.segments);
        measured.chain_seconds += watch.lap();
        ChainElements decided = find_visibility(context, lines.rule, lines.segments, line_chains, {}, occluders);
        if (lines.rule == VisibilityRule::edge)
            mark_inked(model, inked, lines.segments, decided);
        measured.visibility_seconds += watch.lap();
        add_strokes(lines, line_chains, decided);
    }
    if (options.has(LineType::outline))
        for (Stroke& stroke : extract_outline(model, rays, camera)) {
            measured.types[std::size_t(LineType::outline)].segments += stroke.points.size();
            count(measured, stroke);
            drawing.strokes.push_back(std::move(stroke));
        }
    std::stable_sort(drawing.strokes.begin(), drawing.strokes.end(), [](const Stroke& a, const Stroke& b) { return a.type < b.type; });
    measured.chain_seconds += watch.lap();
    return drawing;
}

} // namespace

RayScene build_ray_scene(const LineModel& model)
{
    const RayTriangles all = {{model.positions.data(), model.vertex_count()}, model.faces};
    return RayScene({&all, 1});
}

Drawing draw_lines(const LineModel& model, const RayScene& rays, const LineFeatures& features, const Camera& camera,
                   const LineOptions& options, DrawReport* report, ClusterHistory* history)
{
    if (model.normals.empty())
        throw Error::Input("a line drawing needs the normals of the surface");
    const View view = model.view(camera);
    if (const std::vector<std::uint32_t> around = components_around(model, rays, view); !around.empty()) {
        const LineModel inside = turned_inside_out(model, around);
        const RayScene inside_rays = build_ray_scene(inside);
        Drawing drawing = draw_from_outside(inside, inside_rays, find_line_features(inside, options), camera, options, report, nullptr);
        if (report)
            report->camera_inside = true;
        return drawing;
    }
    return draw_from_outside(model, rays, features, camera, options, report, history);
}

Drawing draw_lines(const LineModel& model, const RayScene& rays, const Camera& camera, const LineOptions& options, DrawReport* report)
{
    return draw_lines(model, rays, find_line_features(model, options), camera, options, report);
}

Drawing draw(const Mesh& mesh, const Surface& surface, const Camera& camera, const LineOptions& options)
{
    const PlacedSurface placed = {&mesh, &surface};
    const LineModel model = build_line_model({&placed, 1});
    return draw_lines(model, build_ray_scene(model), camera, options);
}

} // namespace limn
