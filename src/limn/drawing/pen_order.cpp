#include "limn/drawing/pen_order.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limn {
namespace {

/// An end of a line: 2 * line for its start, 2 * line + 1 for its end.
using End = std::uint32_t;

const dvec2& place(std::span<const PenLine> lines, End end) { return end & 1 ? lines[end / 2].end : lines[end / 2].start; }

/// Free ends sorted into square cells.
class EndGrid {
public:
    EndGrid(std::span<const PenLine> lines, std::span<const char> drawn) : lines_(lines)
    {
        std::vector<End> ends;
        dvec2 high(-std::numeric_limits<double>::infinity());
        low_ = -high;
        for (End e = 0; e < 2 * lines.size(); ++e) {
            if (drawn[e / 2])
                continue;
            ends.push_back(e);
            low_ = glm::min(low_, place(lines, e));
            high = glm::max(high, place(lines, e));
        }
        const dvec2 size = ends.empty() ? dvec2(1) : high - low_;
        const double area = std::max({size.x * size.y, size.x * size.x * 1e-4, size.y * size.y * 1e-4, 1e-12});
        cell_ = std::sqrt(area / double(std::max<std::size_t>(ends.size(), 1)));
        columns_ = int(size.x / cell_) + 1;
        rows_ = int(size.y / cell_) + 1;
        fill(ends);
    }

    /// The free end nearest to a place.
    End nearest(const dvec2& from, std::span<const char> drawn) const
    {
        const int column = int(std::clamp((from.x - low_.x) / cell_, 0.0, columns_ - 1.0));
        const int row = int(std::clamp((from.y - low_.y) / cell_, 0.0, rows_ - 1.0));
        Best best;
        for (int ring = 0; ring < std::max(columns_, rows_); ++ring) {
            // A cell of this ring is at least (ring - 1) cells away from where `from`, moved into the grid, lies.
            const double reach = std::max(0, ring - 1) * cell_;
            if (best.end != none && reach * reach > best.distance2)
                break;
            for (int y = row - ring; y <= row + ring; ++y) {
                const bool whole_row = y == row - ring || y == row + ring;
                for (int x = column - ring; x <= column + ring; x += whole_row || ring == 0 ? 1 : 2 * ring)
                    look_into(x, y, from, drawn, best);
            }
        }
        return best.end;
    }

private:
    struct Best {
        End end = none;
        double distance2 = std::numeric_limits<double>::infinity();
    };

    std::size_t cell_of(const dvec2& p) const
    {
        const int x = std::min(int((p.x - low_.x) / cell_), columns_ - 1), y = std::min(int((p.y - low_.y) / cell_), rows_ - 1);
        return std::size_t(y) * std::size_t(columns_) + std::size_t(x);
    }

    void fill(const std::vector<End>& ends)
    {
        first_.assign(std::size_t(columns_) * std::size_t(rows_) + 1, 0);
        for (const End e : ends)
            ++first_[cell_of(place(lines_, e)) + 1];
        for (std::size_t i = 1; i < first_.size(); ++i)
            first_[i] += first_[i - 1];
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        sorted_.resize(ends.size());
        for (const End e : ends)
            sorted_[next[cell_of(place(lines_, e))]++] = e;
    }

    void look_into(int x, int y, const dvec2& from, std::span<const char> drawn, Best& best) const
    {
        if (x < 0 || y < 0 || x >= columns_ || y >= rows_)
            return;
        const std::size_t cell = std::size_t(y) * std::size_t(columns_) + std::size_t(x);
        for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
            const End e = sorted_[i];
            if (drawn[e / 2])
                continue;
            const dvec2 d = place(lines_, e) - from;
            const double distance2 = glm::dot(d, d);
            if (distance2 < best.distance2 || (distance2 == best.distance2 && e < best.end))
                best = {e, distance2};
        }
    }

    std::span<const PenLine> lines_;
    dvec2 low_;
    double cell_ = 1;
    int columns_ = 1, rows_ = 1;
    std::vector<std::uint32_t> first_; ///< per cell: its first entry of sorted_
    std::vector<End> sorted_;
};

} // namespace

std::vector<PenStep> pen_order(std::span<const PenLine> lines)
{
    std::vector<PenStep> order;
    std::vector<char> drawn(lines.size(), 0);
    dvec2 pen(0);
    std::size_t left = lines.size();
    while (left > 0) {
        // Rebuilt whenever half of the lines are gone, so that searches do not wade through empty cells.
        const EndGrid grid(lines, drawn);
        for (const std::size_t until = left / 2; left > until; --left) {
            const End e = grid.nearest(pen, drawn);
            drawn[e / 2] = 1;
            order.push_back({e / 2, (e & 1) != 0});
            pen = place(lines, e ^ 1);
        }
    }
    return order;
}

double pen_travel(std::span<const PenLine> lines, std::span<const PenStep> order)
{
    double travel = 0;
    dvec2 pen(0);
    for (const PenStep& step : order) {
        travel += glm::length(place(lines, 2 * step.line + (step.reversed ? 1 : 0)) - pen);
        pen = place(lines, 2 * step.line + (step.reversed ? 0 : 1));
    }
    return travel;
}

} // namespace limn
