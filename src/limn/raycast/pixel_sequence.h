#pragma once

#include <cstdint>

#include "limn/base/vec.h"
#include "limn/formulas/formulas.h"

namespace limn {

/// Places in the unit square for the samples of a picture, evenly spread in each pixel and over neighbouring ones: one sequence (Roberts 2018, "The
/// unreasonable effectiveness of quasirandom sequences": steps of the plastic number) goes from pixel to pixel along Hilbert's curve, as Ahmed and Wonka 2020
/// ("Screen-space blue-noise diffusion") order theirs, so that what one pixel lacks its neighbours have. Whole-number arithmetic: the same on
/// every machine.
class PixelSequence {
public:
    /// @param per_pixel  samples that a pixel may take, at most 65536
    PixelSequence(const ivec2& pixel, std::uint32_t per_pixel)
        : first_(formulas::hilbert_rank(std::uint32_t(side), ivec2(pixel.x & (side - 1), pixel.y & (side - 1))) * per_pixel)
    {
    }
    vec2 place(std::uint32_t index) const
    {
        const std::uint32_t i = first_ + index;
        return {unit(i * 0xC13FA9A9u), unit(i * 0x91E10DA6u)};
    }
    /// Two even numbers of chance that have nothing to do with the place.
    vec2 chance(std::uint32_t index) const
    {
        const std::uint32_t x = mixed(first_ + index);
        return {unit(x), unit(mixed(x ^ 0x9E3779B9u))};
    }

private:
    static constexpr int side = 256; ///< pixels after which it begins anew
    static float unit(std::uint32_t x) { return float(x >> 8) * 0x1p-24f; }
    static std::uint32_t mixed(std::uint32_t x) ///< the finaliser of MurmurHash3
    {
        x = (x ^ (x >> 16)) * 0x85EBCA6Bu;
        x = (x ^ (x >> 13)) * 0xC2B2AE35u;
        return x ^ (x >> 16);
    }
    std::uint32_t first_;
};

} // namespace limn
