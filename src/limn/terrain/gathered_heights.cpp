#include "limn/terrain/gathered_heights.h"

#include <algorithm>
#include <cmath>

#include "limn/base/parallel.h"

namespace limn {
namespace {

struct RowRange {
    float low = std::numeric_limits<float>::infinity(), high = -low;
    std::uint64_t samples = 0;
};

RowRange range_of(const float* heights, int count)
{
    RowRange range;
    for (int x = 0; x < count; ++x)
        if (!std::isnan(heights[x])) {
            range.low = std::min(range.low, heights[x]), range.high = std::max(range.high, heights[x]);
            ++range.samples;
        }
    return range;
}

} // namespace

GatheredHeights::GatheredHeights(const Lattice& lattice, int spacing)
    : lattice_(lattice), spacing_(spacing), kept_((lattice.columns - 1) / spacing + 1, (lattice.rows - 1) / spacing + 1),
      corners_(std::size_t(kept_.x) * std::size_t(kept_.y)), last_column_(std::size_t(lattice.rows)),
      last_row_(std::size_t(lattice.columns))
{
}

void GatheredHeights::add(const HeightWindow& rows)
{
    std::vector<RowRange> ranges(std::size_t(rows.end.y - rows.first.y));
    parallel_each(ranges.size(), 8, [&](std::size_t i) { ranges[i] = range_of(rows.at(0, rows.first.y + int(i)), lattice_.columns); });
    for (const RowRange& range : ranges)
        low_ = std::min(low_, range.low), high_ = std::max(high_, range.high), samples_ += range.samples;
    for (int y = rows.first.y; y < rows.end.y; ++y) {
        last_column_[std::size_t(y)] = rows.height({lattice_.columns - 1, y});
        if (y == lattice_.rows - 1)
            std::copy_n(rows.at(0, y), lattice_.columns, last_row_.begin());
        for (int x = 0; y % spacing_ == 0 && x < kept_.x; ++x)
            corners_[std::size_t(y / spacing_) * std::size_t(kept_.x) + std::size_t(x)] = rows.height({x * spacing_, y});
    }
}

float GatheredHeights::height(const ivec2& sample) const
{
    if (sample.x == lattice_.columns - 1)
        return last_column_[std::size_t(sample.y)];
    if (sample.y == lattice_.rows - 1)
        return last_row_[std::size_t(sample.x)];
    return corners_[std::size_t(sample.y / spacing_) * std::size_t(kept_.x) + std::size_t(sample.x / spacing_)];
}

} // namespace limn
