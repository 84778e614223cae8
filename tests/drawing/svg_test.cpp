#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <regex>
#include <set>

#include "drawing/sample_drawing.h"
#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/drawing/png.h"
#include "limn/drawing/raster.h"
#include "limn/drawing/svg.h"
#include "support/image_compare.h"
#include "support/support.h"

namespace limn {
namespace {

bool have(const std::string& program) { return test::run_shell("command -v " + program).exit_code == 0; }

std::size_t count(const std::string& text, const std::string& what)
{
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size()))
        ++n;
    return n;
}

/// The SVG as rsvg-convert paints it at the drawing's resolution, on white.
Image rasterised_by_rsvg(const std::string& svg, ivec2 size)
{
    const test::TemporaryFolder folder;
    test::write_text(folder / "a.svg", svg);
    const auto result = test::run_shell(fmt::format("rsvg-convert -b white -w {} -h {} '{}' -o '{}'", size.x, size.y, (folder / "a.svg").string(), (folder / "a.png").string()));
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    Image rgba = read_png(folder / "a.png");
    Image rgb(rgba.size(), 3);
    for (int y = 0; y < rgb.height; ++y)
        for (int x = 0; x < rgb.width; ++x)
            std::copy_n(rgba.at(x, y), 3, rgb.at(x, y));
    return rgb;
}

void expect_svg_looks_like_png(const Drawing& drawing, const Style& style, const std::string& name)
{
    const Image ours = rasterise(drawing, style);
    const Image theirs = rasterised_by_rsvg(to_svg(drawing, style), ours.size());
    ASSERT_EQ(ours.size(), theirs.size());
    const double similarity = test::lowest_tile_ssim(ours, theirs);
    EXPECT_GE(similarity, 0.95) << "see " << test::write_difference(ours, theirs, "svg-" + name);
}

// Checklist 33: SVG re-rasterised equals the line image, SSIM >= 0.95, here in every tile of it.
TEST(Svg, RasterisedElsewhereLooksLikeThePngInEveryStyle)
{
    if (!have("rsvg-convert"))
        GTEST_SKIP() << "rsvg-convert (package librsvg2-bin) is not installed";
    for (const auto& [look, name] : {std::pair(Look::plain, "plain"), std::pair(Look::coloured, "coloured"), std::pair(Look::dark, "dark"), std::pair(Look::toon, "toon")})
        for (const StrokeMode mode : {StrokeMode::line, StrokeMode::outline})
            for (const char* page : {"none", "A4", "120x160mm"}) {
                Style style(look);
                style.stroke = mode;
                style.page = page_from_text(page);
                const Drawing drawing = look == Look::plain || look == Look::coloured ? test::sample_drawing() : test::sample_with_background();
                expect_svg_looks_like_png(drawing, style, fmt::format("{}-{}-{}", name, mode == StrokeMode::line ? "line" : "outline", page));
            }
}

// The guard: the comparison above can fail.
TEST(Svg, ComparisonWithThePngMissesNoStroke)
{
    const Drawing whole = test::sample_drawing();
    const Image picture = rasterise(whole);
    for (std::size_t i = 0; i < whole.strokes.size(); ++i) {
        Drawing less = whole;
        less.strokes.erase(less.strokes.begin() + std::ptrdiff_t(i));
        EXPECT_LT(test::lowest_tile_ssim(picture, rasterise(less)), 0.95) << "without stroke " << i;
    }
}

TEST(Svg, IsValidXml)
{
    if (!have("xmllint"))
        GTEST_SKIP() << "xmllint (package libxml2-utils) is not installed";
    const test::TemporaryFolder folder;
    Drawing drawing = test::sample_with_background();
    drawing.regions = test::sample_drawing().regions;
    drawing.regions[0].name = "a<b>&\"c\"";
    write_svg(drawing, folder / "a.svg", Style(Look::dark));
    const auto result = test::run_shell("xmllint --noout '" + (folder / "a.svg").string() + "'");
    EXPECT_EQ(result.exit_code, 0) << result.errors;
}

