#include "limn/subdivision/vector_propagation.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "limn/base/distance_transform.h"
#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "subdivision/marks.h"

namespace limn::test {
namespace {

std::int64_t squared(const ivec2& v) { return std::int64_t(v.x) * v.x + std::int64_t(v.y) * v.y; }

/// The distance to the nearest mark by looking at all, squared.
std::int64_t least_by_force(const std::vector<std::uint8_t>& marks, ivec2 size, ivec2 p)
{
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            if (marks[std::size_t(y * size.x + x)] != 0)
                least = std::min(least, squared(ivec2(x, y) - p));
    return least;
}

// Checklist 28.
TEST(VectorPropagation, AmongEightNeighboursIsWhatLookingAtEveryPixelFinds)
{
    for (const ivec2& size : {ivec2(1, 1), ivec2(9, 1), ivec2(1, 7), ivec2(61, 47), ivec2(40, 90)})
        for (const double share : {0.001, 0.01, 0.1, 0.6}) {
            const std::vector<std::uint8_t> marks = random_marks(size, share, 5);
            const VectorField field = propagate_vectors(marks, size);
            EXPECT_LE(field.passes, std::max(size.x, size.y));
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    ASSERT_TRUE(field.is_known(x, y));
                    const ivec2 to = ivec2(x, y) + field.vector(x, y);
                    ASSERT_EQ(squared(field.vector(x, y)), least_by_force(marks, size, {x, y})) << x << "," << y;
                    ASSERT_NE(marks[std::size_t(to.y * size.x + to.x)], 0) << x << "," << y;
                }
        }
}

TEST(VectorPropagation, AmongFourNeighboursIsWithinThreeTenthsOfAPixel)
{
    const ivec2 size(200, 200);
    std::size_t wrong = 0;
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const std::vector<std::uint8_t> marks = random_marks(size, 0.004, seed);
        const VectorField field = propagate_vectors(marks, size, {.neighbours = 4});
        const DistanceTransform exact = distance_transform(marks, size);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const double error = std::sqrt(double(squared(field.vector(x, y)))) - exact.distance(x, y);
                ASSERT_GE(error, 0);
                ASSERT_LE(error, 0.3);
                wrong += error > 0;
            }
    }
    EXPECT_GT(wrong, 0u); // so that the difference between the two is seen
    EXPECT_LT(wrong, 200u);
}

TEST(VectorPropagation, PassesMakeABandOfThatWidth)
{
    const ivec2 size(120, 80);
    const std::vector<std::uint8_t> marks = random_marks(size, 0.002, 9);
    const DistanceTransform exact = distance_transform(marks, size);
    for (const int passes : {0, 1, 3, 8}) {
        const VectorField field = propagate_vectors(marks, size, {.most_passes = passes});
        EXPECT_EQ(field.passes, passes);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const ivec2 v = exact.nearest_to(x, y) - ivec2(x, y);
                if (std::max(std::abs(v.x), std::abs(v.y)) <= passes) {
                    ASSERT_EQ(squared(field.vector(x, y)), exact.squared_distance(x, y)) << x << "," << y;
                }
                if (exact.distance(x, y) > std::sqrt(2.0) * passes) {
                    ASSERT_FALSE(field.is_known(x, y)) << x << "," << y;
                }
            }
    }
}

TEST(VectorPropagation, TiesGoToThePixelItselfThenCounterClockwiseFromTheRight)
{
    // Marks to the right, above, left and below the middle of 3 x 3 pixels.
    const VectorField field = propagate_vectors(std::vector<std::uint8_t>{0, 1, 0, 1, 0, 1, 0, 1, 0}, {3, 3});
    EXPECT_EQ(field.vector(1, 1), ivec2(1, 0));
    EXPECT_EQ(field.vector(0, 0), ivec2(1, 0));
    EXPECT_EQ(field.vector(2, 2), ivec2(0, -1));
    EXPECT_EQ(field.vector(1, 0), ivec2(0, 0));
}

TEST(VectorPropagation, OfNothingKnowsNothing)
{
    const VectorField field = propagate_vectors(std::vector<std::uint8_t>(12, 0), {4, 3});
    EXPECT_EQ(field.passes, 0);
    EXPECT_FALSE(field.is_known(3, 2));
    EXPECT_EQ(propagate_vectors({}, {0, 0}).passes, 0);
}

TEST(VectorPropagation, DilatesWithTheNearestSetPixelAndKeepsAlpha)
{
    Image picture({5, 1}, 4);
    const float left[4] = {0.1f, 0.2f, 0.3f, 1}, right[4] = {0.7f, 0.8f, 0.9f, 0.99f}, unset[4] = {0.5f, 0.5f, 0.5f, 0.98f};
    std::copy_n(left, 4, picture.at(0, 0));
    std::copy_n(unset, 4, picture.at(2, 0));
    std::copy_n(right, 4, picture.at(4, 0));
    const Image all = dilated(picture, {});
    for (int x = 0; x < 5; ++x) {
        EXPECT_EQ(all.at(x, 0)[0], x < 2 ? 0.1f : 0.7f) << x; // in the middle a tie: to the right
        EXPECT_EQ(all.at(x, 0)[3], picture.at(x, 0)[3]) << x;
    }
    EXPECT_EQ(dilated(picture, {.most_passes = 1}).at(2, 0)[0], 0.5f);
}

TEST(VectorPropagation, RefusesWhatItCannotDo)
{
    const std::vector<std::uint8_t> marks(12, 0);
    EXPECT_THROW(propagate_vectors(marks, {4, 4}), Error::Input);
    EXPECT_THROW(propagate_vectors(marks, {4, 3}, {.neighbours = 6}), Error::Input);
    EXPECT_THROW(propagate_vectors(marks, {4, 3}, {.most_passes = -1}), Error::Input);
    EXPECT_THROW(propagate_vectors(std::vector<std::uint8_t>(40000, 1), {40000, 1}), Error::Input);
    EXPECT_THROW(dilated(Image({2, 2}, 3), {}), Error::Input);
}

TEST(VectorPropagation, IsTheSameForAnyNumberOfThreads)
{
    const ivec2 size(150, 110);
    const std::vector<std::uint8_t> marks = random_marks(size, 0.003, 3);
    EXPECT_EQ(with_threads(1, [&] { return propagate_vectors(marks, size).vectors; }), with_threads(4, [&] { return propagate_vectors(marks, size).vectors; }));
}

} // namespace
} // namespace limn::test
