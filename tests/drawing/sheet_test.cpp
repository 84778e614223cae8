#include <gtest/gtest.h>

#include <algorithm>

#include "drawing/sample_drawing.h"
#include "limn/base/error.h"
#include "limn/drawing/lettering.h"
#include "limn/drawing/sheet.h"
#include "limn/drawing/svg.h"

namespace limn {
namespace {

TEST(Sheet, LaysDrawingsOutInRowsWithoutOverlap)
{
    std::vector<Drawing> drawings(5, test::sample_with_background());
    drawings[3].background = Image();
    drawings[4].camera.size = {320, 480};
    SheetOptions options;
    options.columns = 3;
    options.gap = 20.0 / 640;
    const Drawing sheet = make_sheet(drawings, options);
    EXPECT_EQ(sheet.camera.size, ivec2(3 * 640 + 2 * 20, 2 * 480 + 20));
    EXPECT_EQ(sheet.background.size(), sheet.camera.size);
    EXPECT_EQ(sheet.strokes.size(), 5 * drawings[0].strokes.size());
    EXPECT_TRUE(std::is_sorted(sheet.strokes.begin(), sheet.strokes.end(), [](const Stroke& a, const Stroke& b) { return a.type < b.type; }));
    // The second drawing's shaded ball lies one cell to the right; the fourth has none.
    EXPECT_EQ(sheet.background.at(660 + 300, 250)[0], drawings[0].background.at(300, 250)[0]);
    EXPECT_EQ(sheet.background.at(300, 500 + 250)[0], 1.0f);
    // Strokes of one type stay in the order of the drawings.
    const Stroke& first = drawings[0].strokes[0];
    EXPECT_EQ(sheet.strokes[0].points[0], first.points[0]);
    EXPECT_EQ(sheet.strokes[4].points[0], first.points[0] + dvec2(660, 0));
    EXPECT_EQ(sheet.strokes[12].points[0], first.points[0] + dvec2(0, 500));
    EXPECT_EQ(sheet.strokes[16].points[0], first.points[0] + dvec2(660 + 160, 500)) << "in the middle of its cell";
}

TEST(Sheet, ChoosesColumnsForAPageLikeShape)
{
    const auto size_of = [](int count) { return make_sheet(std::vector<Drawing>(std::size_t(count), test::sample_drawing())).camera.size; };
    EXPECT_EQ(size_of(1), ivec2(640, 480));
    EXPECT_EQ(size_of(4).x / 640, 2);
    EXPECT_EQ(size_of(6).x / 640, 3);
    EXPECT_EQ(size_of(9).x / 640, 3);
}

TEST(Sheet, RefusesWhatDoesNotFitTogether)
{
    std::vector<Drawing> drawings(2, test::sample_drawing());
    EXPECT_THROW(make_sheet({}), Error::Input);
    EXPECT_THROW(make_sheet(drawings, {.captions = {"one"}}), Error::Input);
    drawings[1].mm_per_pixel = 2;
    EXPECT_THROW(make_sheet(drawings), Error::Input);
}

TEST(Sheet, WritesItsCaptionsUnderThePictures)
{
    const std::vector<Drawing> drawings(2, test::sample_drawing());
    const Drawing sheet = make_sheet(drawings, {.columns = 1, .captions = {"front", "az 45, el 35"}});
    ASSERT_EQ(sheet.captions.size(), 2u);
    EXPECT_EQ(sheet.captions[0].position.x, 320);
    EXPECT_GT(sheet.captions[0].position.y - sheet.captions[0].height, 480);
    EXPECT_NE(to_svg(sheet).find("id=\"captions\""), std::string::npos);
}

TEST(Lettering, StaysBetweenBaseAndCapitalLineAndIsCentred)
{
    dvec2 low(1e9), high(-1e9);
    for (const auto& line : letter("The quick brown fox, 0123456789 +-/:()=_' jumps over lazy dogs: 45\xc2\xb0.")) {
        EXPECT_GE(line.size(), 2u);
        for (const dvec2& p : line) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    EXPECT_EQ(low.y, -1);
    EXPECT_EQ(high.y, 0);
    EXPECT_NEAR(low.x, -high.x, 1e-9);
}

TEST(Lettering, GivesUnknownSignsABoxAndSpacesNothing)
{
    EXPECT_EQ(letter("\xe2\x82\xac").size(), 1u); // one sign of three bytes
    EXPECT_EQ(letter("?")[0].size(), 5u);
    EXPECT_TRUE(letter("  ").empty());
    EXPECT_TRUE(letter("").empty());
    EXPECT_EQ(letter("a").size(), letter("A").size());
}

} // namespace
} // namespace limn
