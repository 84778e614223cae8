// What `limn bench pattern` holds prints against (checklist 34 of the procedural structures specification): real steps, FLIP, and the shape of highlights.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "bench_truth.h"
#include "flip.h"
#include "highlight.h"
#include "limn/base/error.h"
#include "limn/base/srgb.h"
#include "limn/surface/shapes.h"
#include "pattern_panels.h"
#include "slicer_truth.h"
#include "stepped_print.h"

namespace limn::test {
namespace {

Image even(float value)
{
    Image image({48, 40}, 3);
    std::fill(image.samples.begin(), image.samples.end(), value);
    return image;
}

float encoded_lightness(double l) { return srgb_from_linear(float(std::pow((l + 16) / 116, 3))); }

// By hand: the largest difference of colour, green to blue after Hunt, is 203.30, to the power 0.7 41.28; its knee is 0.4 of that, 16.51.
TEST(Flip, EvenPicturesDifferAsTheFormulaSaysByHand)
{
    EXPECT_EQ(flip(even(0.4f), even(0.4f)), 0);
    EXPECT_NEAR(flip(even(0), even(1)), 0.9674, 5e-4) << "100^0.7 = 25.12: 0.95 + 0.05 (25.12 - 16.51) / (41.28 - 16.51)";
    EXPECT_NEAR(flip(even(encoded_lightness(50)), even(encoded_lightness(60))), 0.2884, 2e-3) << "10^0.7 = 5.01: 0.95 * 5.01 / 16.51";
    Image green = even(0), blue = even(0);
    for (std::size_t i = 0; i < green.samples.size(); i += 3)
        green.samples[i + 1] = blue.samples[i + 2] = 1;
    EXPECT_NEAR(flip(green, blue), 1, 1e-3);
    EXPECT_NEAR(flip(blue, green), 1, 1e-3);
    EXPECT_THROW(flip(even(0), Image({3, 3}, 3)), Error::Input);
}

TEST(Flip, FineStripesCountLessThanTheirColoursAndEdgesCountMore)
{
    Image stripes = even(0), edge = even(0.45f);
    for (int y = 0; y < stripes.height; ++y)
        for (int x = 0; x < stripes.width; ++x)
            for (int c = 0; c < 3; ++c) {
                stripes.at(x, y)[c] = x % 2 == 0 ? 0.0f : 1.0f;
                edge.at(x, y)[c] = x < 24 ? 0.45f : 0.55f;
            }
    EXPECT_LT(flip(stripes, even(srgb_from_linear(0.5f))), 0.5) << "the eye blurs some of them";
    EXPECT_GT(flip(edge, even(0.45f)), 0.4 * flip(even(0.55f), even(0.45f)));
}

/// Of what faces up, level.
double tread_area(const SteppedPrint& print)
{
    double sum = 0;
    for (const uvec3& t : print.triangles) {
        const dvec3 n = glm::cross(dvec3(print.positions[t.y] - print.positions[t.x]), dvec3(print.positions[t.z] - print.positions[t.x]));
        if (print.normals[t.x].z > 0.999f && print.normals[t.y].z > 0.999f && print.normals[t.z].z > 0.999f)
            sum += 0.5 * n.z;
    }
    return sum;
}

double area_of(const std::vector<dvec2>& ring)
{
    double twice = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const dvec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * twice;
}

TEST(SteppedPrint, SlicesOfAWedgeAreItsRectangles)
{
    const Mesh wedge = print_shapes()[2].mesh;
    const auto rings = slice(wedge, 0.5);
    ASSERT_EQ(rings.size(), 1u);
    EXPECT_NEAR(area_of(rings[0]), 1.3 * 2.2 * 0.5 / 0.85, 1e-9) << "counter-clockwise";
    Mesh open = wedge;
    open.triangles.erase(open.triangles.begin() + 8); // of the high end
    EXPECT_THROW(slice(open, 0.5), Error::Input);
}

TEST(SteppedPrint, PolygonsAreCutIntoTrianglesOfTheirArea)
{
    std::vector<dvec2> star;
    for (int i = 0; i < 40; ++i)
        star.push_back((i % 2 == 0 ? 1.0 : 0.4) * dvec2(std::cos(0.157079632679 * i), std::sin(0.157079632679 * i)));
    double sum = 0;
    const std::vector<uvec3> triangles = cut_polygon(star);
    for (const uvec3& t : triangles) {
        const double area = area_of({star[t.x], star[t.y], star[t.z]});
        EXPECT_GT(area, 0);
        sum += area;
    }
    EXPECT_EQ(triangles.size(), 38u);
    EXPECT_NEAR(sum, area_of(star), 1e-9);
}

double volume_of(const SteppedPrint& print)
{
    double six = 0;
    for (const uvec3& t : print.triangles)
        six += glm::dot(dvec3(print.positions[t.x]), glm::cross(dvec3(print.positions[t.y]), dvec3(print.positions[t.z])));
    return six / 6;
}

TEST(SteppedPrint, FillsWhatItsSlicesDoAndItsNormalsPointOut)
{
    const Mesh sphere = make_shape({.name = "sphere", .triangles = 6000}).mesh;
    const SteppedPrint flat = stepped_print(sphere, {0.04, 0}), beads = stepped_print(sphere, {0.04, 1});
    EXPECT_NEAR(volume_of(flat), 4.18879, 0.02);
    EXPECT_LT(volume_of(beads), volume_of(flat) - 0.01) << "edges are round";
    EXPECT_GT(volume_of(beads), 0.94 * volume_of(flat));
    for (const SteppedPrint* print : {&flat, &beads}) {
        std::size_t inward = 0;
        for (const uvec3& t : print->triangles) {
            const vec3 n = glm::cross(print->positions[t.y] - print->positions[t.x], print->positions[t.z] - print->positions[t.x]);
            inward += glm::dot(n, print->normals[t.x] + print->normals[t.y] + print->normals[t.z]) < -1e-9f;
        }
        EXPECT_LE(inward, print->triangles.size() / 200)
            << "but for slivers at the poles, whose rings are hardly larger than edges are round";
    }
}

TEST(SteppedPrint, TreadsHaveNoHoles)
{
    for (const std::size_t triangles : {std::size_t(4000), std::size_t(30000)})
        for (const double bulge : {0.0, 1.0}) {
            constexpr double height = 0.048;
            double wanted = 0;
            for (double middle = -1 + 0.5 * height; middle < 1; middle += height) {
                const double radius = std::sqrt(1 - middle * middle) - 0.5 * bulge * height;
                wanted += std::numbers::pi * std::max(radius, 0.0) * std::max(radius, 0.0);
            }
            EXPECT_NEAR(tread_area(stepped_print(make_shape({.name = "sphere", .triangles = triangles}).mesh, {height, bulge})) / wanted, 1,
                        triangles < 10000 ? 0.02 : 0.005)
                << triangles << " " << bulge;
        }
}

/// In how many rows a number is lower than that of another column.
std::size_t rows_where_lower(const MarkdownTable& table, std::size_t column, std::size_t than)
{
    std::size_t count = 0;
    for (std::size_t r = 1; r < table.rows().size(); ++r)
        count += std::stod(table.rows()[r][column]) < std::stod(table.rows()[r][than]);
    return count;
}

TEST(Truth, SlowEachModelIsNearestToTheStepsThatItIsOf)
{
    Console console(true);
    const MarkdownTable table = compare_with_truth(120, console).errors;
    ASSERT_EQ(table.rows().size(), 17u);
    for (std::size_t r = 1; r < table.rows().size(); ++r) {
        const std::vector<std::string>& row = table.rows()[r];
        const double slope = std::stod(row[4]), beads = std::stod(row[5]);
        if (row[2] == "beads")
            EXPECT_LT(beads, slope + 0.004) << row[0] << " " << row[1];
        else
            EXPECT_LT(slope, beads) << row[0] << " " << row[1];
        EXPECT_LT(slope, std::stod(row[3]) + 1e-9) << row[0] << " " << row[1];
    }
    const nlohmann::ordered_json json = json_of(table);
    EXPECT_EQ(json.at(0).size(), table.rows()[0].size()) << "every column has a name of its own";
}

TEST(Truth, SlowTheBeadModelIsNearestToWhatASlicerLays)
{
    Console console(true);
    const SlicerTable table = compare_with_slicer(120, console);
    if (table.slicer.empty())
        GTEST_SKIP() << "prusa-slicer is not installed";
    EXPECT_EQ(table.slicer.rfind("PrusaSlicer", 0), 0u) << table.slicer;
    ASSERT_EQ(table.errors.rows().size(), 5u);
    EXPECT_EQ(rows_where_lower(table.errors, 5, 4), 4u) << "beads before flat steps";
    EXPECT_EQ(rows_where_lower(table.errors, 5, 3), 4u) << "and before the seed's";
}

TEST(Highlight, IsAsLongForItsWidthAsItWasDrawn)
{
    const auto drawn = [](double across, double up) {
        Image image({160, 120}, 3);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (int c = 0; c < 3; ++c) {
                    const double u = (x - 70) / across, v = (y - 50) / up;
                    image.at(x, y)[c] = srgb_from_linear(float(0.1 + 0.8 * std::exp(-0.5 * (u * u + v * v))));
                }
        return image;
    };
    const std::vector<std::uint8_t> all(160 * 120, 1);
    const auto round = highlight_of(drawn(8, 8), all, 2), streak = highlight_of(drawn(24, 8), all, 2);
    ASSERT_TRUE(round && streak);
    EXPECT_NEAR(round->aspect, 1, 0.02);
    EXPECT_NEAR(streak->aspect, 3, 0.25);
    EXPECT_NEAR(streak->middle.x, 70.5, 0.5);
    EXPECT_NEAR(streak->middle.y, 50.5, 0.5);
}

TEST(Highlight, IsNoneOnEvenPicturesAndFlatFacesAndOnlyTheBrightestOfTwo)
{
    const std::vector<std::uint8_t> all(160 * 120, 1);
    const auto with = [](auto&& light) {
        Image image({160, 120}, 3);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                std::fill_n(image.at(x, y), 3, srgb_from_linear(float(light(x, y))));
        return image;
    };
    EXPECT_FALSE(highlight_of(with([](int, int) { return 0.4; }), all, 2));
    EXPECT_FALSE(highlight_of(with([](int x, int) { return x < 30 ? 0.6 : 0.2; }), all, 2)) << "a bright face at the outline";
    EXPECT_FALSE(highlight_of(with([](int x, int y) { return 0.3 + 0.001 * x + 0.001 * y; }), all, 2)) << "brightest in a corner";
    const auto two = highlight_of(with([](int x, int y) {
                                      return 0.1 + std::exp(-0.01 * std::hypot(x - 50, y - 60) * std::hypot(x - 50, y - 60)) +
                                             0.8 * std::exp(-0.01 * std::hypot(x - 120, y - 60) * std::hypot(x - 120, y - 60));
                                  }),
                                  all, 2);
    ASSERT_TRUE(two);
    EXPECT_NEAR(two->middle.x, 50.5, 0.5);
    EXPECT_NEAR(two->aspect, 1, 0.05);
}

} // namespace
} // namespace limn::test
