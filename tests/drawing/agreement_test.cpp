#include "limn/drawing/agreement.h"

#include <cmath>

#include <gtest/gtest.h>

#include "limn/base/error.h"

namespace limn {
namespace {

Image column(int x, int from = 0, int to = 40)
{
    Image image({50, 40}, 1);
    for (int y = from; y < to; ++y)
        *image.at(x, y) = 1;
    return image;
}

TEST(Agreement, OfAShiftedLineIsItsShift)
{
    const LineAgreement same = compare_lines(column(20), column(20)), near = compare_lines(column(20), column(23)), far = compare_lines(column(20), column(24));
    EXPECT_EQ(same.f1(), 1);
    EXPECT_EQ(same.chamfer, 0);
    EXPECT_EQ(near.f1(), 1) << "3 px are within the tolerance";
    EXPECT_EQ(near.chamfer, 3);
    EXPECT_EQ(far.f1(), 0);
    EXPECT_EQ(far.chamfer, 4);
}

TEST(Agreement, OfHalfALineIsPreciseAndRecallsHalf)
{
    const LineAgreement half = compare_lines(column(20, 0, 20), column(20), 0);
    EXPECT_EQ(half.precision, 1);
    EXPECT_EQ(half.recall, 0.5);
    EXPECT_NEAR(half.f1(), 2 / 3.0, 1e-12);
    EXPECT_NEAR(half.chamfer, 0.5 * (20 * 21 / 2) / 40, 1e-12); // 1 + ... + 20 px for the other half, 0 the other way
    const LineAgreement twice = compare_lines(column(20), column(20, 0, 20), 0);
    EXPECT_EQ(twice.precision, 0.5);
    EXPECT_EQ(twice.recall, 1);
}

TEST(Agreement, WithNothingIsNone)
{
    const Image nothing({50, 40}, 1);
    EXPECT_EQ(compare_lines(nothing, nothing).f1(), 1);
    for (const LineAgreement& one : {compare_lines(nothing, column(3)), compare_lines(column(3), nothing)}) {
        EXPECT_EQ(one.f1(), 0);
        EXPECT_EQ(one.chamfer, std::hypot(50, 40));
    }
    EXPECT_THROW(compare_lines(nothing, Image({50, 41}, 1)), Error::Input);
    EXPECT_THROW(compare_lines(nothing, Image({50, 40}, 3)), Error::Input);
}

TEST(Agreement, LinePixelsAreThoseOfVisibleStrokes)
{
    Drawing drawing;
    drawing.camera.size = {50, 40};
    Stroke triangle;
    triangle.points = {{10.5, 10.5}, {30.5, 10.5}, {30.5, 30.5}};
    Stroke hidden;
    hidden.points = {{0.5, 5.5}, {49.5, 5.5}};
    hidden.visible = false;
    drawing.strokes = {triangle, hidden};
    const auto count = [](const Image& image) {
        int sum = 0;
        for (const float sample : image.samples)
            sum += int(sample);
        return sum;
    };
    const Image open = line_pixels(drawing);
    EXPECT_EQ(count(open), 41);
    EXPECT_EQ(*open.at(10, 10) + *open.at(20, 10) + *open.at(30, 10) + *open.at(30, 30), 4.0f);
    drawing.strokes[0].closed = true;
    EXPECT_EQ(count(line_pixels(drawing)), 60) << "and the 19 pixels of the diagonal";
    drawing.strokes[0].points = {{-5, 3.5}, {100, 3.5}};
    drawing.strokes[0].closed = false;
    EXPECT_EQ(count(line_pixels(drawing)), 50) << "what runs out of the picture is left out";
}

} // namespace
} // namespace limn
