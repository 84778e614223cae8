#include <gtest/gtest.h>

#include "limn/formulas/formulas.h"

namespace limn::test {
namespace {

using namespace formulas;

TEST(TerrainColour, RunsThroughItsRampAndStopsAtTheEnds)
{
    EXPECT_EQ(terrain_tint(0.0f), terrain_tint(-3.0f));
    EXPECT_EQ(terrain_tint(1.0f), terrain_tint(7.0f));
    for (const float step : {0.2f, 0.4f, 0.6f, 0.8f})
        EXPECT_LT(glm::length(terrain_tint(step - 1e-4f) - terrain_tint(step + 1e-4f)), 1e-3f);
    EXPECT_GT(terrain_tint(0.0f).g, terrain_tint(0.0f).r); // green lowlands
    EXPECT_GT(glm::min(terrain_tint(1.0f).r, terrain_tint(1.0f).b), 0.9f);
}

TEST(TerrainColour, LeavesFlatGroundAsBrightAsItsColour)
{
    for (const float height : {0.3f, 0.7f, 1.0f}) {
        const vec3 sun(std::sqrt(1 - height * height), 0, height);
        EXPECT_NEAR(terrain_light({0, 0, 1}, sun), 1, 1e-6f);
        EXPECT_NEAR(terrain_light(-sun, sun), 0.35f, 1e-6f); // the sky's part
        EXPECT_LE(terrain_light(sun, sun), 1.12f);
    }
}

} // namespace
} // namespace limn::test
