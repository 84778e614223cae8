#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/drawing/drawing.h"
#include "limn/drawing/style.h"

namespace limn {
namespace {

std::string message_of(const std::function<void()>& act)
{
    try {
        act();
    } catch (const Error::Input& error) {
        return error.what();
    }
    return "";
}

TEST(LineTypes, HaveNamesThatReadBack)
{
    for (int i = 0; i < line_type_count; ++i)
        EXPECT_EQ(line_type_from_name(line_type_name(LineType(i))), LineType(i));
    const std::string message = message_of([] { line_type_from_name("contuor"); });
    EXPECT_NE(message.find("'contuor'"), std::string::npos);
    EXPECT_NE(message.find("mesh-contour"), std::string::npos);
}

TEST(Style, ReadsWidthsForOneOrAllTypes)
{
    Style style;
    style.set_widths("contour=0.5mm,suggestive=0.3");
    EXPECT_EQ(style.line(LineType::contour).width_mm, 0.5);
    EXPECT_EQ(style.line(LineType::suggestive).width_mm, 0.3);
    EXPECT_EQ(style.line(LineType::crease).width_mm, Style().line(LineType::crease).width_mm);
    style.set_widths("0.25mm,contour=1mm");
    EXPECT_EQ(style.line(LineType::crease).width_mm, 0.25);
    EXPECT_EQ(style.line(LineType::contour).width_mm, 1);
}

TEST(Style, NamesThePartOfAWidthThatIsWrong)
{
    const auto message = [](const char* text) { return message_of([=] { Style().set_widths(text); }); };
    EXPECT_NE(message("contour=0.5px").find("'0.5px' is not a number"), std::string::npos) << message("contour=0.5px");
    EXPECT_NE(message("contuor=1").find("--width: line type 'contuor' is none of"), std::string::npos);
    EXPECT_NE(message("contour=0").find("outside 0.01..50 mm"), std::string::npos);
    EXPECT_NE(message("contour=-1mm").find("outside"), std::string::npos);
    EXPECT_NE(message("contour=nan").find("not a number"), std::string::npos);
    EXPECT_NE(message("contour=").find("not a number"), std::string::npos);
    EXPECT_NE(message("").find("missing"), std::string::npos);
    EXPECT_NE(message("contour=1,").find("missing"), std::string::npos);
}

TEST(Style, ReadsColours)
{
    Style style;
    style.set_colours("crease=#ff8000");
    EXPECT_EQ(style.line(LineType::crease).colour, vec3(1, 128 / 255.0f, 0));
    for (const char* wrong : {"crease=ff8000", "crease=#ff80", "#gg0000", "crease=#ff80000"})
        EXPECT_NE(message_of([&] { style.set_colours(wrong); }).find("#RRGGBB"), std::string::npos) << wrong;
}

TEST(Page, ReadsNamesAndLengths)
{
    EXPECT_EQ(page_from_text("A4").width_mm, 210);
    EXPECT_TRUE(page_from_text("a4").turns);
    EXPECT_EQ(page_from_text("A3-landscape").width_mm, 420);
    EXPECT_FALSE(page_from_text("A3-landscape").turns);
    EXPECT_EQ(page_from_text("letter").height_mm, 279.4);
    EXPECT_EQ(page_from_text("100x50.5mm").height_mm, 50.5);
    EXPECT_TRUE(page_from_text("none").empty());
    for (const char* wrong : {"A44", "100", "100xmm", "x", "100x50cm", "axb"})
        EXPECT_NE(message_of([&] { page_from_text(wrong); }).find(fmt::format("'{}'", wrong)), std::string::npos) << wrong;
    EXPECT_NE(message_of([] { page_from_text("0x10mm"); }).find("outside 10..20000 mm"), std::string::npos);
}

TEST(Style, OptionsTakeBackWhatTheyPrint)
{
    for (const auto& row : style_option_table()) {
        Style style(Look::coloured);
        style.page = page_from_text("A3-landscape");
        style.set_widths("0.45mm,contour=0.6mm");
        const std::string text = row.get(style);
        Style other;
        row.set(other, text);
        EXPECT_EQ(row.get(other), text) << row.name;
        EXPECT_FALSE(row.help.empty());
    }
}

TEST(Style, LooksSetColoursAndKeepWidths)
{
    Style style;
    style.set_widths("contour=0.9mm");
    style.set_look(Look::dark);
    EXPECT_EQ(style.line(LineType::highlight).colour, vec3(1));
    EXPECT_EQ(style.line(LineType::contour).colour, vec3(0));
    EXPECT_EQ(style.line(LineType::contour).width_mm, 0.9);
}

} // namespace
} // namespace limn
