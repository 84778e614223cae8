#include "limn/lines/coherence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace limn {
namespace {

constexpr double most_samples = 4096; ///< of one piece; more than any picture has pixels across is not needed

/// A short piece of line with the ink on it, about one pixel of length.
struct Sample {
    dvec2 pixel;     ///< its middle
    dvec2 slid;      ///< where the middle is expected in the next frame
    dvec2 half;      ///< from the middle to its end
    double ink;      ///< ink times length, px
};

/// A stroke as another frame's camera would see it.
/// @param slid  where its points are expected; empty: where they are
std::vector<Sample> carried(const Stroke& stroke, const Camera& camera, std::span<const dvec3> slid = {})
{
    std::vector<Sample> samples;
    const std::size_t n = stroke.world.size(), pieces = stroke.closed ? n : n - 1;
    for (std::size_t i = 0; n > 1 && i < pieces; ++i) {
        const std::size_t j = (i + 1) % n;
        const Projected a = camera.project(stroke.world[i]), b = camera.project(stroke.world[j]);
        const double length = glm::distance(a.pixel, b.pixel);
        if (!(length > 0) || a.depth <= 0 || b.depth <= 0)
            continue;
        const dvec2 slid_a = slid.empty() ? a.pixel : camera.project(slid[i]).pixel, slid_b = slid.empty() ? b.pixel : camera.project(slid[j]).pixel;
        // A piece that nearly touches the eye's plane may project to any length.
        const int count = int(std::ceil(std::min(length, most_samples)));
        for (int k = 0; k < count; ++k) {
            const double t = (k + 0.5) / count, ink = glm::mix(double(stroke.ink[i]), double(stroke.ink[j]), t);
            samples.push_back({glm::mix(a.pixel, b.pixel, t), glm::mix(slid_a, slid_b, t), (b.pixel - a.pixel) / (2.0 * count), ink * length / count});
        }
    }
    return samples;
}

/// Distances to short pieces of line within a radius: pieces sorted by their middles into square cells of that size.
class LineGrid {
public:
    LineGrid(const std::vector<std::vector<Sample>>& strokes, double radius) : radius_(radius)
    {
        for (const std::vector<Sample>& samples : strokes)
            for (const Sample& s : samples)
                grow(s.pixel);
        if (!(low_.x <= high_.x))
            return;
        width_ = cell(high_).x + 1;
        cells_.resize(std::size_t(width_) * std::size_t(cell(high_).y + 1));
        for (const std::vector<Sample>& samples : strokes)
            for (const Sample& s : samples)
                cells_[index(cell(s.pixel))].push_back({s.pixel, s.half});
    }

    double radius() const { return radius_; }

    /// Infinity where no line lies within the radius.
    double distance(const dvec2& p) const
    {
        double best = radius_ * radius_;
        bool found = false;
        const ivec2 centre = cell(p), last = ivec2(width_, width_ > 0 ? int(cells_.size() / std::size_t(width_)) : 0) - 1;
        for (int y = std::max(0, centre.y - 1); y <= std::min(last.y, centre.y + 1); ++y)
            for (int x = std::max(0, centre.x - 1); x <= std::min(last.x, centre.x + 1); ++x)
                for (const Piece& piece : cells_[index({x, y})])
                    if (const double d = piece.squared_distance(p); d <= best) {
                        best = d;
                        found = true;
                    }
        return found ? std::sqrt(best) : std::numeric_limits<double>::infinity();
    }

private:
    struct Piece {
        dvec2 middle, half;
        double squared_distance(const dvec2& p) const
        {
            const double t = glm::clamp(glm::dot(p - middle, half) / glm::dot(half, half), -1.0, 1.0);
            const dvec2 d = p - middle - t * half;
            return glm::dot(d, d);
        }
    };
    void grow(const dvec2& p)
    {
        low_ = glm::min(low_, p);
        high_ = glm::max(high_, p);
    }
    ivec2 cell(const dvec2& p) const { return ivec2(glm::clamp(glm::floor((p - low_) / radius_), dvec2(-2), dvec2(1e6))); }
    std::size_t index(ivec2 c) const { return std::size_t(c.y) * std::size_t(width_) + std::size_t(c.x); }

