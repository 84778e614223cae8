#include "limn/lines/trim.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace limn {
namespace {

void expect_intervals(const Intervals& found, const std::vector<std::pair<double, double>>& expected)
{
    ASSERT_EQ(std::size_t(found.count), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(found.parts[i].begin, expected[i].first, 1e-6);
        EXPECT_NEAR(found.parts[i].end, expected[i].second, 1e-6);
    }
}

/// Where scale (s - z1)(s - z2) is positive.
Intervals of_parabola(double scale, double z1, double z2)
{
    const auto value = [=](double s) { return float(scale * (s - z1) * (s - z2)); };
    return positive_intervals(value(0), value(0.5), value(1));
}

// Checklist 10. The six cases of figure 4.5, each as a parabola with chosen zeros.
TEST(Trim, CaseAKeepsBothEndsAroundANegativeMiddle) { expect_intervals(of_parabola(1, 0.15, 0.8), {{0, 0.15}, {0.8, 1}}); }

TEST(Trim, CaseBKeepsAPositiveMiddle)
{
    expect_intervals(of_parabola(-1, 0.15, 0.8), {{0.15, 0.8}});
    expect_intervals(of_parabola(-3e-4, 0.6, 0.7), {{0.6, 0.7}}); // all three samples are negative
}

TEST(Trim, CaseCKeepsAllOfAPositiveSegment)
{
    expect_intervals(of_parabola(1, -0.3, -0.1), {{0, 1}});
    expect_intervals(positive_intervals(1, 0.9f, 0.7f), {{0, 1}});
}

TEST(Trim, CaseDKeepsNothingOfANegativeSegment)
{
    expect_intervals(of_parabola(-1, 1.2, 3), {});
    expect_intervals(positive_intervals(-0.5f, -0.4f, -0.4f), {});
}

TEST(Trim, CaseECutsAtTheOneZero)
{
    expect_intervals(of_parabola(1, 0.4, 1.7), {{0, 0.4}});
    expect_intervals(of_parabola(1, -0.2, 0.4), {{0.4, 1}});
}

TEST(Trim, CaseFJoinsTheTwoPiecesThatTouchAtADoubleZero)
{
    expect_intervals(of_parabola(1, 0.5, 0.5), {{0, 1}});
    expect_intervals(of_parabola(1, 0.25, 0.25), {{0, 1}});
}

TEST(Trim, ZeroIsNotPositive)
{
    expect_intervals(positive_intervals(0, 0, 0), {});
    EXPECT_TRUE(positive_interval(0, 0).empty());
    EXPECT_TRUE(positive_interval(-1, 0).empty());
    EXPECT_FALSE(positive_interval(0, 1).empty());
    EXPECT_EQ(positive_interval(0, 1).begin, 0);
}

TEST(Trim, ParabolasAreKeptExactlyWhereTheyArePositive)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> value(-1, 1);
    for (int trial = 0; trial < 20000; ++trial) {
        const float a = value(random), m = value(random), b = value(random);
        const Intervals found = positive_intervals(a, m, b);
        ASSERT_LE(found.count, 2);
        for (int i = 0; i <= 50; ++i) {
            const double s = i / 50.0;
            const double d = a * (1 - s) * (1 - 2 * s) + m * 4 * s * (1 - s) + b * s * (2 * s - 1);
            bool inside = false;
            for (int p = 0; p < found.count; ++p)
                inside = inside || (s >= double(found.parts[std::size_t(p)].begin) && s <= double(found.parts[std::size_t(p)].end));
            ASSERT_TRUE(inside == (d > 0) || std::abs(d) <= 1e-6) << "trial " << trial << ": " << a << " " << m << " " << b << " at " << s;
        }
    }
}

TEST(Trim, TheLinearRuleIsTheParabolaWithoutBend)
{
    std::mt19937 random(8);
    std::uniform_int_distribution<int> value(-64, 64); // so that the middle is exact
    for (int trial = 0; trial < 5000; ++trial) {
        const float a = float(value(random)), b = float(value(random));
        const Interval line = positive_interval(a, b);
        const Intervals parabola = positive_intervals(a, 0.5f * (a + b), b);
        ASSERT_EQ(parabola.count, line.empty() ? 0 : 1) << a << " " << b;
        if (!line.empty()) {
            EXPECT_NEAR(parabola.parts[0].begin, line.begin, 1e-6);
            EXPECT_NEAR(parabola.parts[0].end, line.end, 1e-6);
        }
    }
}

} // namespace
} // namespace limn
