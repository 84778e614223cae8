#include "limn/drawing/ink_pieces.h"

#include <algorithm>
#include <cmath>

namespace limn {
namespace {

/// How far ink may leave its step, in steps, before the step changes.
constexpr double hold = 0.75;

int nearest_step(double ink) { return std::clamp(int(std::lround(ink)), 0, ink_steps); }

/// Walks a line and cuts it where the step changes.
class Cutter {
public:
    explicit Cutter(int step) : step_(step) {}

    void start(const dvec2& point)
    {
        line.points = {point};
        begin_ = 0;
    }

    /// Goes on straight to `point`, whose ink (in steps) is `ink`, from the last one with `from_ink`.
    void go_to(const dvec2& point, double from_ink, double ink)
    {
        const dvec2 from = line.points.back();
        for (;;) {
            const int next = ink > step_ + hold && step_ < ink_steps ? step_ + 1 : ink < step_ - hold && step_ > 0 ? step_ - 1 : step_;
            if (next == step_)
                break;
            const double level = next > step_ ? step_ + hold : step_ - hold;
            const double t = ink != from_ink ? std::clamp((level - from_ink) / (ink - from_ink), 0.0, 1.0) : 0.0;
            cut_at(glm::mix(from, point, t));
            step_ = next;
        }
        add(point);
    }

    void finish()
    {
        end_piece();
        line.breaks.erase(std::remove_if(line.breaks.begin(), line.breaks.end(),
                                         [&](std::uint32_t i) { return i == 0 || i + 1 == line.points.size(); }),
                          line.breaks.end());
    }

    int step() const { return step_; }
    InkLine line;

private:
    void add(const dvec2& point)
    {
        if (point != line.points.back())
            line.points.push_back(point);
    }

    void cut_at(const dvec2& point)
    {
        add(point);
        end_piece();
        begin_ = std::uint32_t(line.points.size() - 1);
        if (line.breaks.empty() || line.breaks.back() != begin_)
            line.breaks.push_back(begin_);
    }

    void end_piece()
    {
        const auto last = std::uint32_t(line.points.size() - 1);
        if (step_ > 0 && last > begin_)
            line.pieces.push_back({step_, begin_, last});
    }

    int step_;
    std::uint32_t begin_ = 0;
};

InkLine whole(std::span<const dvec2> points, bool closed, int step)
{
    InkLine line;
    line.points.assign(points.begin(), points.end());
    line.closed = closed;
    if (step > 0 && points.size() > 1)
        line.pieces.push_back({step, 0, std::uint32_t(closed ? points.size() : points.size() - 1)});
    return line;
}

/// True when one step serves the whole line.
bool is_even(std::span<const float> ink, int step)
{
    return std::all_of(ink.begin(), ink.end(), [&](float value) { return std::abs(double(value) * ink_steps - step) <= hold; });
}

} // namespace

InkLine split_by_ink(std::span<const dvec2> points, std::span<const float> ink, bool closed)
{
    if (points.empty() || ink.empty())
        return whole(points, closed, ink_steps);
    const auto [low, high] = std::minmax_element(ink.begin(), ink.end());
    const int middle = nearest_step(0.5 * (double(*low) + double(*high)) * ink_steps);
    if (is_even(ink, middle))
        return whole(points, closed, middle);
    const std::size_t n = points.size();
    // A closed line is opened where its ink is lowest: there the joint is seen least.
    const std::size_t first = closed ? std::size_t(low - ink.begin()) : 0;
    const auto ink_at = [&](std::size_t i) { return double(ink[(first + i) % n]) * ink_steps; };
    Cutter cutter(nearest_step(ink_at(0)));
    cutter.start(points[first]);
    for (std::size_t i = 1; i < n + (closed ? 1 : 0); ++i)
        cutter.go_to(points[(first + i) % n], ink_at(i - 1), ink_at(i));
    cutter.finish();
    return std::move(cutter.line);
}

} // namespace limn
