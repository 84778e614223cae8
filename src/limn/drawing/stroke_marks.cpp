#include "limn/drawing/stroke_marks.h"

#include <algorithm>
#include <cmath>

#include "limn/drawing/ink_pieces.h"
#include "limn/drawing/outline.h"

namespace limn {
namespace {

/// The curve or polyline through points in pixels, with the end of a span at every break.
std::vector<CurveSpan> spans_through(std::span<const dvec2> points, bool closed, const Style& style, double tolerance,
                                     std::span<const std::uint32_t> breaks = {})
{
    if (!style.curves)
        return straight_spans(points, closed);
    FitOptions options;
    options.tolerance = tolerance;
    return fit_curve(points, closed, options, breaks);
}

Path path_on_page(const dvec2& start, std::span<const CurveSpan> spans, bool closed, const PageLayout& page)
{
    Path path;
    path.start = page.on_page(start);
    path.closed = closed;
    path.spans.reserve(spans.size());
    for (const CurveSpan& s : spans)
        path.spans.push_back({page.on_page(s.control1), page.on_page(s.control2), page.on_page(s.end), s.straight, s.last});
    return path;
}

/// The spans from point `first` to point `last` of an open line.
std::span<const CurveSpan> spans_between(std::span<const CurveSpan> spans, std::uint32_t first, std::uint32_t last)
{
    const auto after = [&](std::uint32_t point) {
        return std::partition_point(spans.begin(), spans.end(), [&](const CurveSpan& s) { return s.last <= point; });
    };
    return {after(first), after(last)};
}

/// A line followed closely: points on its curve with their ink and the way along it.
struct FineLine {
    std::vector<dvec2> points;
    std::vector<double> ink, way;
};

FineLine follow(const Stroke& stroke, const Style& style)
{
    const std::vector<CurveSpan> spans = spans_through(stroke.points, stroke.closed, style, style.curve_tolerance);
    const auto ink_at = [&](std::size_t i) { return i < stroke.ink.size() ? double(stroke.ink[i]) : 1.0; };
    FineLine fine = {{stroke.points[0]}, {ink_at(0)}, {0}};
    std::size_t from = 0; // given point at which the span starts
    for (const CurveSpan& span : spans) {
        const std::size_t to = span.last == 0 ? stroke.points.size() : span.last;
        const dvec2 start = fine.points.back();
        constexpr double step = 2; // px
        const double length = glm::length(span.control1 - start) + glm::length(span.control2 - span.control1) + glm::length(span.end - span.control2);
        const int steps = std::clamp(int(std::ceil(length / step)), 1, 1000);
        for (int k = 1; k <= steps; ++k) {
            const double t = double(k) / steps, at = double(from) + t * double(to - from);
            const std::size_t i = std::min(std::size_t(at), to - 1);
            fine.points.push_back(k == steps ? span.end : point_on(start, span, t));
            fine.ink.push_back(glm::mix(ink_at(i), ink_at((i + 1) % stroke.points.size()), at - double(i)));
            fine.way.push_back(fine.way.back() + glm::length(fine.points.back() - fine.points[fine.points.size() - 2]));
        }
        from = to;
    }
    if (stroke.closed && fine.points.size() > 1) {
        fine.points.pop_back();
        fine.ink.pop_back();
    }
    return fine;
}

/// How a pen swells over its first strokes: 0.15 at the tip, 1 from `taper` on.
double swell(double distance, double taper)
{
    if (taper <= 0 || distance >= taper)
        return 1;
    return 0.15 + 0.85 * std::sin(0.5 * M_PI * distance / taper);
}

} // namespace

std::vector<Mark> line_marks(const Stroke& stroke, bool reversed, const Style& style, const PageLayout& page)
{
    std::vector<dvec2> points = stroke.points;
    std::vector<float> ink = stroke.ink;
    if (reversed) {
        std::reverse(points.begin(), points.end());
        std::reverse(ink.begin(), ink.end());
    }
    constexpr double shortest_piece = 4; // px
    const InkLine line = split_by_ink(points, ink, stroke.closed, shortest_piece);
    const std::vector<CurveSpan> spans = spans_through(line.points, line.closed, style, style.curve_tolerance, line.breaks);
    std::vector<Mark> marks;
    for (const InkPiece& piece : line.pieces) {
        Mark mark;
        mark.opacity = double(piece.step) / ink_steps;
        mark.butt_caps = piece.step < ink_steps;
        const auto part = line.closed ? std::span<const CurveSpan>(spans) : spans_between(spans, piece.first, piece.last);
        mark.paths.push_back(path_on_page(line.points[piece.first], part, line.closed, page));
        marks.push_back(std::move(mark));
    }
    return marks;
}

std::vector<Mark> outline_marks(const Stroke& stroke, double width, const Style& style, const PageLayout& page)
{
    const FineLine fine = follow(stroke, style);
    const double half = 0.5 * width / page.scale, length = fine.way.back();
    const double taper = std::min(page.units(style.taper_mm) / page.scale, length / 2);
    std::vector<double> halves(fine.points.size());
    for (std::size_t i = 0; i < halves.size(); ++i) {
        const double free_end = stroke.closed ? taper : std::min(fine.way[i], length - fine.way[i]);
        halves[i] = half * std::clamp(fine.ink[i], 0.0, 1.0) * swell(free_end, taper);
    }
    Mark mark;
    constexpr double edge_tolerance = 0.1; // px: edges of a filled line show more than its middle
    for (const auto& ring : outline_rings(fine.points, halves, stroke.closed))
        if (const auto spans = spans_through(ring, true, style, edge_tolerance); !spans.empty())
            mark.paths.push_back(path_on_page(ring[0], spans, true, page));
    if (mark.paths.empty())
        return {};
    return {std::move(mark)};
}

Mark region_mark(const Region& region, const Style& style, const PageLayout& page)
{
    Mark mark;
    for (const auto& ring : region.rings)
        if (ring.size() >= 3)
            mark.paths.push_back(path_on_page(ring[0], spans_through(ring, true, style, style.curve_tolerance), true, page));
    return mark;
}

} // namespace limn
