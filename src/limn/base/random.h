#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace limn {

/// A small counter-based generator (the finaliser of SplitMix64 over a Weyl sequence): the same numbers on every machine,
/// and a stream per item, so that a parallel loop draws the same numbers for any number of threads.
class Random {
public:
    explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : state_(mix(mix(seed) ^ (stream * weyl))) {}

    std::uint64_t next() { return mix(state_ += weyl); }
    /// Uniform in [0, 1), 53 bits.
    double uniform() { return double(next() >> 11) * 0x1p-53; }
    /// Uniform in [low, high).
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    /// Uniform in [0, n), n > 0, without bias that matters below 2^32.
    std::uint32_t below(std::uint32_t n) { return std::uint32_t(((next() >> 32) * n) >> 32); }
    /// Normal, mean 0 and standard deviation 1 (Box and Muller 1958).
    double normal()
    {
        const double radius = std::sqrt(-2 * std::log(1 - uniform()));
        return radius * std::cos(2 * std::numbers::pi * uniform());
    }

private:
    static constexpr std::uint64_t weyl = 0x9E3779B97F4A7C15u;
    static std::uint64_t mix(std::uint64_t z)
    {
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    std::uint64_t state_;
};

} // namespace limn
