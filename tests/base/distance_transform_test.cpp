#include "limn/base/distance_transform.h"

#include <limits>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/base/random.h"

namespace limn {
namespace {

std::vector<std::uint8_t> random_marks(ivec2 size, double share, std::uint64_t seed)
{
    std::vector<std::uint8_t> marks(std::size_t(size.x) * std::size_t(size.y));
    Random random(seed);
    for (std::uint8_t& mark : marks)
        mark = random.uniform() < share ? 1 : 0;
    return marks;
}

/// The nearest marked pixel by looking at all: the smallest x, then y, of several.
ivec2 nearest_by_force(const std::vector<std::uint8_t>& marks, ivec2 size, ivec2 p)
{
    ivec2 best(-1);
    int least = std::numeric_limits<int>::max();
    for (int x = 0; x < size.x; ++x)
        for (int y = 0; y < size.y; ++y)
            if (const int d = (x - p.x) * (x - p.x) + (y - p.y) * (y - p.y); marks[std::size_t(y * size.x + x)] != 0 && d < least) {
                least = d;
                best = {x, y};
            }
    return best;
}

TEST(DistanceTransform, IsWhatLookingAtEveryPixelFinds)
{
    const ivec2 sizes[] = {{1, 1}, {7, 1}, {1, 9}, {37, 23}, {130, 70}, {65, 129}};
    for (const ivec2& size : sizes)
        for (const double share : {0.001, 0.01, 0.1, 0.7}) {
            std::vector<std::uint8_t> marks = random_marks(size, share, 7);
            marks[marks.size() / 3] = 1;
            const DistanceTransform result = distance_transform(marks, size);
            ASSERT_FALSE(result.empty());
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const ivec2 expected = nearest_by_force(marks, size, {x, y}), d = expected - ivec2(x, y);
                    ASSERT_EQ(result.squared_distance(x, y), d.x * d.x + d.y * d.y) << x << "," << y;
                    ASSERT_NE(marks[result.nearest[std::size_t(y * size.x + x)]], 0) << x << "," << y;
                    ASSERT_EQ(result.nearest_to(x, y).x, expected.x) << x << "," << y;
                }
        }
}

TEST(DistanceTransform, OfNothingIsInfinite)
{
    const DistanceTransform result = distance_transform(std::vector<std::uint8_t>(12, 0), {4, 3});
    EXPECT_TRUE(result.empty());
    EXPECT_EQ(result.distance(2, 1), std::numeric_limits<double>::infinity());
    EXPECT_TRUE(distance_transform({}, {0, 0}).empty());
    EXPECT_THROW(distance_transform(std::vector<std::uint8_t>(12, 0), {4, 4}), Error::Input);
}

TEST(DistanceTransform, IsTheSameForAnyNumberOfThreads)
{
    const ivec2 size(301, 203);
    const std::vector<std::uint8_t> marks = random_marks(size, 0.002, 3);
    const DistanceTransform one = with_threads(1, [&] { return distance_transform(marks, size); });
    const DistanceTransform many = with_threads(4, [&] { return distance_transform(marks, size); });
    EXPECT_EQ(one.nearest, many.nearest);
}

// A single mark in a corner of the largest picture that is drawn along one side: distances pass 2^31.
TEST(DistanceTransform, MeasuresLongPictures)
{
    const ivec2 size(60000, 3);
    std::vector<std::uint8_t> marks(std::size_t(size.x) * 3, 0);
    marks[0] = 1;
    const DistanceTransform result = distance_transform(marks, size);
    EXPECT_EQ(result.squared_distance(59999, 2), 59999LL * 59999 + 4);
}

} // namespace
} // namespace limn
