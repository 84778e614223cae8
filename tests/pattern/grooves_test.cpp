// What an analytic filter makes of grooves between beads, held against sums over its kernel.

#include <cmath>

#include <gtest/gtest.h>

#include "limn/base/random.h"
#include "limn/formulas/formulas.h"

namespace limn {
namespace {

using namespace formulas;

/// A groove seen from above, with a light, and where in it the middle of a kernel is.
struct Sight {
    BeadView view;
    BeadFrame frame;
    float phase;
    Blur blur;
};

Sight random_sight(Random& random)
{
    const auto draw = [&](double low, double high) { return float(random.uniform(low, high)); };
    const float bulge = draw(0.2, 0.9), n_up = draw(0.1, 0.8), eye_angle = draw(0.05, 1.3), light_angle = draw(0.05, 1.5);
    const BeadView view = bead_view(bulge, std::sqrt(1 - n_up * n_up), n_up, std::cos(eye_angle), std::sin(eye_angle));
    Illumination lit = {vec3(std::cos(light_angle), std::sin(light_angle), 0), vec3(1), draw(0, 0.2), {0, 1, 0}, vec3(0), vec3(0)};
    const float phase = draw(0, 1), deviation = draw(0.01, 0.6);
    return {view, bead_frame(bulge, view.shift, {1, 0, 0}, {0, 1, 0}, lit), phase, blur_of(KERNEL_GAUSS, deviation, 0)};
}

/// How much of a Gauss kernel is about a place, of all periods.
double density(const Sight& s, double across)
{
    const double x = (across - double(s.view.from)) / double(s.view.period) - double(s.phase);
    double sum = 0;
    for (int period = -4; period <= 4; ++period) {
        const double z = (x - std::round(x) + period) / double(s.blur.a);
        sum += std::exp(-0.5 * z * z);
    }
    return sum;
}

TEST(Grooves, LetAsMuchLightOnTreadsAsThereIsOnAverageUnderTheKernel)
{
    int partly = 0;
    for (int i = 0; i < 3000; ++i) {
        Random random(4, std::uint64_t(i));
        const Sight s = random_sight(random);
        const float tread = s.view.period - (s.view.to - s.view.from);
        if (tread < 0.05f || s.frame.light.y < 0.15f) // hardly any tread, or hardly any light on it
            continue;
        const vec2 front = blurred_saw(s.phase - (s.view.to - s.view.from) / s.view.period, s.blur), back = blurred_saw(s.phase, s.blur);
        const Stretch part = stretch_under(front, back, tread / s.view.period, s.blur);
        if (part.weight < 0.02f)
            continue;
        constexpr int n = 1000;
        double light = 0, all = 0;
        for (int k = 0; k < n; ++k) {
            const double across = double(s.view.to) + (k + 0.5) / n * double(tread), weight = density(s, across);
            const vec2 at = tread_point(s.view, float(across));
            light += weight * double(groove_share(s.frame.shift, s.frame.light, at, at, s.frame.soft));
            all += weight;
        }
        EXPECT_NEAR(light_on_tread(s.frame, s.view, s.phase, s.blur, front, back, part.weight), light / all, 0.05) << i;
        partly += light > 0.1 * all && light < 0.9 * all;
    }
    EXPECT_GT(partly, 300);
}

// Close by, where shadows have borders that one sees.
TEST(Grooves, AreAsBrightAsTheMeanOfTheirPointsUnderTheKernel)
{
    const LayerPattern pattern = {LAYERS_BEAD, {0, 1, 0}, 0, 0, 0.5f, 0, {1, 0, 0}, 1};
    const Finish grey = {FINISH_GGX, vec3(0.6f), 0, 1, 0.25f, 0.35f, 0.04f};
    const Illumination lit = {glm::normalize(vec3(-0.4f, 0.8f, 0.7f)), vec3(2), 0.1f, {0, 1, 0}, vec3(0.3f), vec3(0.1f)};
    const vec3 normal = glm::normalize(vec3(0.1f, 0.7f, 0.7f));
    double errors = 0, range = 0;
    constexpr int places = 200;
    for (int i = 0; i < places; ++i) {
        Random random(6, std::uint64_t(i));
        const float tilt = float(random.uniform(0.05, 0.9)), at = float(random.uniform()),
                    change = float(random.uniform(0.05, 0.1)); // 10 to 20 px a layer
        const vec3 to_eye = {0.1f, std::sin(tilt), std::cos(tilt)};
        const PatternPoint p = {vec3(0), normal, glm::normalize(to_eye), vec3(1, 0, 0), vec3(0, -1, 0)};
        const auto radiance = [&](float place, int kernel) {
            const LayerPlace layer = {place, 1, {0, change}};
            return double(bead_radiance(pattern, grey, p, layer, blur_along(kernel, 0.5f, layer.change), lit).y);
        };
        double sum = 0, all = 0, least = 1e30, most = 0;
        for (double z = -4; z <= 4; z += 0.01) {
            const double value = radiance(at + float(z) * 0.5f * change, KERNEL_NONE), weight = std::exp(-0.5 * z * z);
            sum += weight * value, all += weight;
            least = std::min(least, value), most = std::max(most, value);
        }
        const double error = radiance(at, KERNEL_GAUSS) - sum / all;
        EXPECT_NEAR(error, 0, 0.03) << i;
        errors += error * error / places;
        range = std::max(range, most - least);
    }
    EXPECT_LT(std::sqrt(errors), 0.004);
    EXPECT_GT(range, 0.3) << "there are shadows";
}

TEST(Grooves, AreTakenApartInOrderAndCloseByAroundTheKernel)
{
    for (int i = 0; i < 2000; ++i) {
        Random random(5, std::uint64_t(i));
        const Sight s = random_sight(random);
        const vec3 parts = edge_parts(s.view, s.phase, s.blur.a);
        EXPECT_GE(parts.x, s.view.from - 1e-4f);
        EXPECT_LE(parts.x, parts.y + 1e-4f);
        EXPECT_LE(parts.y, parts.z + 1e-4f);
        EXPECT_LE(parts.z, s.view.to + 1e-4f);
        const float here = s.view.from + s.phase * s.view.period;
        if (s.blur.a < 0.1f && here < s.view.to) {
            const float nearest = std::min({std::abs(parts.x - here), std::abs(parts.y - here), std::abs(parts.z - here)});
            EXPECT_LT(nearest, 1e-4f);
        }
    }
}

} // namespace
} // namespace limn
