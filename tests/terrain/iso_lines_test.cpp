#include "limn/terrain/iso_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/terrain/terrain_samples.h"

namespace limn {
namespace {

/// A map whose middle is at the origin of `height`.
template <class Height> HeightMap map_of(int side, double spacing, Height&& height)
{
    HeightMap map;
    map.columns = map.rows = side, map.spacing = {spacing, spacing};
    map.heights.resize(std::size_t(side) * std::size_t(side));
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const dvec3 p = map.position(column, row) - spacing * 0.5 * (side - 1);
            map.heights[map.index(column, row)] = float(height(p.x, p.y));
        }
    return map;
}

double length_of(const IsoLine& line)
{
    double sum = 0;
    for (std::size_t i = 1; i < line.points.size(); ++i)
        sum += glm::distance(line.points[i - 1], line.points[i]);
    return sum + (line.closed ? glm::distance(line.points.back(), line.points.front()) : 0);
}

/// Twice the signed area: above 0 where the line runs counter-clockwise, seen from above.
double turn_of(const IsoLine& line)
{
    double sum = 0;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
        const dvec3 &a = line.points[i], &b = line.points[(i + 1) % line.points.size()];
        sum += a.x * b.y - a.y * b.x;
    }
    return sum;
}

/// The map's height at a point of one of its rows or columns: linear between samples. NaN where there is no data.
double height_at(const HeightMap& map, const dvec3& p)
{
    const double c = p.x / map.spacing.x, r = map.rows - 1 - p.y / map.spacing.y;
    const int c0 = std::min(int(c), map.columns - 2), r0 = std::min(int(r), map.rows - 2);
    const double u = c - c0, v = r - r0;
    const auto h = [&](int i, int j) { return double(map.height(c0 + i, r0 + j)); };
    const double north = u == 0 ? h(0, 0) : std::lerp(h(0, 0), h(1, 0), u), south = u == 0 ? h(0, 1) : std::lerp(h(0, 1), h(1, 1), u);
    return v == 0 ? north : std::lerp(north, south, v);
}

void expect_sound(const HeightMap& map, std::span<const double> levels, const std::vector<IsoLine>& lines)
{
    for (const IsoLine& line : lines) {
        ASSERT_GE(line.points.size(), line.closed ? 3u : 2u);
        for (std::size_t i = 0; i < line.points.size(); ++i) {
            const dvec3& p = line.points[i];
            ASSERT_EQ(p.z, levels[line.level]);
            ASSERT_NEAR(height_at(map, p), p.z, 1e-6 * (1 + std::abs(p.z))) << p.x << " " << p.y;
            if (i > 0 || line.closed) {
                ASSERT_NE(p, line.points[(i + line.points.size() - 1) % line.points.size()]);
            }
        }
    }
}

TEST(IsoLines, OfAParaboloidAreCirclesAroundTheHigherGroundOrTheLower)
{
    for (const double sign : {1.0, -1.0}) {
        const HeightMap map = map_of(101, 1, [&](double x, double y) { return sign * (x * x + y * y); });
        const std::vector<double> levels = {sign * 100, sign * 400, sign * 1600};
        const std::vector<IsoLine> lines = iso_lines(map, levels);
        ASSERT_EQ(lines.size(), 3u);
        expect_sound(map, levels, lines);
        for (const IsoLine& line : lines) {
            EXPECT_TRUE(line.closed);
            const double radius = std::sqrt(std::abs(levels[line.level]));
            for (const dvec3& p : line.points) // linear instead of quadratic between samples: off by at most 1/8 h'' / h' across
                EXPECT_NEAR(glm::distance(dvec2(p), dvec2(50)), radius, 0.25 / (2 * radius) + 1e-6);
            EXPECT_NEAR(length_of(line), 2 * std::numbers::pi * radius, 0.02 * radius);
            EXPECT_EQ(turn_of(line) > 0, sign < 0) << "higher ground is on the left";
        }
    }
}

