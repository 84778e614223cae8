// The pictures of `limn draw`: checklist items 15 and 33 of the contour-lines specification.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "command/command.h"
#include "limn/drawing/drawing.h"
#include "limn/drawing/png.h"
#include "support/image_compare.h"

namespace limn::test {
namespace {

using Json = nlohmann::json;

/// A folder with a blob in it.
class Look : public testing::Test {
protected:
    Look() { write_text(folder_ / "blob.obj", obj_text(mesh_)); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    void draw(const std::string& arguments) const
    {
        const ProgramResult result = limn("draw " + path("blob.obj") + " --size 400x300 --quiet " + arguments);
        ASSERT_EQ(result.exit_code, 0) << result.errors;
    }
    Image picture(const std::string& arguments) const
    {
        draw(arguments + " -o " + path("a.png"));
        return read_png(path("a.png"));
    }

    TemporaryFolder folder_;
    Mesh mesh_ = make_shape({.name = "blob", .triangles = 20000}).mesh;
};

float lightness(const Image& image, int x, int y) { return (image.at(x, y)[0] + image.at(x, y)[1] + image.at(x, y)[2]) / 3; }

/// What lines did to a picture: how many pixels changed of those that were black, white or between, and in which direction.
struct Change {
    int black = 0, white = 0, between = 0, darker = 0, lighter = 0;
};

Change change(const Image& before, const Image& after)
{
    Change c;
    for (int y = 0; y < before.height; ++y)
        for (int x = 0; x < before.width; ++x) {
            const float a = lightness(before, x, y), b = lightness(after, x, y);
            if (std::abs(a - b) < 1.5f / 255)
                continue;
            ++(a < 1.5f / 255 ? c.black : a > 253.5f / 255 ? c.white : c.between);
            ++(b < a ? c.darker : c.lighter);
        }
    return c;
}

// Checklist 15: in black and white areas, suggestive contours show on white and highlights on black.
TEST_F(Look, ToonShowsSuggestiveContoursOnWhiteAndHighlightsOnBlack)
{
    const std::string style = "--style toon --highlight-limit 0.005 --suggestive-limit 0.005 --lines ";
    const Image areas = picture(style + "contour");
    const Change suggestive = change(areas, picture(style + "contour,suggestive")), highlight = change(areas, picture(style + "contour,highlight"));
    EXPECT_EQ(suggestive.black, 0);
    EXPECT_EQ(suggestive.lighter, 0);
    EXPECT_GT(suggestive.white, 50);
    EXPECT_EQ(highlight.white, 0);
    EXPECT_EQ(highlight.darker, 0);
    EXPECT_GT(highlight.black, 50);
}

// Checklist 15: on a dark shape, suggestive contours are darker and highlights lighter than it.
TEST_F(Look, DarkShowsBlackLinesAndWhiteHighlightsOnADarkShape)
{
    const std::string style = "--style dark --lines ";
    const Image shape = picture(style + "contour");
    const float fill = lightness(shape, 200, 150);
    EXPECT_GT(fill, 0.2f);
    EXPECT_LT(fill, 0.6f);
    EXPECT_GT(lightness(shape, 2, 2), 0.99f);
    const Change suggestive = change(shape, picture(style + "contour,suggestive")), highlight = change(shape, picture(style + "contour,highlight"));
    EXPECT_GT(suggestive.darker, 50);
    EXPECT_EQ(suggestive.lighter, 0);
    EXPECT_GT(highlight.lighter, 50);
    EXPECT_EQ(highlight.white, 0);
}

// Checklist 33: the SVG, painted by another program, looks like the PNG.
TEST_F(Look, SvgPaintedElsewhereLooksLikeThePng)
{
    if (run_shell("command -v rsvg-convert").exit_code != 0)
        GTEST_SKIP() << "rsvg-convert (package librsvg2-bin) is not installed";
    int k = 0;
    for (const std::string options : {"", "--style toon", "--style dark --stroke outline", "--style coloured --lines all --hidden dash", "--page A5"}) {
        draw(options + " -o " + path("b.svg") + " -o " + path("b.png"));
        const Image ours = read_png(path("b.png"));
        const ProgramResult painted =
            run_shell(fmt::format("rsvg-convert -b white -w {} -h {} '{}' -o '{}'", ours.width, ours.height, path("b.svg"), path("c.png")));
        ASSERT_EQ(painted.exit_code, 0) << painted.errors;
        const Image theirs = read_png(path("c.png"));
        Image rgb(theirs.size(), 3);
        for (int y = 0; y < rgb.height; ++y)
            for (int x = 0; x < rgb.width; ++x)
                std::copy_n(theirs.at(x, y), 3, rgb.at(x, y));
        EXPECT_GE(ssim(ours, rgb), 0.95) << "'" << options << "', see " << write_difference(ours, rgb, fmt::format("command-{}", k));
        ++k;
    }
}

/// How far p is from a face of a mesh: from its plane, and outside its edges by barycentric coordinates times its size.
double distance_from_face(const Mesh& mesh, std::uint32_t face, const dvec3& p)
{
    const uvec3& t = mesh.triangles[face];
    const dvec3 a = mesh.positions[t.x], u = mesh.positions[t.y] - a, v = mesh.positions[t.z] - a, n = glm::cross(u, v);
    const double area = glm::dot(n, n), s = glm::dot(glm::cross(p - a, v), n) / area, r = glm::dot(glm::cross(u, p - a), n) / area;
    return std::abs(glm::dot(p - a, n)) / std::sqrt(area) + std::max({0.0, -s, -r, s + r - 1}) * std::sqrt(std::sqrt(area));
}

// Checklist 33: exports hold type, ink and face of every segment.
TEST_F(Look, JsonHoldsTypeInkAndFaceOfEveryPoint)
{
    draw("--lines contour,suggestive,highlight --hidden keep -o " + path("a.json"));
    const Json drawing = Json::parse(read_text(folder_ / "a.json"));
    std::map<std::string, int> strokes;
    std::size_t hidden = 0, points = 0;
    for (const Json& stroke : drawing["strokes"]) {
        ++strokes[stroke["type"].get<std::string>()];
        hidden += !stroke["visible"].get<bool>();
        ASSERT_EQ(stroke["ink"].size(), stroke["points"].size());
        ASSERT_EQ(stroke["faces"].size(), stroke["points"].size());
        for (std::size_t i = 0; i < stroke["ink"].size(); ++i, ++points) {
            ASSERT_TRUE(stroke["ink"][i].get<double>() >= 0 && stroke["ink"][i].get<double>() <= 1);
            const dvec3 p(stroke["world"][i][0].get<double>(), stroke["world"][i][1].get<double>(), stroke["world"][i][2].get<double>());
            ASSERT_LT(distance_from_face(mesh_, stroke["faces"][i].get<std::uint32_t>(), p), 1e-5);
        }
    }
    EXPECT_EQ(strokes.size(), 3u);
    EXPECT_GT(hidden, 0u);
    EXPECT_GT(points, 200u);
}

/// The numbers of one line of a PLY header that follow a name.
std::size_t count_in_header(const std::string& ply, const std::string& name)
{
    const std::size_t at = ply.find("element " + name + " ");
    return at == std::string::npos ? 0 : std::stoul(ply.substr(at + 9 + name.size()));
}

template <class T> T value_at(const std::string& bytes, std::size_t at)
{
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

TEST_F(Look, PlyHoldsTypeInkAndFaceOfEverySegment)
{
    draw("--lines contour,suggestive -o " + path("a.ply"));
    const std::string ply = read_text(folder_ / "a.ply");
    const std::size_t vertices = count_in_header(ply, "vertex"), edges = count_in_header(ply, "edge"), body = ply.find("end_header\n") + 11;
    for (const char* property : {"property float ink", "property uchar type", "property uint face"})
        EXPECT_NE(ply.find(property), std::string::npos) << property;
    ASSERT_GT(edges, 100u);
    ASSERT_EQ(ply.size(), body + 28 * vertices + 14 * edges);
    std::array<int, line_type_count> types = {};
    for (std::size_t e = 0; e < edges; ++e) {
        const std::size_t at = body + 28 * vertices + 14 * e;
        ++types.at(std::size_t(ply[at + 8]));
        const auto start = value_at<std::int32_t>(ply, at);
        const dvec3 p(value_at<double>(ply, body + 28 * std::size_t(start)), value_at<double>(ply, body + 28 * std::size_t(start) + 8),
                      value_at<double>(ply, body + 28 * std::size_t(start) + 16));
        ASSERT_LT(distance_from_face(mesh_, value_at<std::uint32_t>(ply, at + 10), p), 1e-5);
    }
    EXPECT_GT(types[std::size_t(LineType::contour)], 50);
    EXPECT_GT(types[std::size_t(LineType::suggestive)], 50);
    EXPECT_EQ(types[std::size_t(LineType::contour)] + types[std::size_t(LineType::suggestive)], int(edges));
}

} // namespace
} // namespace limn::test
