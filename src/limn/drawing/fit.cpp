#include "limn/drawing/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace limn {
namespace {

/// The given line, closed ones with their first point once more at the end.
using Points = std::vector<dvec2>;

dvec2 unit(const dvec2& d)
{
    const double length = glm::length(d);
    return length > 0 ? d / length : dvec2(0);
}

/// Tangent at b of the parabola through a, b, c: the shorter neighbour counts more.
dvec2 tangent_between(const dvec2& a, const dvec2& b, const dvec2& c)
{
    const dvec2 in = b - a, out = c - b;
    const double in2 = glm::dot(in, in), out2 = glm::dot(out, out);
    if (in2 == 0 || out2 == 0)
        return unit(c - a);
    const dvec2 t = unit(in / in2 + out / out2);
    return t == dvec2(0) ? unit(out) : t;
}

bool turns_sharply(const dvec2& a, const dvec2& b, const dvec2& c, double corner_cosine)
{
    return glm::dot(unit(b - a), unit(c - b)) < corner_cosine;
}

struct Range {
    std::size_t first, last;
};

struct Tangents {
    dvec2 start, end; ///< unit, both pointing along the line
};

struct Cubic {
    std::array<dvec2, 4> p;

    dvec2 at(double t) const
    {
        const double s = 1 - t;
        return s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3];
    }
    dvec2 first_derivative(double t) const
    {
        const double s = 1 - t;
        return 3.0 * (s * s * (p[1] - p[0]) + 2 * s * t * (p[2] - p[1]) + t * t * (p[3] - p[2]));
    }
    dvec2 second_derivative(double t) const
    {
        return 6.0 * ((1 - t) * (p[2] - 2.0 * p[1] + p[0]) + t * (p[3] - 2.0 * p[2] + p[1]));
    }
};

double distance_to_piece(const dvec2& p, const dvec2& a, const dvec2& b)
{
    const dvec2 along = b - a;
    const double length2 = glm::dot(along, along);
    const double t = length2 > 0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
    return glm::length(p - a - t * along);
}

/// Fits one smooth piece of the line: the points `first` to `last`, end tangents given or derived.
class PieceFitter {
public:
    PieceFitter(const Points& points, Range piece, Tangents ends, double tolerance)
        : points_(points), piece_(piece), ends_(ends), tolerance_(0.95 * tolerance) // the rest is for what lies between samples
    {
    }

    void append_to(std::vector<CurveSpan>& spans)
    {
        std::vector<Range> open = {piece_};
        while (!open.empty()) {
            const Range range = open.back();
            open.pop_back();
            if (const std::size_t split = fit(range)) {
                open.push_back({split, range.last});
                open.push_back({range.first, split});
                continue;
            }
            spans.push_back(span_to(range.last));
        }
    }

private:
    dvec2 tangent_at(std::size_t i) const
    {
        if (i == piece_.first)
            return ends_.start;
        if (i == piece_.last)
            return ends_.end;
        return tangent_between(points_[i - 1], points_[i], points_[i + 1]);
    }

    /// Fits `curve_` to the range. Returns 0, or the point to split at where it cannot be done within the tolerance.
    std::size_t fit(Range range)
    {
        const Tangents tangents = {tangent_at(range.first), tangent_at(range.last)};
        if (range.last == range.first + 1) {
            join_two(range, tangents);
            return 0;
        }
        set_parameters_by_chord(range);
        constexpr int newton_rounds = 3;
        Worst worst;
        for (int round = 0; round <= newton_rounds; ++round) {
            least_squares(range, tangents);
            worst = measure(range);
            if (worst.error <= tolerance_)
                return 0;
            if (worst.error > 8 * tolerance_)
                break; // no parameters will mend this
            improve_parameters(range);
        }
        return worst.index;
    }

    /// Two points and their tangents; handles shrink until the curve keeps to the straight line between them.
    void join_two(Range range, const Tangents& tangents)
    {
        const dvec2 a = points_[range.first], b = points_[range.last];
        double handle = glm::length(b - a) / 3;
        parameters_ = {0, 1};
        for (int round = 0; round < 8; ++round, handle *= 0.6) {
            curve_.p = {a, a + handle * tangents.start, b - handle * tangents.end, b};
            if (measure(range).error <= tolerance_)
                return;
        }
        curve_.p = {a, glm::mix(a, b, 1.0 / 3), glm::mix(a, b, 2.0 / 3), b};
    }

