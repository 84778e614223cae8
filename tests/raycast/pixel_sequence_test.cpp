// Which samples to take: the sequence of the library beside others, on shadows whose exact share of light is known.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include <fmt/format.h>

#include "limn/base/random.h"
#include "limn/raycast/pixel_sequence.h"

namespace limn {
namespace {

constexpr int side = 48; ///< pixels of the pictures

/// Sample `index` of `count` in a pixel.
using Pattern = std::function<vec2(ivec2 pixel, std::uint32_t index, std::uint32_t count)>;

float unit(std::uint32_t x) { return float(x >> 8) * 0x1p-24f; }

std::uint32_t reversed(std::uint32_t x)
{
    std::uint32_t r = 0;
    for (int b = 0; b < 32; ++b)
        r = r << 1 | (x >> b & 1);
    return r;
}

/// The first two dimensions of Sobol's sequence.
vec2 sobol(std::uint32_t i, std::uint32_t flip_x, std::uint32_t flip_y)
{
    std::uint32_t y = 0, k = i;
    for (std::uint32_t v = 1u << 31; k; k >>= 1, v ^= v >> 1)
        if (k & 1)
            y ^= v;
    return {unit(reversed(i) ^ flip_x), unit(y ^ flip_y)};
}

Random of_pixel(ivec2 p) { return Random(9, std::uint64_t(p.y * side + p.x)); }

std::vector<std::pair<const char*, Pattern>> patterns()
{
    return {
        {"chance", [](ivec2 p, std::uint32_t i, std::uint32_t) {
             Random random(7, std::uint64_t(p.y * side + p.x) << 16 | i);
             return vec2(float(random.uniform()), float(random.uniform()));
         }},
        {"jittered squares", [](ivec2 p, std::uint32_t i, std::uint32_t n) {
             Random random(7, std::uint64_t(p.y * side + p.x) << 16 | i);
             const std::uint32_t rows = std::uint32_t(std::lround(std::sqrt(double(n))));
             return vec2((float(i % rows) + float(random.uniform())) / float(rows), (float(i / rows) + float(random.uniform())) / float(rows));
         }},
        {"plastic steps, each pixel moved by chance", [](ivec2 p, std::uint32_t i, std::uint32_t) {
             Random random = of_pixel(p);
             return vec2(unit(i * 0xC13FA9A9u + std::uint32_t(random.next())), unit(i * 0x91E10DA6u + std::uint32_t(random.next())));
         }},
        {"Sobol, each pixel's digits flipped by chance", [](ivec2 p, std::uint32_t i, std::uint32_t) {
             Random random = of_pixel(p);
             const std::uint32_t x = std::uint32_t(random.next()), y = std::uint32_t(random.next());
             return sobol(i, x, y);
         }},
        {"Sobol along Hilbert's curve", [](ivec2 p, std::uint32_t i, std::uint32_t n) { return sobol(formulas::hilbert_rank(256, p) * n + i, 0x9E3779B9u, 0x7F4A7C15u); }},
        {"plastic steps along Hilbert's curve (the library's)", [](ivec2 p, std::uint32_t i, std::uint32_t n) { return PixelSequence(p, n).place(i); }},
    };
}

/// Whether a place of a light is seen from a pixel past some edge: a straight one, and the rim of a disc.
bool sees_past_edge(ivec2 p, const vec2& u)
{
    const float turn = 0.7f, cut = 2 * float(p.x) / side - 0.5f + 0.004f * float(p.y);
    return std::cos(turn) * (u.x - 0.5f) + std::sin(turn) * (u.y - 0.5f) < cut - 0.5f;
}
bool sees_past_disc(ivec2 p, const vec2& u)
{
    const vec2 middle = 3.0f * (vec2(p) / float(side) - 0.5f);
    return glm::distance(u, middle + vec2(0.5f, 0.5f)) > 0.6f;
}

struct Errors {
    double pixel = 0, neighbours = 0; ///< of each pixel, and of the mean of 4 x 4
};

using Sees = bool (*)(ivec2, const vec2&);

/// The part of the light that each pixel sees.
std::vector<double> exact_shares(Sees sees)
{
    constexpr int fine = 100;
    std::vector<double> shares(side * side, 0);
    for (int i = 0; i < side * side; ++i)
        for (int k = 0; k < fine * fine; ++k)
            shares[std::size_t(i)] += sees({i % side, i / side}, (vec2(float(k % fine), float(k / fine)) + 0.5f) / float(fine)) / double(fine * fine);
    return shares;
}

Errors errors_of(const Pattern& pattern, Sees sees, const std::vector<double>& exact, std::uint32_t count)
{
    std::vector<double> off(side * side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            int found = 0;
            for (std::uint32_t i = 0; i < count; ++i)
                found += sees({x, y}, pattern({x, y}, i, count));
            off[std::size_t(y * side + x)] = double(found) / count - exact[std::size_t(y * side + x)];
        }
    Errors errors;
    for (int y = 0; y + 4 <= side; ++y)
        for (int x = 0; x + 4 <= side; ++x) {
            double mean = 0;
            for (int k = 0; k < 16; ++k)
                mean += off[std::size_t((y + k / 4) * side + x + k % 4)] / 16;
            errors.neighbours += mean * mean;
        }
    for (const double one : off)
        errors.pixel += one * one;
    return {std::sqrt(errors.pixel / (side * side)), std::sqrt(errors.neighbours / ((side - 3) * (side - 3)))};
}

TEST(PixelSequence, HasTheLeastErrorAmongNeighbours)
{
    const auto all = patterns();
    const std::vector<double> past_edge = exact_shares(sees_past_edge), past_disc = exact_shares(sees_past_disc);
    for (const std::uint32_t count : {4u, 16u, 64u}) {
        std::vector<Errors> sums(all.size());
        for (std::size_t k = 0; k < all.size(); ++k) {
            const Errors edge = errors_of(all[k].second, sees_past_edge, past_edge, count), disc = errors_of(all[k].second, sees_past_disc, past_disc, count);
            sums[k] = {0.5 * (edge.pixel + disc.pixel), 0.5 * (edge.neighbours + disc.neighbours)};
            fmt::print("{:2} samples, {}: {:.4f} of a pixel, {:.4f} of 4 x 4\n", count, all[k].first, sums[k].pixel, sums[k].neighbours);
        }
        const Errors own = sums.back();
        for (std::size_t k = 0; k + 1 < all.size(); ++k) {
            EXPECT_LT(own.pixel, 1.2 * sums[k].pixel) << all[k].first;
            EXPECT_LT(own.neighbours, 1.05 * sums[k].neighbours) << all[k].first;
        }
        EXPECT_LT(own.pixel, 0.75 * sums[0].pixel);
    }
}

TEST(PixelSequence, HasNumbersOfChanceOfTheirOwn)
{
    const PixelSequence sequence({3, 4}, 64);
    dvec2 mean(0);
    double product = 0;
    constexpr std::uint32_t count = 1 << 16;
    for (std::uint32_t i = 0; i < count; ++i) {
        const vec2 chance = sequence.chance(i), place = sequence.place(i);
        EXPECT_TRUE(chance.x >= 0 && chance.x < 1 && chance.y >= 0 && chance.y < 1 && place.x >= 0 && place.x < 1);
        mean += dvec2(chance) / double(count);
        product += double((chance.x - 0.5f) * (chance.y - 0.5f)) + double((chance.x - 0.5f) * (place.x - 0.5f));
    }
    EXPECT_NEAR(mean.x, 0.5, 0.01);
    EXPECT_NEAR(mean.y, 0.5, 0.01);
    EXPECT_NEAR(product / count, 0, 0.002);
}

} // namespace
} // namespace limn
