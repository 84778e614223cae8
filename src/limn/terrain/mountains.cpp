#include "limn/terrain/mountains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "limn/base/random.h"

namespace limn {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double widest_extent = 20000, relief_of_extent = 0.15, range_of_extent = 0.5;

/// A value and its derivative.
struct Sloped {
    double value = 0;
    dvec2 slope = {0, 0};
};

std::uint64_t hash(std::int64_t x, std::int64_t y, std::uint64_t seed)
{
    std::uint64_t z = seed + std::uint64_t(x) * 0x9E3779B97F4A7C15u + std::uint64_t(y) * 0xC2B2AE3D27D4EB4Fu;
    z = (z ^ (z >> 32)) * 0xD6E8FEB86659FD93u;
    return z ^ (z >> 32);
}

/// Unit vectors all around.
const std::array<dvec2, 256>& directions()
{
    static const std::array<dvec2, 256> all = [] {
        std::array<dvec2, 256> d;
        for (std::size_t i = 0; i < d.size(); ++i)
            d[i] = {std::cos(two_pi * double(i) / 256), std::sin(two_pi * double(i) / 256)};
        return d;
    }();
    return all;
}

/// cos(2 pi t) and sin(2 pi t) to about 1e-4: they shape a landscape, and are most of its cost.
void wave(double t, double& cosine, double& sine)
{
    const auto sine_of = [](double u) { // u in turns, in [-1/2, 1/2]
        const double parabola = u * (8 - 16 * std::abs(u));
        return parabola * (0.775 + 0.225 * std::abs(parabola));
    };
    constexpr double shift = 0x1.8p52; // adding it rounds to whole numbers, where calls of std::floor would cost as much as all the rest
    const auto within = [](double u) { return u - ((u + shift) - shift); };
    sine = sine_of(within(t));
    cosine = sine_of(within(t + 0.25));
}

/// Where a point is in a grid of unit cells, with the fading weights of its corners.
struct Cell {
    explicit Cell(const dvec2& p)
        : x(std::int64_t(std::floor(p.x))), y(std::int64_t(std::floor(p.y))), at(p - dvec2(double(x), double(y))),
          fade(at * at * at * (at * (at * 6.0 - 15.0) + 10.0)), fade_slope(30.0 * at * at * (at * (at - 2.0) + 1.0))
    {
    }
    std::int64_t x, y;
    dvec2 at, fade, fade_slope;
};

/// Perlin's gradient noise, in about [-0.7, 0.7], with its derivative.
Sloped gradient_noise(const dvec2& p, std::uint64_t seed)
{
    const Cell cell(p);
    const std::array<dvec2, 256>& d = directions();
    const dvec2 g00 = d[hash(cell.x, cell.y, seed) & 255], g10 = d[hash(cell.x + 1, cell.y, seed) & 255];
    const dvec2 g01 = d[hash(cell.x, cell.y + 1, seed) & 255], g11 = d[hash(cell.x + 1, cell.y + 1, seed) & 255];
    const double v00 = glm::dot(g00, cell.at), v10 = glm::dot(g10, cell.at - dvec2(1, 0));
    const double v01 = glm::dot(g01, cell.at - dvec2(0, 1)), v11 = glm::dot(g11, cell.at - dvec2(1, 1));
    const double u = cell.fade.x, v = cell.fade.y, twist = v00 - v10 - v01 + v11;
    return {v00 + u * (v10 - v00) + v * (v01 - v00) + u * v * twist,
            g00 + u * (g10 - g00) + v * (g01 - g00) + u * v * (g00 - g10 - g01 + g11) +
                cell.fade_slope * dvec2(v10 - v00 + v * twist, v01 - v00 + u * twist)};
}

/// Ridges where the noise is 0, rounded a little.
Sloped ridged(const Sloped& noise)
{
    const double fold = std::sqrt(noise.value * noise.value + 0.0025);
    return {0.3 - 1.3 * fold, -1.3 * noise.value / fold * noise.slope};
}

/// Waves of one period per cell along `across`, in [-1, 1], with the derivative of the waves. Each cell has a wave of its own about a point
/// within it; where a place is near several points, theirs are mixed by a kernel that ends where those of cells two away could begin.
Sloped gully_noise(const dvec2& p, const dvec2& across, std::uint64_t seed)
{
    constexpr double jitter = 0.5, reach = 1.25;
    const dvec2 corner = glm::floor(p), at = p - corner;
    Sloped sum;
    double weights = 0;
    for (int k = 0; k < 9; ++k) {
        const int i = k % 3 - 1, j = k / 3 - 1;
        const std::uint64_t bits = hash(std::int64_t(corner.x) + i, std::int64_t(corner.y) + j, seed);
        const dvec2 jump = {double(bits & 0xFFFF) * 0x1p-16 - 0.5, double((bits >> 16) & 0xFFFF) * 0x1p-16 - 0.5};
        const dvec2 from_point = at - dvec2(i + 0.5, j + 0.5) - jitter * jump;
        const double near = 1 - glm::dot(from_point, from_point) / (reach * reach);
        if (near <= 0)
            continue;
        const double weight = near * near * near;
        double cosine, sine;
        wave(glm::dot(from_point, across), cosine, sine);
        sum.value += weight * cosine;
        sum.slope -= weight * two_pi * sine * across;
        weights += weight;
    }
    return {sum.value / weights, sum.slope / weights};
}

} // namespace

