#pragma once

#include <vector>

#include "limn/terrain/coarse_errors.h"
#include "limn/terrain/sliding_rows.h"

namespace limn {

/// Nested errors of a map that is read from above and does not fit in memory: to the bit those of nest_errors() with ranges. Points of one power,
/// 2^(power + 1) cells being their hypotenuses, follow those of the power below them at the distance that they need.
class NestingStream {
public:
    /// Powers from this on need a CoarseErrors, others the samples themselves.
    static constexpr int first_coarse = 8;

    /// @param coarse  of first_coarse, with a lattice of this level at least; has to outlive the stream
    NestingStream(const Lattice& lattice, const CoarseErrors& coarse);

    /// Finds what can be found now. In parallel.
    /// @param window  of all columns, from row first_row_needed() or one above on; it ends after the last row that is known. The coarse errors
    ///                have all rows up to there
    void advance(const HeightWindow& window);
    int first_row_needed() const;

    /// How many powers there are.
    int powers() const { return int(stages_.size()); }
    /// Points of a power have bounds up to this row of the points' grid, inclusive; rows are 2^power samples apart. -1: there are none yet.
    int last_row(int power) const { return is_begun(power) ? 2 * stages_[std::size_t(power)].squares_done : -1; }
    bool is_done(int power) const;
    const SlidingRows<PointBounds>& rows(int power) const { return stages_[std::size_t(power)].rows; }
    /// Rows above this one are not asked for any more.
    void release(int power, int row) { stages_[std::size_t(power)].released = row; }

private:
    struct Stage {
        int power;
        int squares; ///< rows of squares of 2^(power + 1) cells
        int squares_done = 0;
        int released = 0;
        SlidingRows<PointBounds> rows;
    };
    bool is_begun(int power) const { return stages_[std::size_t(power)].squares_done > 0; }
    int squares_possible(const Stage& stage, const HeightWindow& window) const;
    void advance(Stage& stage, int squares, const HeightWindow& window);
    PointBounds bounds(const Stage& stage, const SplitPoint& point, const HeightWindow& window) const;
    void forget();

    Lattice lattice_;
    const CoarseErrors& coarse_;
    std::vector<Stage> stages_;
};

} // namespace limn
