#pragma once

#include <concepts>
#include <bit>
#include <cstdint>

namespace limn {

/// Puts a number at `at`, least significant byte first, and returns the byte behind it.
template <std::unsigned_integral T> char* put(char* at, T value)
{
    for (std::size_t k = 0; k < sizeof(T); ++k)
        *at++ = char(static_cast<unsigned char>(value >> (8 * k)));
    return at;
}
inline char* put(char* at, float value) { return put(at, std::bit_cast<std::uint32_t>(value)); }
inline char* put(char* at, double value) { return put(at, std::bit_cast<std::uint64_t>(value)); }

} // namespace limn