TEST(IsoLines, OfAConeAreEquallyFarApart)
{
    const HeightMap map = map_of(201, 1, [](double x, double y) { return 100 - std::hypot(x, y); });
    std::vector<double> levels;
    for (double level = 5; level < 100; level += 10)
        levels.push_back(level);
    const std::vector<IsoLine> lines = iso_lines(map, levels);
    ASSERT_EQ(lines.size(), levels.size());
    expect_sound(map, levels, lines);
    for (const IsoLine& line : lines)
        for (const dvec3& p : line.points)
            EXPECT_NEAR(glm::distance(dvec2(p), dvec2(100)), 100 - levels[line.level], 0.13 / (100 - levels[line.level]) + 1e-5);
}

TEST(IsoLines, OfAPlaneAreStraightAndEndAtTheBorder)
{
    const HeightMap map = map_of(41, 2, [](double x, double y) { return 0.5 * x + 0.25 * y; });
    const std::vector<double> levels = {-20, -10, 0, 10, 20};
    const std::vector<IsoLine> lines = iso_lines(map, levels);
    ASSERT_EQ(lines.size(), 5u);
    expect_sound(map, levels, lines);
    for (const IsoLine& line : lines) {
        EXPECT_FALSE(line.closed);
        const dvec3 &a = line.points.front(), &b = line.points.back();
        for (const dvec3& end : {a, b})
            EXPECT_TRUE(end.x == 0 || end.x == 80 || end.y == 0 || end.y == 80);
        EXPECT_NEAR(length_of(line), glm::distance(a, b), 1e-9);
        EXPECT_LT(b.y, a.y) << "the higher ground, in the east, is on the left of who walks south";
    }
}

/// Samples of exactly a level, everywhere: no line twice, no point that is no number, and each line passes on the lower side.
TEST(IsoLines, TakeSamplesOfExactlyALevelAsHigher)
{
    const HeightMap steps = map_of(40, 1, [](double x, double y) { return std::floor((x + y) / 7) * 10; });
    std::vector<double> levels;
    for (double level = -60; level <= 60; level += 10)
        levels.push_back(level);
    expect_sound(steps, levels, iso_lines(steps, levels));
    // A plateau at the level: one loop around it, through its own outermost samples.
    const HeightMap plateau = map_of(11, 1, [](double x, double y) { return std::max(std::abs(x), std::abs(y)) <= 2 ? 50 : 0; });
    const std::vector<double> fifty = {50};
    const std::vector<IsoLine> around = iso_lines(plateau, fifty);
    ASSERT_EQ(around.size(), 1u);
    EXPECT_TRUE(around[0].closed);
    EXPECT_NEAR(length_of(around[0]), 16, 1e-12);
    EXPECT_TRUE(iso_lines(plateau, std::vector<double>{0}).empty()) << "all is as high";
    // A single summit at the level shrinks to nothing; a level above all has no line.
    const HeightMap summit = map_of(11, 1, [](double x, double y) { return x == 0 && y == 0 ? 50 : 0; });
    EXPECT_TRUE(iso_lines(summit, fifty).empty());
    EXPECT_TRUE(iso_lines(summit, std::vector<double>{51}).empty());
    EXPECT_EQ(iso_lines(summit, std::vector<double>{49.999}).size(), 1u);
}

TEST(IsoLines, JoinWhatIsHigherInASaddleWhereItsMiddleIs)
{
    const auto pieces = [](double middle_level) {
        HeightMap map;
        map.columns = map.rows = 2;
        map.heights = {10, 0, 0, 10}; // north-west and south-east are higher
        return iso_lines(map, std::vector<double>{middle_level});
    };
    const auto cuts_off_north_west = [](const IsoLine& line) { return std::all_of(line.points.begin(), line.points.end(), [](const dvec3& p) { return p.x < 1 && p.y > 0; }); };
    ASSERT_EQ(pieces(4).size(), 2u); // the middle, 5, is higher: the low corners are cut off
    for (const IsoLine& line : pieces(4))
        EXPECT_FALSE(cuts_off_north_west(line));
    ASSERT_EQ(pieces(6).size(), 2u);
    EXPECT_TRUE(cuts_off_north_west(pieces(6)[0]) != cuts_off_north_west(pieces(6)[1]));
}

