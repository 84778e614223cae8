#include "band_energy.h"

#include <cmath>
#include <complex>
#include <numbers>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace {

using Complex = std::complex<double>;

/// In place, by halving; n is a power of two.
void transform(Complex* values, std::size_t n, std::size_t stride, std::vector<Complex>& scratch)
{
    if (n == 1)
        return;
    const std::size_t half = n / 2;
    transform(values, half, 2 * stride, scratch);
    transform(values + stride, half, 2 * stride, scratch);
    for (std::size_t k = 0; k < n; ++k)
        scratch[k] = values[k * stride];
    for (std::size_t k = 0; k < half; ++k) {
        const Complex turned = std::polar(1.0, -2 * std::numbers::pi * double(k) / double(n)) * scratch[2 * k + 1];
        values[k * stride] = scratch[2 * k] + turned;
        values[(k + half) * stride] = scratch[2 * k] - turned;
    }
}

} // namespace

double band_energy(const std::vector<float>& picture, int edge, double limit)
{
    if (edge < 2 || (edge & (edge - 1)) != 0)
        throw limn::Error::Input(fmt::format("an edge of {} pixels is not a power of two", edge));
    const std::size_t n = std::size_t(edge);
    std::vector<double> window(n);
    double square = 0, mean = 0;
    for (std::size_t i = 0; i < n; ++i) {
        window[i] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * (double(i) + 0.5) / double(n));
        square += window[i] * window[i] / double(n);
    }
    for (const float v : picture)
        mean += double(v) / double(picture.size());
    std::vector<Complex> values(n * n), scratch(n);
    for (std::size_t i = 0; i < n * n; ++i)
        values[i] = (double(picture[i]) - mean) * window[i % n] * window[i / n];
    for (std::size_t y = 0; y < n; ++y)
        transform(&values[y * n], n, 1, scratch);
    for (std::size_t x = 0; x < n; ++x)
        transform(&values[x], n, n, scratch);
    double energy = 0;
    for (std::size_t i = 0; i < n * n; ++i) {
        const auto cycles = [&](std::size_t k) { return (k <= n / 2 ? double(k) : double(k) - double(n)) / double(n); };
        if (i > 0 && std::hypot(cycles(i % n), cycles(i / n)) <= limit)
            energy += std::norm(values[i]);
    }
    return energy / (double(n * n) * double(n * n) * square * square);
}
