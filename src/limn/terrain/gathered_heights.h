#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "limn/terrain/height_window.h"
#include "limn/terrain/lattice.h"

namespace limn {

/// What has to be known of a whole map before its coarse errors can be found: samples that are corners of large triangles, the last column and
/// row, and the range of heights.
class GatheredHeights {
public:
    /// @param spacing  of the samples that are kept
    GatheredHeights(const Lattice& lattice, int spacing);

    /// Rows that are new. In parallel.
    void add(const HeightWindow& rows);

    /// Of a sample that was kept.
    float height(const ivec2& sample) const;
    const std::vector<float>& last_column() const { return last_column_; }
    const std::vector<float>& last_row() const { return last_row_; }
    float low() const { return low_; }
    float high() const { return high_; }
    std::uint64_t samples() const { return samples_; } ///< with data

private:
    Lattice lattice_;
    int spacing_;
    ivec2 kept_;
    std::vector<float> corners_, last_column_, last_row_;
    float low_ = std::numeric_limits<float>::infinity(), high_ = -low_;
    std::uint64_t samples_ = 0;
};

} // namespace limn
