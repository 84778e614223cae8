#include "limn/pattern/pixel_samples.h"

#include <cmath>
#include <numbers>

#include "limn/base/random.h"
#include "limn/formulas/formulas.h"

namespace limn {
namespace {

/// From the unit square to a kernel.
vec2 in_kernel(const dvec2& unit, int kernel, float width)
{
    if (kernel != formulas::KERNEL_GAUSS)
        return width * (vec2(unit) - 0.5f);
    const double radius = double(width) * std::sqrt(-2 * std::log(1 - unit.x)), turn = 2 * std::numbers::pi * unit.y;
    return vec2(dvec2(radius * std::cos(turn), radius * std::sin(turn)));
}

} // namespace

std::vector<vec2> seed_samples(int count, float side, std::uint32_t seed)
{
    std::vector<vec2> samples;
    std::uint32_t state = seed;
    for (int k = 0; k < count; ++k) {
        const std::uint32_t first = formulas::lcg_next(state);
        state = formulas::lcg_next(first);
        samples.push_back(side * (vec2(formulas::lcg_unit(first), formulas::lcg_unit(state)) - 0.5f));
    }
    return samples;
}

std::vector<vec2> even_samples(int count, int kernel, float width, const vec2& shift)
{
    constexpr double plastic = 1.32471795724474602596;
    std::vector<vec2> samples;
    for (int k = 0; k < count; ++k) {
        const dvec2 place = dvec2(shift) + (k + 0.5) * dvec2(1 / plastic, 1 / (plastic * plastic));
        samples.push_back(in_kernel(place - glm::floor(place), kernel, width));
    }
    return samples;
}

std::vector<vec2> stratified_samples(int side, int kernel, float width, std::uint64_t seed)
{
    Random random(seed);
    std::vector<vec2> samples;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double u = (x + random.uniform()) / side, v = (y + random.uniform()) / side;
            samples.push_back(in_kernel({u, v}, kernel, width));
        }
    return samples;
}

} // namespace limn
