// Checklist 3 and 25 of the procedural structures specification, and the integrals of 7.1.

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "limn/base/random.h"
#include "limn/formulas/formulas.h"

namespace limn {
namespace {

using namespace formulas;

TEST(Checklist3, StepFractAndSmoothstepAreThoseOfTheSpecification)
{
    EXPECT_EQ(glm::step(0.5f, 0.5f), 1.0f);
    EXPECT_NEAR(glm::fract(-3.2f), 0.8f, 1e-6f);
    EXPECT_EQ(glm::smoothstep(0.0f, 1.0f, 0.5f), 0.5f);
    EXPECT_LT(glm::smoothstep(0.0f, 1.0f, 1e-3f), 1e-5f);
    EXPECT_LT(1 - glm::smoothstep(0.0f, 1.0f, 1 - 1e-3f), 1e-5f);
    EXPECT_EQ(pulse(0.1f, 0.05f), 0.0f);
    EXPECT_EQ(pulse(0.1f, 0.1f), 1.0f);
    EXPECT_EQ(pulse(0.1f, 0.95f), 0.0f);
}

TEST(Checklist25, TheGeneratorGivesTheNumbersOfTheSpecification)
{
    const std::uint32_t expected[2][8] = {{49, 22102, 59391, 64508, 64349, 26226, 36299, 57144},
                                          {3174, 22863, 12684, 53805, 40834, 7707, 32712, 54425}};
    for (std::uint32_t seed = 0; seed < 2; ++seed) {
        std::uint32_t state = seed;
        for (const std::uint32_t number : expected[seed]) {
            state = lcg_next(state);
            EXPECT_EQ(state, number);
        }
    }
}

TEST(Checklist25, ThePeriodIs65536)
{
    std::uint32_t state = 1, steps = 0;
    do {
        state = lcg_next(state);
        ++steps;
    } while (state != 1 && steps <= 65536);
    EXPECT_EQ(steps, 65536u);
    EXPECT_LT(lcg_unit(65535), 1.0f);
}

/// Mean of a function of the phase over a kernel by many samples.
template <class F> double by_samples(F&& f, const Blur& blur, double x)
{
    double sum = 0;
    const int n = 2000;
    if (blur.kernel == KERNEL_GAUSS) {
        double weights = 0;
        for (int i = -4 * n; i <= 4 * n; ++i) {
            const double z = double(i) / n, w = std::exp(-0.5 * z * z);
            sum += w * f(x + z * double(blur.a));
            weights += w;
        }
        return sum / weights;
    }
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < 100; ++j)
            sum += f(x + double(blur.a) * ((i + 0.5) / n - 0.5) + double(blur.b) * ((j + 0.5) / 100 - 0.5));
    return sum / (100 * n);
}

TEST(Pulses, IntegralsAreThoseOfThePulse)
{
    double first = 0, second = 0;
    const double step = 1e-4, duty = 0.3;
    for (int i = 0; i < 25000; ++i) {
        const double x = (i + 0.5) * step;
        second += step * (first + 0.5 * step * (x - std::floor(x) < duty));
        first += step * (x - std::floor(x) < duty);
        if (i % 1000 == 999) {
            EXPECT_NEAR(double(pulse_integral(float(x + step / 2), float(duty))), first, 2e-4) << x;
            EXPECT_NEAR(double(pulse_second_integral(float(x + step / 2), float(duty))), second, 5e-4) << x;
        }
    }
}

TEST(Pulses, BoxMeansAgreeWithTheSpecificationAndWithSamples)
{
    for (int i = 0; i < 50; ++i) {
        Random random(3, std::uint64_t(i));
        const float a = float(random.uniform(0.5, 3)), b = a * float(random.uniform(0.3, 1)), duty = float(random.uniform(0.1, 0.9)),
                    x = float(random.uniform(-3, 3));
        const Blur blur = blur_of(KERNEL_BOX, a, b);
        const double wanted = by_samples([&](double at) { return at - std::floor(at) < double(duty) ? 1.0 : 0.0; }, blur, double(x));
        EXPECT_NEAR(double(pulse_box_mean(x, duty, a, b)), wanted, 1.5e-3);
        EXPECT_NEAR(double(blurred_pulse(x, 0.0f, duty, blur)), wanted, 1.5e-3);
    }
}

TEST(PeriodicBlur, AgreesWithSamplesFromNarrowToWide)
{
    for (int i = 0; i < 60; ++i) {
        Random random(5, std::uint64_t(i));
        const float size = float(std::exp(random.uniform(std::log(0.003), std::log(2.0)))), x = float(random.uniform(-2, 2));
        const Blur blur = i % 2 == 0 ? blur_of(KERNEL_GAUSS, size, 0) : blur_of(KERNEL_BOX, size, size * float(random.uniform()));
        const auto saw = [](double at) { return at - std::floor(at) - 0.5; };
        const auto parabola = [](double at) {
            const double f = at - std::floor(at);
            return f * f - f + 1.0 / 6;
        };
        const vec2 blurred = blurred_saw(x, blur);
        EXPECT_NEAR(double(blurred.x), by_samples(saw, blur, double(x)), 1.5e-3) << size;
        EXPECT_NEAR(double(blurred.y), by_samples(parabola, blur, double(x)), 2e-4) << size;
    }
}

TEST(PeriodicBlur, IsContinuousWhereItsFormsMeet)
{
    for (float x = 0; x < 1; x += 0.013f) {
        EXPECT_NEAR(narrow_gauss_saw(x, 0.125f).x, wide_gauss_saws(turn_of(x), gauss_fade(0.125f)).here.x, 1e-4f);
        EXPECT_NEAR(narrow_gauss_saw(x, 0.125f).y, wide_gauss_saws(turn_of(x), gauss_fade(0.125f)).here.y, 1e-5f);
        EXPECT_NEAR(narrow_box_saw(x, 0.7f, 0.3f).x, wide_box_saw(x, 0.7f, 0.3f).x, 2e-6f);
        EXPECT_NEAR(narrow_box_saw(x, 0.7f, 0.3f).y, wide_box_saw(x, 0.7f, 0.3f).y, 2e-6f);
        EXPECT_NEAR(wide_box_saw(x, 1.3f, 0.9e-3f).x, wide_box_saw(x, 1.3f, 1.1e-3f).x, 1e-3f);
    }
}

TEST(PeriodicBlur, TheSeriesKnowsThePlaceHalfAPeriodOnToo)
{
    for (const float sigma : {0.126f, 0.2f, 0.35f, 0.6f, 0.9f})
        for (float x = -1; x < 1; x += 0.037f) {
            const vec2 on = wide_gauss_saws(turn_of(x), gauss_fade(sigma)).half_on,
                       wanted = blurred_saw(x + 0.5f, blur_of(KERNEL_GAUSS, sigma, 0));
            EXPECT_NEAR(on.x, wanted.x, 2e-6f) << sigma;
            EXPECT_NEAR(on.y, wanted.y, 2e-6f) << sigma;
        }
}

TEST(PeriodicBlur, SharesOfStretchesAndTheirMiddlesAgreeWithSamples)
{
    for (int i = 0; i < 40; ++i) {
        Random random(9, std::uint64_t(i));
        const float size = float(std::exp(random.uniform(std::log(0.02), std::log(1.5)))), x = float(random.uniform(-2, 2)),
                    length = float(random.uniform(0.1, 0.9));
        const Blur blur = blur_of(i % 2 == 0 ? KERNEL_GAUSS : KERNEL_BOX, size, i % 2 == 0 ? 0 : 0.5f * size);
        const Stretch s = stretch_under(blurred_saw(x, blur), blurred_saw(x - length, blur), length, blur);
        const auto in = [&](double at) { return at - std::floor(at) < double(length); };
        const double weight = by_samples([&](double at) { return in(at) ? 1.0 : 0.0; }, blur, double(x));
        const double moment =
            by_samples([&](double at) { return in(at) ? at - std::floor(at) - 0.5 * double(length) : 0.0; }, blur, double(x));
        EXPECT_NEAR(double(s.weight), weight, 1.5e-3);
        if (weight > 0.02) {
            EXPECT_NEAR(double(s.middle), moment / weight, 1e-2);
        }
        EXPECT_LE(s.spread, length / std::sqrt(12.0f) + 1e-6f);
    }
}

TEST(PeriodicBlur, GoesFromTheHardPatternToTheMeanAndLosesContrastOnTheWay)
{
    const float duty = 0.3f;
    for (const int kernel : {KERNEL_BOX, KERNEL_GAUSS}) {
        float last = 2;
        for (float per_pixel = 1e-3f; per_pixel < 30; per_pixel *= 1.25f) {
            const Blur blur = blur_along(kernel, kernel == KERNEL_BOX ? 2.0f : 0.5f, vec2(per_pixel, 0.4f * per_pixel));
            float low = 1, high = 0, mean = 0;
            for (int i = 0; i < 200; ++i) {
                const float x = (float(i) + 0.5f) / 200, value = blurred_pulse(x, 0.2f, duty, blur);
                low = std::min(low, value), high = std::max(high, value), mean += value / 200;
                if (per_pixel == 1e-3f && std::abs(x - 0.2f) > 0.01f && std::abs(x - 0.5f) > 0.01f) {
                    EXPECT_NEAR(value, x > 0.2f && x < 0.5f ? 1.0f : 0.0f, 1e-5f);
                }
            }
            EXPECT_NEAR(mean, duty, 2e-3f);
            if (kernel == KERNEL_GAUSS) { // a square's contrast comes back a little between its zeros
                EXPECT_LE(high - low, last + 1e-4f) << per_pixel;
            }
            last = high - low;
        }
        EXPECT_LT(last, 1e-3f);
    }
}

} // namespace
} // namespace limn