Mountains::Mountains(const MountainOptions& options)
{
    const double extent = std::min(options.extent, widest_extent);
    range_ = range_of_extent * extent;
    relief_ = relief_of_extent * extent;
    Random random(options.seed, 0x6D6F756E7461696Eu);
    offset_ = {random.uniform(-1000, 1000), random.uniform(-1000, 1000)};
    const auto octaves = [&](double widest, double finest, double gain) {
        std::vector<Octave> all;
        double amplitude = 1;
        for (double length = widest; length >= std::max(finest, 5 * options.spacing) || all.empty(); length /= 2, amplitude *= gain) {
            const double turn = 0.45 + 0.6435 * double(all.size());
            all.push_back({range_ / length, std::cos(turn), std::sin(turn), amplitude, random.next()});
        }
        return all;
    };
    ranges_ = octaves(range_, range_ / 12, 0.45);
    gullies_ = octaves(range_ / 4, 0, 0.47);
}

double Mountains::height(const dvec2& place) const
{
    const dvec2 p = place / range_ + offset_;
    Sloped base;
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
        const Octave& o = ranges_[i];
        const dvec2 q = o.frequency * dvec2(o.cosine * p.x - o.sine * p.y, o.sine * p.x + o.cosine * p.y);
        Sloped n = gradient_noise(q, o.seed);
        if (i == 0)
            n = ridged(n);
        const dvec2 slope =
            o.amplitude * o.frequency * dvec2(o.cosine * n.slope.x + o.sine * n.slope.y, -o.sine * n.slope.x + o.cosine * n.slope.y);
        const double damp = i == 0 ? 1.0 : std::clamp(0.5 + 1.2 * base.value, 0.15, 1.0);
        base.value += damp * o.amplitude * n.value;
        base.slope += damp * slope;
    }
    Sloped eroded;
    dvec2 down = base.slope;
    for (const Octave& o : gullies_) {
        const double steep = glm::length(down);
        if (steep < 1e-9)
            break;
        const dvec2 across = dvec2(-down.y, down.x) / steep;
        const double strength = 0.05 * o.amplitude * std::min(1.0, steep * 0.6);
        const Sloped g = gully_noise(o.frequency * p, across, o.seed);
        eroded.value += strength * g.value;
        down += 0.6 * strength * o.frequency * g.slope; // finer ones leave coarser ones at a sharp angle
    }
    return relief_ * (0.5 + base.value + 1.2 * eroded.value);
}

} // namespace limn