    void set_parameters_by_chord(Range range)
    {
        parameters_.assign(range.last - range.first + 1, 0);
        for (std::size_t k = 1; k < parameters_.size(); ++k)
            parameters_[k] = parameters_[k - 1] + glm::length(points_[range.first + k] - points_[range.first + k - 1]);
        const double length = parameters_.back();
        for (double& u : parameters_)
            u = length > 0 ? u / length : 0;
    }

    /// The handle lengths that bring the curve nearest to the points at their parameters.
    void least_squares(Range range, const Tangents& tangents)
    {
        const dvec2 a = points_[range.first], b = points_[range.last];
        double c00 = 0, c01 = 0, c11 = 0, x0 = 0, x1 = 0;
        for (std::size_t k = 0; k < parameters_.size(); ++k) {
            const double u = parameters_[k], s = 1 - u;
            const dvec2 a0 = tangents.start * (3 * s * s * u), a1 = -tangents.end * (3 * s * u * u);
            const dvec2 rest = points_[range.first + k] - a * (s * s * s + 3 * s * s * u) - b * (u * u * u + 3 * s * u * u);
            c00 += glm::dot(a0, a0);
            c01 += glm::dot(a0, a1);
            c11 += glm::dot(a1, a1);
            x0 += glm::dot(a0, rest);
            x1 += glm::dot(a1, rest);
        }
        const double determinant = c00 * c11 - c01 * c01, length = glm::length(b - a);
        double start = length / 3, end = length / 3;
        if (determinant > 1e-12 * c00 * c11) {
            start = (x0 * c11 - x1 * c01) / determinant;
            end = (c00 * x1 - c01 * x0) / determinant;
        }
        if (!(start > 1e-3 * length) || !(end > 1e-3 * length)) // handles that point backwards make loops
            start = end = length / 3;
        curve_.p = {a, a + start * tangents.start, b - end * tangents.end, b};
    }

    /// One Newton step of every parameter towards the nearest point of the curve; parameters stay in order.
    void improve_parameters(Range range)
    {
        for (std::size_t k = 1; k + 1 < parameters_.size(); ++k) {
            const double u = parameters_[k];
            const dvec2 d = curve_.at(u) - points_[range.first + k], d1 = curve_.first_derivative(u), d2 = curve_.second_derivative(u);
            const double slope = glm::dot(d1, d1) + glm::dot(d, d2);
            if (slope > 0)
                parameters_[k] = std::clamp(u - glm::dot(d, d1) / slope, parameters_[k - 1], 1.0);
        }
    }

    struct Worst {
        std::size_t index = 0; ///< an inner point of the range
        double error = 0;
    };

    /// The largest distance of the points from the curve and of the curve from the line between the points.
    Worst measure(Range range) const
    {
        const int samples = std::max(3, 24 / int(parameters_.size() - 1)); // between two points
        Worst worst;
        const auto see = [&](std::size_t index, double error) {
            if (error > worst.error)
                worst = {std::clamp(index, range.first + 1, std::max(range.last, range.first + 2) - 1), error};
        };
        for (std::size_t k = 0; k + 1 < parameters_.size(); ++k) {
            const std::size_t i = range.first + k;
            if (k > 0)
                see(i, glm::length(curve_.at(parameters_[k]) - points_[i]));
            for (int sample = 1; sample <= samples; ++sample) {
                const double part = double(sample) / (samples + 1);
                see(part < 0.5 ? i : i + 1, distance_to_line(curve_.at(glm::mix(parameters_[k], parameters_[k + 1], part)), i, range));
            }
        }
        return worst;
    }

    /// Distance to the line near the piece from point i to the next.
    double distance_to_line(const dvec2& p, std::size_t i, Range range) const
    {
        double distance = distance_to_piece(p, points_[i], points_[i + 1]);
        if (i > range.first)
            distance = std::min(distance, distance_to_piece(p, points_[i - 1], points_[i]));
        if (i + 1 < range.last)
            distance = std::min(distance, distance_to_piece(p, points_[i + 1], points_[i + 2]));
        return distance;
    }

