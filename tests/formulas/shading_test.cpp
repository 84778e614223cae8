#include "limn/formulas/formulas.h"

#include <cmath>

#include <gtest/gtest.h>

namespace limn {
namespace {

TEST(Shading, DiffuseIsTheCosineAndNeverNegative)
{
    const vec3 n = {0, 0, 1};
    EXPECT_FLOAT_EQ(formulas::diffuse(n, glm::normalize(vec3(0, 1, 1))), std::sqrt(0.5f));
    EXPECT_EQ(formulas::diffuse(n, {1, 0, 0}), 0.0f);
    EXPECT_EQ(formulas::diffuse(n, {0, 0, -1}), 0.0f);
}

TEST(Shading, TheSeenNormalPointsToTheEye)
{
    EXPECT_EQ(formulas::seen_normal({0, 0, 1}, {0.6f, 0, 0.8f}), vec3(0, 0, 1));
    EXPECT_EQ(formulas::seen_normal({0, 0, -1}, {0.6f, 0, 0.8f}), vec3(0, 0, 1));
}

TEST(Shading, ToonTonesAreDarkBelowTheLimitAndEvenAbove)
{
    EXPECT_EQ(formulas::toon_tone(0.29f, 0.3f, 2.0f), 0.0f);
    EXPECT_EQ(formulas::toon_tone(0.3f, 0.3f, 2.0f), 1.0f);
    EXPECT_EQ(formulas::toon_tone(1.0f, 0.3f, 2.0f), 1.0f);
    EXPECT_EQ(formulas::toon_tone(0.19f, 0.2f, 5.0f), 0.0f);
    EXPECT_EQ(formulas::toon_tone(0.3f, 0.2f, 5.0f), 0.25f);
    EXPECT_EQ(formulas::toon_tone(0.5f, 0.2f, 5.0f), 0.5f);
    EXPECT_EQ(formulas::toon_tone(0.7f, 0.2f, 5.0f), 0.75f);
    EXPECT_EQ(formulas::toon_tone(0.9f, 0.2f, 5.0f), 1.0f);
    EXPECT_EQ(formulas::toon_tone(1.0f, 0.2f, 5.0f), 1.0f);
}

} // namespace
} // namespace limn
