#include "status.h"

#include <gtest/gtest.h>

namespace limn::test {
namespace {

using Kind = BoundStatus::Kind;

TerrainStep step_of(std::size_t triangles, std::size_t met)
{
    TerrainStep step;
    step.triangles = triangles;
    step.unmet = triangles - met;
    return step;
}

TEST(BoundStatus, TellsWhetherTheBoundHoldsAndWhyNot)
{
    EXPECT_EQ(bound_status(step_of(100, 100), 1, true).kind, Kind::holds);
    EXPECT_EQ(bound_status(step_of(100, 100), 1, true).text, "1 px holds everywhere");
    EXPECT_EQ(bound_status(step_of(100, 100), 1, false).kind, Kind::following);

    TerrainStep step = step_of(100, 60);
    step.missing = 1;
    EXPECT_EQ(bound_status(step, 0.5, true).text, "0.5 px not met at 40 of 100 triangles yet: 1 tile to read");
    EXPECT_EQ(bound_status(step, 0.5, false).kind, Kind::reading);
    step.missing = 0;
    EXPECT_EQ(bound_status(step, 0.5, true).kind, Kind::short_of_memory);
    step.fault = "a.pyramid: tile 3 of level 1 is damaged";
    EXPECT_EQ(bound_status(step, 0.5, true).kind, Kind::unreadable);
    EXPECT_NE(bound_status(step, 0.5, true).text.find(step.fault), std::string::npos);
}

} // namespace
} // namespace limn::test