TEST(IsoLines, EndAtCellsWithoutData)
{
    HeightMap map = map_of(101, 1, [](double x, double y) { return x * x + y * y; });
    map.heights[map.index(80, 50)] = std::nanf(""); // on the circle of radius 30
    const std::vector<double> levels = {100, 900};
    const std::vector<IsoLine> lines = iso_lines(map, levels);
    expect_sound(map, levels, lines);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_TRUE(lines[0].closed);
    EXPECT_FALSE(lines[1].closed);
    for (const dvec3& p : {lines[1].points.front(), lines[1].points.back()})
        EXPECT_LT(glm::distance(dvec2(p), dvec2(80, 50)), 2);
}

/// On rough ground of whole metres: every crossing of a row or column is on exactly one line, and lines end at borders only.
TEST(IsoLines, HoldEveryCrossingOnce)
{
    TerrainSampleOptions sample;
    sample.landform = "reference", sample.columns = 129, sample.rows = 97;
    const HeightMap map = make_terrain(sample);
    const std::vector<double> levels = {100, 150, 200, 250.5};
    const std::vector<IsoLine> lines = iso_lines(map, levels);
    expect_sound(map, levels, lines);
    for (std::size_t level = 0; level < levels.size(); ++level) {
        std::size_t crossings = 0, points = 0, touching = 0;
        const auto is_high = [&](int c, int r) { return double(map.height(c, r)) >= levels[level]; };
        for (int r = 0; r < map.rows; ++r)
            for (int c = 0; c < map.columns; ++c) {
                crossings += c + 1 < map.columns && is_high(c, r) != is_high(c + 1, r);
                crossings += r + 1 < map.rows && is_high(c, r) != is_high(c, r + 1);
                touching += double(map.height(c, r)) == levels[level];
            }
        for (const IsoLine& line : lines)
            if (line.level == level) {
                points += line.points.size();
                if (!line.closed) {
                    for (const dvec3& p : {line.points.front(), line.points.back()})
                        EXPECT_TRUE(p.x == 0 || p.y == 0 || p.x == map.columns - 1 || p.y == map.rows - 1);
                }
            }
        EXPECT_LE(points, crossings);
        EXPECT_GE(points + 4 * touching, crossings); // up to four crossings fall together in a sample at the level
        EXPECT_GT(crossings, 500u);
    }
}

TEST(IsoLines, AreTheSameForAnyNumberOfThreads)
{
    const HeightMap map = map_of(60, 1, [](double x, double y) { return 20 * std::sin(x / 5) * std::cos(y / 7); });
    const std::vector<double> levels = {-15, -10, -5, 0, 5, 10, 15};
    const auto points = [&](int threads) {
        std::vector<dvec3> all;
        for (const IsoLine& line : with_threads(threads, [&] { return iso_lines(map, levels); }))
            all.insert(all.end(), line.points.begin(), line.points.end());
        return all;
    };
    EXPECT_EQ(points(1), points(2));
}

TEST(IsoLines, CountTheirLevelsFromZero)
{
    const HeightMap map = map_of(11, 1, [](double x, double) { return 25 * x; }); // -125 to 125
    EXPECT_EQ(iso_factors(map, 50).first, -2);
    EXPECT_EQ(iso_factors(map, 50).end, 3);
    EXPECT_EQ(iso_factors(map, 25).first, -5);
    EXPECT_EQ(iso_factors(map, 25).end, 6);
    EXPECT_THROW(iso_factors(map, 0), Error::Input);
    EXPECT_THROW(iso_factors(map, -5), Error::Input);
    EXPECT_THROW(iso_factors(map, 1e-3), Error::Input);
}

} // namespace
} // namespace limn