TEST(Svg, HasOneGroupForEachLineTypeWithIdAndInkscapeLabelInDrawingOrder)
{
    const std::string svg = to_svg(test::sample_drawing());
    std::size_t last = 0;
    for (const auto& [id, label] : {std::pair("fill-silhouette", "Fill: silhouette"), std::pair("hidden-contour", "Hidden: Contours"),
                                    std::pair("highlight", "Suggestive highlights"), std::pair("suggestive", "Suggestive contours"), std::pair("crease", "Creases"),
                                    std::pair("border", "Borders"), std::pair("contour", "Contours")}) {
        const std::string group = fmt::format("<g id=\"{}\" inkscape:groupmode=\"layer\" inkscape:label=\"{}\"", id, label);
        EXPECT_EQ(count(svg, group), 1u) << group;
        EXPECT_GT(svg.find(group), last) << group;
        last = svg.find(group);
    }
    EXPECT_EQ(count(svg, "inkscape:groupmode=\"layer\""), 7u);
}

TEST(Svg, DrawsFadingInAtMostEightStepsOfOpacity)
{
    std::set<std::string> steps;
    const std::string svg = to_svg(test::sample_drawing());
    const std::regex opacity("<path[^>]* opacity=\"([^\"]*)\"");
    for (auto i = std::sregex_iterator(svg.begin(), svg.end(), opacity); i != std::sregex_iterator(); ++i)
        steps.insert((*i)[1]);
    EXPECT_LE(steps.size(), 7u); // the eighth is 1 and is not written
    EXPECT_GE(steps.size(), 6u);
}

TEST(Svg, TakesAtMostTwentyBytesForEachPoint)
{
    for (const bool curves : {false, true}) {
        for (const char* page : {"none", "A3"}) {
            Style style;
            style.curves = curves;
            style.page = page_from_text(page);
            Drawing drawing;
            for (int k = 0; k < 5; ++k)
                drawing.strokes.push_back(test::stroke_along(LineType::contour, 2000, [&](double t) { return dvec2(30 + 1500 * t, 600 + 400 * std::sin(40 * t + k)); }));
            EXPECT_LE(double(to_svg(drawing, style).size()) / (5 * 2000), 20.0);
        }
    }
}

TEST(Svg, WritesAbsoluteCoordinatesWithoutExponents)
{
    Drawing drawing = test::sample_drawing();
    Stroke tiny = test::stroke_along(LineType::contour, 5, [](double t) { return dvec2(1e-9 * t - 0.004, 5e-7 * t); });
    drawing.strokes.push_back(tiny);
    const std::string svg = to_svg(drawing);
    const std::regex path("<path d=\"([^\"]*)\"");
    for (auto i = std::sregex_iterator(svg.begin(), svg.end(), path); i != std::sregex_iterator(); ++i)
        EXPECT_EQ((*i)[1].str().find_first_not_of("MLCZ 0123456789.-"), std::string::npos) << (*i)[1];
    EXPECT_EQ(svg.find("-0 "), std::string::npos);
}

TEST(Svg, IsTheSameForAnyNumberOfThreads)
{
    const Drawing drawing = test::sample_drawing();
    for (const StrokeMode mode : {StrokeMode::line, StrokeMode::outline}) {
        Style style;
        style.stroke = mode;
        EXPECT_EQ(with_threads(1, [&] { return to_svg(drawing, style); }), with_threads(4, [&] { return to_svg(drawing, style); }));
    }
}

TEST(Svg, PutsTheDrawingOnThePageAtItsTrueScale)
{
    Drawing drawing = test::sample_drawing();
    drawing.mm_per_pixel = 0.125;
    Style style;
    EXPECT_NE(to_svg(drawing, style).find("width=\"80mm\" height=\"60mm\" viewBox=\"0 0 80 60\""), std::string::npos);
    style.page = page_from_text("A4");
    EXPECT_NE(to_svg(drawing, style).find("width=\"297mm\" height=\"210mm\""), std::string::npos);
    EXPECT_DOUBLE_EQ(lay_out(drawing, style).scale, 0.125);
    drawing.mm_per_pixel = 1;
    EXPECT_THROW(to_svg(drawing, style), Error::Input);
}

TEST(Svg, LeavesNoHalfFileOnAFullDisk)
{
    EXPECT_THROW(write_svg(test::sample_drawing(), "/dev/full"), Error::Write);
    EXPECT_THROW(write_drawing_png(test::sample_drawing(), "/dev/full"), Error::Write);
    const test::TemporaryFolder folder;
    EXPECT_THROW(write_svg(test::sample_drawing(), folder / "missing" / "a.svg"), Error::Write);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Svg, HoldsNothingForAnEmptyDrawing)
{
    const std::string svg = to_svg(Drawing());
    EXPECT_EQ(count(svg, "<g"), 0u);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

} // namespace
} // namespace limn
