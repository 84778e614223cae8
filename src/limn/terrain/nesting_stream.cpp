#include "limn/terrain/nesting_stream.h"

#include <algorithm>
#include <bit>

#include "limn/base/parallel.h"

namespace limn {

NestingStream::NestingStream(const Lattice& lattice, const CoarseErrors& coarse) : lattice_(lattice), coarse_(coarse)
{
    const ivec2 cells = lattice.points() - 1;
    for (int power = 0; power < lattice.level; ++power)
        stages_.push_back({power, cells.y >> (power + 1), 0, 0, SlidingRows<PointBounds>(std::size_t(cells.x >> power) + 1)});
}

bool NestingStream::is_done(int power) const { return stages_[std::size_t(power)].squares_done == stages_[std::size_t(power)].squares; }

/// Rows of squares whose lower sides, too, have all that they need.
int NestingStream::squares_possible(const Stage& stage, const HeightWindow& window) const
{
    if (stage.power > 0) {
        const Stage& below = stages_[std::size_t(stage.power) - 1];
        return below.squares_done == below.squares ? stage.squares : (below.squares_done - 1) / 2;
    }
    return window.end.y >= lattice_.rows ? stage.squares : (window.end.y - 2) / 2;
}

void NestingStream::advance(const HeightWindow& window)
{
    for (Stage& stage : stages_)
        if (const int squares = squares_possible(stage, window); squares > stage.squares_done)
            advance(stage, squares, window);
    forget();
}

PointBounds NestingStream::bounds(const Stage& stage, const SplitPoint& point, const HeightWindow& window) const
{
    const auto below = [&](const ivec2& p) {
        const int power = std::countr_zero(unsigned(p.x | p.y)); // of this stage or the one below
        return stages_[std::size_t(power)].rows.row(p.y >> power)[std::size_t(p.x >> power)];
    };
    if (stage.power < first_coarse)
        return bounds_of_point(lattice_, window, point, below);
    GrowingBounds bounds;
    bounds.error = coarse_.error(stage.power, point.middle());
    for (int i = 0; i < point.count; ++i)
        for (const ivec2& end : {point.a, point.b})
            bounds.nest(below((point.apexes[i] + end) / 2));
    return bounds.rounded();
}

void NestingStream::advance(Stage& stage, int squares, const HeightWindow& window)
{
    const int s = 2 << stage.power, first = stage.squares_done, columns = (lattice_.points().x - 1) / s;
    stage.rows.extend(2 * squares + 1, PointBounds());
    const auto set = [&](const SplitPoint& point) {
        const ivec2 at = point.middle() / (1 << stage.power);
        stage.rows.row(at.y)[std::size_t(at.x)] = bounds(stage, point, window);
    };
    const int upper = first == 0 ? -1 : first;        // the first row of squares has its upper sides to do too
    const int block = std::max(1, 64 >> stage.power); // squares, of about as many samples at any power
    const int blocks = columns / block + 1;           // one square more, for the right sides of the last ones
    const auto each_square = [&](int from, auto&& f) {
        parallel_each(std::size_t(squares - from) * std::size_t(blocks), 1, [&](std::size_t k) {
            const int j = from + int(k / std::size_t(blocks)), begin = int(k % std::size_t(blocks)) * block;
            for (int i = begin; i < std::min(begin + block, columns + 1); ++i)
                f(i, j);
        });
    };
    each_square(upper, [&](int i, int j) {
        if (i < columns)
            set(split_point_on_row(lattice_, i * s, (j + 1) * s, s));
        if (j >= 0)
            set(split_point_on_column(lattice_, i * s, j * s, s));
    });
    each_square(first, [&](int i, int j) {
        if (i < columns)
            set(split_point_in_square(lattice_, i, j, s));
    });
    stage.squares_done = squares;
}

/// Rows that neither the next power nor anyone else needs.
void NestingStream::forget()
{
    for (Stage& stage : stages_) {
        const bool is_last = std::size_t(stage.power) + 1 == stages_.size();
        const int for_itself = 2 * stage.squares_done;
        const int for_next = is_last ? for_itself : std::max(0, 4 * stages_[std::size_t(stage.power) + 1].squares_done - 1);
        stage.rows.drop_before(std::min({for_itself, for_next, stage.released}));
    }
}

int NestingStream::first_row_needed() const
{
    int row = lattice_.rows;
    for (const Stage& stage : stages_)
        if (stage.power < first_coarse && stage.squares_done < stage.squares)
            row = std::min(row, (2 << stage.power) * stage.squares_done);
    return row;
}

} // namespace limn
