#include <gtest/gtest.h>

#include <algorithm>

#include "drawing/sample_drawing.h"
#include "limn/base/error.h"
#include "limn/drawing/lettering.h"
#include "limn/drawing/sheet.h"
#include "limn/drawing/svg.h"

namespace limn {
namespace {

TEST(Sheet, PutsEverythingToItsPlace)
{
    std::vector<Drawing> pictures(3, test::sample_with_background());
    pictures[1].background = Image();
    const std::vector<ivec2> corners = {{0, 0}, {660, 0}, {100, 500}};
    const Drawing sheet = lay_on_sheet(pictures, corners, {1300, 1000});
    EXPECT_EQ(sheet.camera.size, ivec2(1300, 1000));
    EXPECT_EQ(sheet.background.size(), sheet.camera.size);
    EXPECT_EQ(sheet.strokes.size(), 3 * pictures[0].strokes.size());
    EXPECT_TRUE(std::is_sorted(sheet.strokes.begin(), sheet.strokes.end(), [](const Stroke& a, const Stroke& b) { return a.type < b.type; }));
    EXPECT_EQ(sheet.background.at(100 + 300, 500 + 250)[0], pictures[0].background.at(300, 250)[0]);
    EXPECT_EQ(sheet.background.at(660 + 300, 250)[0], 1.0f);
    const dvec2 first = pictures[0].strokes[0].points[0]; // strokes of one type stay in the order of the pictures
    EXPECT_EQ(sheet.strokes[0].points[0], first);
    EXPECT_EQ(sheet.strokes[4].points[0], first + dvec2(660, 0));
    EXPECT_EQ(sheet.strokes[8].points[0], first + dvec2(100, 500));
}

TEST(Sheet, KeepsRegionsOfOneKindTogether)
{
    std::vector<Drawing> pictures(2, test::sample_drawing());
    for (Drawing& picture : pictures) {
        picture.regions.push_back(picture.regions[0]);
        picture.regions[1].name = "toon";
    }
    const Drawing sheet = lay_on_sheet(pictures, std::vector<ivec2>{{0, 0}, {640, 0}}, {1280, 480});
    ASSERT_EQ(sheet.regions.size(), 4u);
    EXPECT_EQ(sheet.regions[1].name, "silhouette");
    EXPECT_EQ(sheet.regions[1].rings[0][0], pictures[0].regions[0].rings[0][0] + dvec2(640, 0));
    EXPECT_EQ(sheet.regions[2].name, "toon");
}

TEST(Sheet, RefusesWhatDoesNotFitTogether)
{
    std::vector<Drawing> pictures(2, test::sample_drawing());
    const std::vector<ivec2> corners = {{0, 0}, {640, 0}};
    EXPECT_THROW(lay_on_sheet({}, {}, {10, 10}), Error::Input);
    EXPECT_THROW(lay_on_sheet(pictures, corners, {1279, 480}), Error::Input);
    EXPECT_THROW(lay_on_sheet(pictures, std::vector<ivec2>(1), {1280, 480}), Error::Input);
    EXPECT_THROW(lay_on_sheet(pictures, corners, {1280, 480}, std::vector<std::string>{"one"}), Error::Input);
    pictures[1].mm_per_pixel = 2;
    EXPECT_THROW(lay_on_sheet(pictures, corners, {1280, 480}), Error::Input);
}

TEST(Sheet, WritesItsCaptionsAtTheBottomOfThePictures)
{
    const std::vector<Drawing> pictures(2, test::sample_drawing());
    const Drawing sheet = lay_on_sheet(pictures, std::vector<ivec2>{{0, 0}, {640, 0}}, {1280, 480}, std::vector<std::string>{"front", "az 45, el 35"});
    ASSERT_EQ(sheet.captions.size(), 2u);
    EXPECT_EQ(sheet.captions[1].position.x, 960);
    EXPECT_LT(sheet.captions[1].position.y, 480);
    EXPECT_GT(sheet.captions[1].position.y - sheet.captions[1].height, 450);
    const std::string svg = to_svg(sheet);
    EXPECT_NE(svg.find("id=\"captions\""), std::string::npos);
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