    double radius_;
    dvec2 low_ = dvec2(std::numeric_limits<double>::infinity()), high_ = -low_;
    int width_ = 0;
    std::vector<std::vector<Piece>> cells_;
};

using Slide = decltype(CoherenceOptions::slide);

/// Where the points of a stroke are expected when the camera has moved.
std::vector<dvec3> slid_points(const Stroke& stroke, const Camera& from, const Camera& to, const Slide& slide)
{
    std::vector<dvec3> points = stroke.world;
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] += slide(stroke, i, from, to);
    return points;
}

/// The visible strokes of a frame as a camera sees them.
std::vector<std::vector<Sample>> carried(const Drawing& frame, const Camera& camera, const Slide& slide = {})
{
    std::vector<std::vector<Sample>> strokes;
    for (const Stroke& stroke : frame.strokes)
        if (stroke.visible)
            strokes.push_back(slide ? carried(stroke, camera, slid_points(stroke, frame.camera, camera, slide)) : carried(stroke, camera));
    return strokes;
}

double ink_of(const std::vector<std::vector<Sample>>& strokes)
{
    double sum = 0;
    for (const std::vector<Sample>& samples : strokes)
        for (const Sample& s : samples)
            sum += s.ink;
    return sum;
}

/// Ink within the tolerance of other lines, and its mean distance from them before and after it slides.
struct Match {
    double lasting = 0, moved = 0, unpredicted = 0, all = 0;
    void add(const std::vector<Sample>& samples, const LineGrid& lines)
    {
        for (const Sample& s : samples) {
            const double distance = lines.distance(s.pixel);
            all += s.ink;
            if (std::isinf(distance))
                continue;
            lasting += s.ink;
            moved += s.ink * distance;
            unpredicted += s.ink * std::min(lines.distance(s.slid), lines.radius());
        }
    }
};

/// True if most of a stroke has lines near it in another frame.
bool lives_in(const Stroke& stroke, const Drawing& other, const LineGrid& lines)
{
    Match match;
    match.add(carried(stroke, other.camera), lines);
    return match.lasting > 0.5 * match.all;
}

bool is_seen(const Stroke& stroke, float least_ink)
{
    float sum = 0;
    for (const float ink : stroke.ink)
        sum += ink;
    return stroke.visible && sum >= least_ink * float(stroke.ink.size());
}

} // namespace

Coherence measure_coherence(std::span<const Drawing> frames, const CoherenceOptions& options)
{
    Coherence result;
    std::vector<LineGrid> lines;
    double sum = 0, squares = 0;
    for (const Drawing& frame : frames) {
        const auto strokes = carried(frame, frame.camera);
        const double ink = ink_of(strokes);
        sum += ink;
        squares += ink * ink;
        lines.emplace_back(strokes, options.tolerance);
        for (const Stroke& stroke : frame.strokes)
            result.strokes += is_seen(stroke, options.least_ink);
    }
    Match forward, backward;
    for (std::size_t t = 0; t + 1 < frames.size(); ++t) {
        const auto old = carried(frames[t], frames[t + 1].camera, options.slide);
        const LineGrid old_lines(old, options.tolerance);
        for (const auto& samples : old)
            forward.add(samples, lines[t + 1]);
        for (const auto& samples : carried(frames[t + 1], frames[t + 1].camera))
            backward.add(samples, old_lines);
    }
    for (std::size_t t = 1; t + 2 < frames.size(); ++t)
        for (const Stroke& stroke : frames[t].strokes)
            if (is_seen(stroke, options.least_ink) && !lives_in(stroke, frames[t - 1], lines[t - 1])
                && !(lives_in(stroke, frames[t + 1], lines[t + 1]) && lives_in(stroke, frames[t + 2], lines[t + 2])))
                ++result.micro_strokes;
    const double n = double(frames.size());
    if (frames.empty() || !(sum > 0))
        return result;
    const double all = forward.all + backward.all;
    result.flicker = all > 0 ? 1 - (forward.lasting + backward.lasting) / all : 0;
    result.displacement = forward.lasting > 0 ? forward.moved / forward.lasting : 0;
    result.unpredicted = forward.lasting > 0 ? forward.unpredicted / forward.lasting : 0;
    result.ink_variation = std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n))) / (sum / n);
    result.strokes /= n;
    result.micro_strokes /= std::max(1.0, n - 3);
    return result;
}

} // namespace limn
