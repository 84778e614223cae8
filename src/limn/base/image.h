#pragma once

#include <cstddef>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// A picture of float samples, rows from top to bottom, channels interleaved. Colours are in [0,1] and encoded (sRGB)
/// as they will stand in a file; other quantities keep their unit.
struct Image {
    int width = 0, height = 0, channels = 0;
    std::vector<float> samples; ///< width * height * channels

    Image() = default;
    Image(ivec2 size, int channel_count, float value = 0.0f)
        : width(size.x), height(size.y), channels(channel_count),
          samples(std::size_t(size.x) * std::size_t(size.y) * std::size_t(channel_count), value)
    {
    }
    bool empty() const { return samples.empty(); }
    ivec2 size() const { return {width, height}; }
    float* at(int x, int y) { return samples.data() + (std::size_t(y) * std::size_t(width) + std::size_t(x)) * std::size_t(channels); }
    const float* at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
};

} // namespace limn
