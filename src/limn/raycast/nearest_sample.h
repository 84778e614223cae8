#pragma once

#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// Some samples of a picture, to be asked for the nearest of them: quick where few are marked and the nearest is near, as among outlines.
/// (base/distance_transform.h answers for every pixel, and so takes time for every one.)
class NearestSample {
public:
    /// @param marked  each within [0, size)
    NearestSample(const std::vector<ivec2>& marked, const ivec2& size);
    /// Samples, between centres; infinity where nothing is marked.
    double distance(const ivec2& from) const;

private:
    static constexpr int cell = 16; ///< samples along an edge
    std::size_t cell_index(int x, int y) const { return std::size_t(y) * std::size_t(cells_.x) + std::size_t(x); }

    ivec2 cells_;
    std::vector<std::uint32_t> first_; ///< per cell, and one past the last
    std::vector<ivec2> marked_;        ///< cell by cell
};

} // namespace limn
