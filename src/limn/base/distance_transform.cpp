#include "limn/base/distance_transform.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"

namespace limn {
namespace {

/// Per pixel the row of the nearest marked pixel of its column, or `none`.
std::vector<std::uint32_t> nearest_in_columns(std::span<const std::uint8_t> marked, ivec2 size)
{
    const std::size_t width = std::size_t(size.x), height = std::size_t(size.y);
    std::vector<std::uint32_t> rows(marked.size(), none);
    parallel_blocks(width, 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = 0; y < height; ++y) // from above
            for (std::size_t i = y * width + begin; i < y * width + end; ++i)
                rows[i] = marked[i] != 0 ? std::uint32_t(y) : y > 0 ? rows[i - width] : none;
        for (std::size_t y = height - 1; y-- > 0;) // and from below, where that is nearer
            for (std::size_t i = y * width + begin; i < y * width + end; ++i) {
                const std::uint32_t below = rows[i + width];
                if (below != none && below > y && (rows[i] == none || below - y < y - rows[i]))
                    rows[i] = below;
            }
    });
    return rows;
}

/// The lower envelope of the parabolas (x - column)^2 + height^2 along one row.
class Envelope {
public:
    explicit Envelope(std::int64_t width) : width_(width) {}

    /// Adds a parabola right of all others.
    void add(std::int64_t column, std::int64_t height)
    {
        const Parabola added = {column, height * height, 0};
        while (!parts_.empty() && parts_.back().value(parts_.back().from) > added.value(parts_.back().from))
            parts_.pop_back();
        if (parts_.empty()) {
            parts_.push_back(added);
            return;
        }
        // The last one is not above the added one at its start, so that they meet right of it.
        const Parabola& last = parts_.back();
        const std::int64_t from = 1 + (column * column - last.column * last.column + added.squared - last.squared) / (2 * (column - last.column));
        if (from < width_)
            parts_.push_back({column, added.squared, from});
    }

    /// Calls f(x, column of the lowest parabola) for every x of the row.
    template <class F> void each(F&& f) const
    {
        for (std::size_t k = 0; k < parts_.size(); ++k)
            for (std::int64_t x = parts_[k].from, end = k + 1 < parts_.size() ? parts_[k + 1].from : width_; x < end; ++x)
                f(x, parts_[k].column);
    }
    void clear() { parts_.clear(); }

private:
    struct Parabola {
        std::int64_t column, squared;
        std::int64_t from; ///< first x where it is the lowest
        std::int64_t value(std::int64_t x) const { return (x - column) * (x - column) + squared; }
    };
    std::int64_t width_;
    std::vector<Parabola> parts_;
};

} // namespace

ivec2 DistanceTransform::nearest_to(int x, int y) const
{
    const std::uint32_t i = nearest[std::size_t(y) * std::size_t(size.x) + std::size_t(x)];
    return {int(i % std::uint32_t(size.x)), int(i / std::uint32_t(size.x))};
}

std::int64_t DistanceTransform::squared_distance(int x, int y) const
{
    const ivec2 d = nearest_to(x, y) - ivec2(x, y);
    return std::int64_t(d.x) * d.x + std::int64_t(d.y) * d.y;
}

double DistanceTransform::distance(int x, int y) const
{
    return empty() ? std::numeric_limits<double>::infinity() : std::sqrt(double(squared_distance(x, y)));
}

DistanceTransform distance_transform(std::span<const std::uint8_t> marked, ivec2 size)
{
    if (size.x < 0 || size.y < 0 || marked.size() != std::size_t(size.x) * std::size_t(size.y) || marked.size() >= none)
        throw Error::Input(fmt::format("{} marks are no picture of {} x {} pixels", marked.size(), size.x, size.y));
    DistanceTransform result = {size, std::vector<std::uint32_t>(marked.size(), none)};
    if (marked.empty())
        return result;
    const std::vector<std::uint32_t> rows = nearest_in_columns(marked, size);
    const std::size_t width = std::size_t(size.x);
    parallel_blocks(std::size_t(size.y), 16, [&](std::size_t begin, std::size_t end) {
        Envelope envelope(size.x);
        for (std::size_t y = begin; y < end; ++y) {
            const std::uint32_t* row = rows.data() + y * width;
            envelope.clear();
            for (std::size_t x = 0; x < width; ++x)
                if (row[x] != none)
                    envelope.add(std::int64_t(x), std::int64_t(row[x]) - std::int64_t(y));
            envelope.each([&](std::int64_t x, std::int64_t column) {
                result.nearest[y * width + std::size_t(x)] = std::uint32_t(row[column] * width + std::size_t(column));
            });
        }
    });
    return result;
}

} // namespace limn
