#include "limn/shadow/haar_layers.h"

#include <algorithm>
#include <cmath>

namespace limn {
namespace {

constexpr std::int32_t no_depth = 65535;

/// Calls f with each row, as one that is written back.
template <class F> void each_line(std::span<std::int32_t> values, std::size_t size, bool columns, F&& f)
{
    std::vector<std::int32_t> line(size);
    for (std::size_t at = 0; at < size; ++at) {
        const std::size_t first = columns ? at : at * size, step = columns ? size : 1;
        for (std::size_t i = 0; i < size; ++i)
            line[i] = values[first + i * step];
        f(line);
        for (std::size_t i = 0; i < size; ++i)
            values[first + i * step] = line[i];
    }
}

/// Counts a picture's coefficients, and transforms it back.
void add_picture(HaarLayers& sum, const std::vector<std::int32_t>& picture, std::size_t size)
{
    std::vector<std::int32_t> values = picture;
    haar_2d(values, size);
    sum.coefficients += values.size();
    sum.zeros += std::size_t(std::count(values.begin(), values.end(), 0));
    haar_2d_back(values, size);
    sum.exact = sum.exact && values == picture;
}

} // namespace

void haar(std::span<std::int32_t> values)
{
    std::vector<std::int32_t> means(values.size());
    for (std::size_t count = values.size(); count > 1; count /= 2) {
        for (std::size_t i = 0; i < count / 2; ++i) {
            const std::int32_t a = values[2 * i], b = values[2 * i + 1], difference = a - b;
            means[i] = b + (difference >> 1);
            means[count / 2 + i] = difference;
        }
        std::copy_n(means.begin(), count, values.begin());
    }
}

void haar_back(std::span<std::int32_t> values)
{
    std::vector<std::int32_t> pairs(values.size());
    for (std::size_t count = 2; count <= values.size(); count *= 2) {
        for (std::size_t i = 0; i < count / 2; ++i) {
            const std::int32_t difference = values[count / 2 + i], b = values[i] - (difference >> 1);
            pairs[2 * i] = b + difference, pairs[2 * i + 1] = b;
        }
        std::copy_n(pairs.begin(), count, values.begin());
    }
}

void haar_2d(std::span<std::int32_t> values, std::size_t size)
{
    for (const bool columns : {false, true})
        each_line(values, size, columns, [](std::vector<std::int32_t>& line) { haar(line); });
}

void haar_2d_back(std::span<std::int32_t> values, std::size_t size)
{
    for (const bool columns : {true, false})
        each_line(values, size, columns, [](std::vector<std::int32_t>& line) { haar_back(line); });
}

HaarLayers transform_lists(const SegmentLists& lists, std::size_t size)
{
    HaarLayers sum;
    const std::size_t texels = size * size;
    for (std::size_t texel = 0; texel < texels; ++texel)
        sum.layers = std::max(sum.layers, lists.list(texel).size());
    std::vector<std::int32_t> depths(texels), lengths(texels);
    for (std::size_t layer = 0; layer < sum.layers; ++layer) {
        for (std::size_t texel = 0; texel < texels; ++texel) {
            const std::span<const DepthSegment> list = lists.list(texel);
            const DepthSegment& s = list[std::min(layer, list.size() - 1)];
            depths[texel] = s.depth == no_surface ? no_depth : std::int32_t(std::lround(double(s.depth) * (no_depth - 1)));
            lengths[texel] = layer >= list.size() ? 0 : std::int32_t(s.last + 1 - (layer > 0 ? list[layer - 1].last + 1 : 0));
        }
        add_picture(sum, depths, size);
        add_picture(sum, lengths, size);
    }
    sum.expanded_bytes = 4 * sum.coefficients;
    sum.bytes = sum.seed_bytes() + sum.coefficients / 8;
    return sum;
}

} // namespace limn