    CurveSpan span_to(std::size_t last) const
    {
        constexpr double straight_within = 0.03; // px
        const auto& p = curve_.p;
        const bool straight = distance_to_piece(p[1], p[0], p[3]) < straight_within && distance_to_piece(p[2], p[0], p[3]) < straight_within;
        return {p[1], p[2], p[3], straight, std::uint32_t(last)};
    }

    const Points& points_;
    Range piece_;
    Tangents ends_;
    double tolerance_;
    std::vector<double> parameters_;
    Cubic curve_;
};

/// Where pieces meet: the ends, the corners and the breaks.
struct Knot {
    std::size_t index;
    bool corner;
};

std::vector<Knot> find_knots(const Points& points, bool closed, double corner_cosine, std::span<const std::uint32_t> breaks)
{
    const std::size_t n = points.size();
    const bool end_corner = !closed || turns_sharply(points[n - 2], points[0], points[1], corner_cosine);
    std::vector<Knot> knots = {{0, end_corner}};
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const bool corner = turns_sharply(points[i - 1], points[i], points[i + 1], corner_cosine);
        if (corner || std::binary_search(breaks.begin(), breaks.end(), std::uint32_t(i)))
            knots.push_back({i, corner});
    }
    knots.push_back({n - 1, end_corner});
    return knots;
}

/// The tangent at the free end of a piece, as if the circle through its first three points went on.
dvec2 free_tangent(const dvec2& end, const dvec2& next, const dvec2* after)
{
    const dvec2 d = unit(next - end);
    if (!after)
        return d;
    const dvec2 inner = tangent_between(end, next, *after);
    return unit(2 * glm::dot(inner, d) * d - inner);
}

Tangents piece_tangents(const Points& points, const Knot& from, const Knot& to)
{
    const std::size_t n = points.size(), a = from.index, b = to.index;
    const bool two = b == a + 1;
    Tangents tangents;
    tangents.start = from.corner ? free_tangent(points[a], points[a + 1], two ? nullptr : &points[a + 2])
                                 : tangent_between(points[a == 0 ? n - 2 : a - 1], points[a], points[a + 1]);
    tangents.end = to.corner ? -free_tangent(points[b], points[b - 1], two ? nullptr : &points[b - 2])
                             : tangent_between(points[b - 1], points[b], points[b == n - 1 ? 1 : b + 1]);
    if (two && from.corner && !to.corner) // a short piece bends only as its inner end says
        tangents.start = free_tangent(points[a], points[b], &points[b == n - 1 ? 1 : b + 1]);
    if (two && to.corner && !from.corner)
        tangents.end = -free_tangent(points[b], points[a], &points[a == 0 ? n - 2 : a - 1]);
    return tangents;
}

Points whole_line(std::span<const dvec2> points, bool closed)
{
    Points whole(points.begin(), points.end());
    if (closed)
        whole.push_back(points[0]);
    return whole;
}

} // namespace

std::vector<CurveSpan> fit_curve(std::span<const dvec2> points, bool closed, const FitOptions& options, std::span<const std::uint32_t> breaks)
{
    std::vector<CurveSpan> spans;
    if (points.size() < 2)
        return spans;
    const Points whole = whole_line(points, closed);
    const double corner_cosine = std::cos(glm::radians(options.corner_degrees));
    const std::vector<Knot> knots = find_knots(whole, closed, corner_cosine, breaks);
    for (std::size_t k = 0; k + 1 < knots.size(); ++k)
        PieceFitter(whole, {knots[k].index, knots[k + 1].index}, piece_tangents(whole, knots[k], knots[k + 1]), options.tolerance)
            .append_to(spans);
    if (closed)
        spans.back().last = 0;
    return spans;
}

std::vector<CurveSpan> straight_spans(std::span<const dvec2> points, bool closed)
{
    std::vector<CurveSpan> spans;
    if (points.size() < 2)
        return spans;
    const Points whole = whole_line(points, closed);
    for (std::size_t i = 1; i < whole.size(); ++i)
        spans.push_back({glm::mix(whole[i - 1], whole[i], 1.0 / 3), glm::mix(whole[i - 1], whole[i], 2.0 / 3), whole[i], true,
                         std::uint32_t(i % points.size())});
    return spans;
}

dvec2 point_on(const dvec2& start, const CurveSpan& span, double t)
{
    return Cubic{{start, span.control1, span.control2, span.end}}.at(t);
}

} // namespace limn
