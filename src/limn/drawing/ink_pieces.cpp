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

    void finish() { end_piece(); }

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

double length_of(const InkLine& line, const InkPiece& piece)
{
    double length = 0;
    for (std::uint32_t i = piece.first; i < piece.last; ++i)
        length += glm::length(line.points[i + 1] - line.points[i]);
    return length;
}

/// Joins a piece that is too short with the ones that follow it without a gap.
void join_short_pieces(InkLine& line, double shortest)
{
    std::vector<InkPiece> joined;
    double length = 0, amount = 0; // of the last joined piece; amount: ink times length
    const auto take = [&](const InkPiece& piece, double piece_length, double piece_amount) {
        joined.back().last = piece.last;
        length += piece_length;
        amount += piece_amount;
        joined.back().step = std::max(1, int(std::lround(amount / length)));
    };
    for (std::size_t k = 0; k < line.pieces.size(); ++k) {
        const InkPiece& piece = line.pieces[k];
        const bool is_last = k + 1 == line.pieces.size() || line.pieces[k + 1].first != piece.last;
        const double piece_length = length_of(line, piece), piece_amount = piece.step * piece_length;
        const bool follows = !joined.empty() && joined.back().last == piece.first;
        // A long piece takes up its forerunner only where that is very short: it would lend it its own ink.
        const bool too_short = length < (piece_length < shortest ? shortest : shortest / 2);
        if (follows && (too_short || joined.back().step == piece.step || (is_last && piece_length < shortest / 2))) {
            take(piece, piece_length, piece_amount);
            continue;
        }
        joined.push_back(piece);
        length = piece_length;
        amount = piece_amount;
    }
    line.pieces = std::move(joined);
}

/// Breaks for the curve: where a piece begins or ends inside of the line.
void set_breaks(InkLine& line)
{
    for (const InkPiece& piece : line.pieces)
        for (const std::uint32_t i : {piece.first, piece.last})
            if (i > 0 && i + 1 < line.points.size() && (line.breaks.empty() || line.breaks.back() < i))
                line.breaks.push_back(i);
}

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

InkLine split_by_ink(std::span<const dvec2> points, std::span<const float> ink, bool closed, double shortest)
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
    join_short_pieces(cutter.line, shortest);
    set_breaks(cutter.line);
    return std::move(cutter.line);
}

} // namespace limn
