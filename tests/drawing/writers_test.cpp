#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <sstream>

#include <nlohmann/json.hpp>

#include "drawing/sample_drawing.h"
#include "limn/base/error.h"
#include "limn/drawing/dxf.h"
#include "limn/drawing/json.h"
#include "limn/drawing/pdf.h"
#include "limn/drawing/ply_lines.h"
#include "limn/drawing/png.h"
#include "limn/drawing/raster.h"
#include "limn/drawing/write_drawing.h"
#include "support/image_compare.h"
#include "support/support.h"

namespace limn {
namespace {

std::string message_of(const std::function<void()>& act)
{
    try {
        act();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

// --- PDF

TEST(Pdf, HasTheSameBytesTwiceAndTheSizeOfItsPage)
{
    Style style;
    style.page = page_from_text("A4");
    const std::string pdf = to_pdf(test::sample_drawing(), style);
    EXPECT_EQ(pdf, to_pdf(test::sample_drawing(), style));
    EXPECT_TRUE(pdf.starts_with("%PDF-"));
    double width = 0, height = 0;
    std::sscanf(pdf.c_str() + std::min(pdf.find("/MediaBox"), pdf.size()), "/MediaBox [ 0 0 %lf %lf", &width, &height);
    EXPECT_NEAR(width, 297 * 72 / 25.4, 1e-3); // landscape, as the picture
    EXPECT_NEAR(height, 210 * 72 / 25.4, 1e-3);
}

TEST(Pdf, RasterisedElsewhereLooksLikeThePng)
{
    if (test::run_shell("command -v pdftoppm").exit_code != 0)
        GTEST_SKIP() << "pdftoppm (package poppler-utils) is not installed";
    const test::TemporaryFolder folder;
    for (const Look look : {Look::coloured, Look::dark}) {
        const Drawing drawing = look == Look::coloured ? test::sample_drawing() : test::sample_with_background();
        write_pdf(drawing, folder / "a.pdf", Style(look));
        const auto result = test::run_shell(fmt::format("pdftoppm -png -r 96 -singlefile '{0}/a.pdf' '{0}/a'", folder.path().string()));
        ASSERT_EQ(result.exit_code, 0) << result.errors;
        const Image ours = rasterise(drawing, Style(look)), theirs = read_png(folder / "a.png");
        ASSERT_EQ(ours.size(), theirs.size());
        EXPECT_GE(test::lowest_tile_ssim(ours, theirs), 0.95) << test::write_difference(ours, theirs, "pdf");
    }
}

// --- DXF

/// A polyline as a reader of release 12 files finds it.
struct Polyline {
    std::string layer;
    bool closed = false;
    std::vector<dvec2> points;
};

struct DxfFile {
    std::vector<Polyline> lines;
    std::map<std::string, std::string> layers; ///< name to line type
};

DxfFile read_dxf(const std::string& text)
{
    std::istringstream in(text);
    std::vector<std::pair<int, std::string>> groups;
    for (std::string code, value; std::getline(in, code) && std::getline(in, value);)
        groups.push_back({std::stoi(code), value});
    DxfFile file;
    std::string kind, layer_entry;
    for (const auto& [code, value] : groups) {
        if (code == 0) {
            kind = value;
            if (kind == "POLYLINE")
                file.lines.emplace_back();
            if (kind == "VERTEX")
                file.lines.back().points.emplace_back();
        } else if (kind == "LAYER" && code == 2) {
            layer_entry = value;
        } else if (kind == "LAYER" && code == 6) {
            file.layers[layer_entry] = value;
        } else if (kind == "POLYLINE" && code == 8) {
            file.lines.back().layer = value;
        } else if (kind == "POLYLINE" && code == 70) {
            file.lines.back().closed = value == "1";
        } else if (kind == "VERTEX" && (code == 10 || code == 20)) {
            file.lines.back().points.back()[code == 10 ? 0 : 1] = std::stod(value);
        }
    }
    EXPECT_EQ(groups.back(), std::pair(0, std::string("EOF")));
    return file;
}

TEST(Dxf, HoldsEveryStrokeInMillimetresWithYUpOnItsLayer)
{
    Drawing drawing = test::sample_drawing();
    drawing.mm_per_pixel = 0.5;
    const DxfFile file = read_dxf(to_dxf(drawing));
    ASSERT_EQ(file.lines.size(), drawing.strokes.size());
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
        const Stroke& stroke = drawing.strokes[i];
        EXPECT_EQ(file.lines[i].closed, stroke.closed);
        EXPECT_TRUE(file.layers.contains(file.lines[i].layer)) << file.lines[i].layer;
        ASSERT_EQ(file.lines[i].points.size(), stroke.points.size());
        for (std::size_t k = 0; k < stroke.points.size(); ++k) {
            EXPECT_NEAR(file.lines[i].points[k].x, 0.5 * stroke.points[k].x, 1e-4);
            EXPECT_NEAR(file.lines[i].points[k].y, 240 - 0.5 * stroke.points[k].y, 1e-4);
        }
    }
    EXPECT_EQ(file.layers.at("HIDDEN_CONTOUR"), "DASHED");
    EXPECT_EQ(file.layers.at("SUGGESTIVE"), "CONTINUOUS");
}

// --- JSON

TEST(DrawingJson, HoldsCameraAndEveryStrokeWithItsFields)
{
    Drawing drawing = test::sample_drawing();
    drawing.strokes[0].faces[0] = none;
    drawing.regions[0].name = "a \"name\"\n";
    const auto json = nlohmann::json::parse(to_json(drawing));
    EXPECT_EQ(json["camera"]["size"][0], 640);
    ASSERT_EQ(json["strokes"].size(), drawing.strokes.size());
    EXPECT_EQ(json["regions"][0]["name"], "a \"name\"\n");
    EXPECT_EQ(json["regions"][0]["rings"].size(), 2u);
    EXPECT_TRUE(json["strokes"][0]["faces"][0].is_null());
    for (std::size_t i = 0; i < drawing.strokes.size(); ++i) {
        const Stroke& stroke = drawing.strokes[i];
        const auto& read = json["strokes"][i];
        EXPECT_EQ(line_type_from_name(read["type"].get<std::string>()), stroke.type);
        EXPECT_EQ(read["visible"], stroke.visible);
        EXPECT_EQ(read["closed"], stroke.closed);
        ASSERT_EQ(read["points"].size(), stroke.points.size());
        ASSERT_EQ(read["world"].size(), stroke.world.size());
        ASSERT_EQ(read["ink"].size(), stroke.ink.size());
        for (std::size_t k = 0; k < stroke.world.size(); ++k) {
            EXPECT_NEAR(read["points"][k][1].get<double>(), stroke.points[k].y, 1e-4);
            EXPECT_EQ(read["world"][k][2].get<double>(), stroke.world[k].z);
            EXPECT_NEAR(read["ink"][k].get<double>(), double(stroke.ink[k]), 1e-4);
        }
    }
}

// --- PLY

TEST(PlyLines, HoldsEverySegmentWithItsTypeAndInk)
{
    Drawing drawing = test::sample_drawing();
    drawing.strokes.erase(drawing.strokes.begin() + 13); // the box, which stands nowhere in space
    std::erase_if(drawing.strokes, [](const Stroke& s) { return s.world.empty(); });
    const std::string ply = to_ply_lines(drawing);
    const std::size_t body = ply.find("end_header\n") + 11;
    std::size_t vertices = 0, edges = 0;
    for (const Stroke& stroke : drawing.strokes) {
        vertices += stroke.points.size();
        edges += stroke.points.size() - (stroke.closed ? 0 : 1);
    }
    EXPECT_NE(ply.find(fmt::format("element vertex {}\n", vertices)), std::string::npos);
    EXPECT_NE(ply.find(fmt::format("element edge {}\n", edges)), std::string::npos);
    EXPECT_NE(ply.find("10=contour"), std::string::npos);
    ASSERT_EQ(ply.size(), body + vertices * 28 + edges * 14);
    std::size_t vertex = 0, edge = 0;
    for (const Stroke& stroke : drawing.strokes) {
        const std::size_t first = vertex, n = stroke.points.size();
        for (std::size_t i = 0; i < n; ++i, ++vertex) {
            double p[3];
            float ink;
            std::memcpy(p, ply.data() + body + vertex * 28, 24);
            std::memcpy(&ink, ply.data() + body + vertex * 28 + 24, 4);
            EXPECT_EQ(dvec3(p[0], p[1], p[2]), stroke.world[i]);
            EXPECT_EQ(ink, stroke.ink[i]);
        }
        for (std::size_t i = 0; i + (stroke.closed ? 0 : 1) < n; ++i, ++edge) {
            std::int32_t ends[2];
            const char* at = ply.data() + body + vertices * 28 + edge * 14;
            std::memcpy(ends, at, 8);
            EXPECT_EQ(ends[0], std::int32_t(first + i));
            EXPECT_EQ(ends[1], std::int32_t(first + (i + 1) % n));
            EXPECT_EQ(LineType(at[8]), stroke.type);
        }
    }
    drawing.strokes[0].world.clear();
    EXPECT_THROW(to_ply_lines(drawing), Error::Input);
}

// --- all of them

TEST(WriteDrawing, ChoosesTheFormatByTheEnding)
{
    const test::TemporaryFolder folder;
    Drawing drawing = test::sample_drawing();
    std::erase_if(drawing.strokes, [](const Stroke& s) { return s.world.empty(); });
    const std::map<std::string, std::string> beginnings = {{"svg", "<?xml"}, {"pdf", "%PDF"}, {"png", "\x89PNG"}, {"dxf", "999\n"}, {"json", "{\"camera\""}, {"ply", "ply\n"}};
    ASSERT_EQ(beginnings.size(), drawing_formats().size());
    for (const auto& [format, beginning] : beginnings) {
        write_drawing(drawing, {}, folder / ("a." + format));
        EXPECT_TRUE(test::read_text(folder / ("a." + format)).starts_with(beginning)) << format;
        write_drawing(drawing, {}, folder / "b", format);
        EXPECT_EQ(test::read_text(folder / "b"), test::read_text(folder / ("a." + format)));
        EXPECT_THROW(write_drawing(drawing, {}, "/dev/full", format), Error::Write);
    }
}

TEST(WriteDrawing, NamesTheKnownFormatsForAnUnknownOne)
{
    for (const auto& [path, format] : {std::pair("a.gif", ""), std::pair("a", ""), std::pair("-", ""), std::pair("a.svg", "gif")}) {
        const std::string message = message_of([&, p = path, f = format] { write_drawing({}, {}, p, f); });
        EXPECT_NE(message.find("svg, pdf, png, dxf, json, ply"), std::string::npos) << path << ": " << message;
    }
}

} // namespace
} // namespace limn
