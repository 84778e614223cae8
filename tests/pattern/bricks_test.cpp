// Checklist 10 to 14 of the procedural structures specification: bricks.

#include <cmath>

#include <gtest/gtest.h>

#include "limn/base/random.h"
#include "limn/formulas/formulas.h"

namespace limn {
namespace {

using namespace formulas;

/// The seed's bricks with its literal bump.
BrickPattern wall(int axes) { return {vec3(0.52f, 0.18f, 0.21f), 0.02f, axes, vec3(1), vec3(0.6f, 0.3f, 0.2f), vec3(0.7f), 0, 0}; }

TEST(Checklist10, AWallHasTheSharesAndPlacesOfTheSpecification)
{
    const BrickPattern b = wall(2);
    int inside = 0;
    const int n = 1000;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            inside += brick_mask(b, vec3(0.52f * (float(x) + 0.5f) / n, 0.36f * (float(y) + 0.5f) / n, 0)) > 0.5f;
    EXPECT_NEAR(double(inside) / (n * n), 0.8547, 0.002);
    EXPECT_EQ(brick_mask(b, {0.26f, 0.09f, 0}), 1.0f);
    EXPECT_EQ(brick_mask(b, {0, 0.09f, 0}), 0.0f);
    EXPECT_EQ(brick_mask(b, {0.005f, 0.27f, 0}), 1.0f) << "odd rows are shifted";
    EXPECT_EQ(brick_mask(b, {0.005f, -0.09f, 0}), 1.0f) << "row -1 is odd";
    EXPECT_NEAR(mortar_part(b).x, 0.01923f, 1e-5f);
    EXPECT_NEAR(mortar_part(b).y, 0.05556f, 1e-5f);
    EXPECT_NEAR(mortar_part(b).z, 0.04762f, 1e-5f);
}

TEST(Checklist11, SolidBricksFillTheirShareAndShowTheWallOnTheirFaces)
{
    const BrickPattern solid = wall(3), flat = wall(2);
    int inside = 0, differ = 0;
    const int n = 400000;
    for (int i = 0; i < n; ++i) {
        Random random(2, std::uint64_t(i));
        const vec3 p = {float(random.uniform(-2.6, 2.6)), float(random.uniform(-1.8, 1.8)), float(random.uniform(-2.1, 2.1))};
        inside += brick_mask(solid, p) > 0.5f;
        differ += brick_mask(solid, vec3(p.x, p.y, 0.1f)) != brick_mask(flat, p);
    }
    EXPECT_NEAR(double(inside) / n, 0.7733, 0.003);
    EXPECT_EQ(differ, 0);
}

TEST(Checklist11, BondedBricksAreShiftedOnTheirSidesToo)
{
    BrickPattern bonded = wall(3);
    bonded.bond = 1;
    int inside = 0;
    const int n = 400000;
    for (int i = 0; i < n; ++i) {
        Random random(23, std::uint64_t(i));
        inside += brick_mask(bonded,
                             {float(random.uniform(-2.6, 2.6)), float(random.uniform(-1.8, 1.8)), float(random.uniform(-2.1, 2.1))}) > 0.5f;
    }
    EXPECT_NEAR(double(inside) / n, 0.7733, 0.003);
    EXPECT_EQ(brick_mask(bonded, {0.26f, 0.09f, 0.0f}), 0.0f) << "mortar between bricks of an even row";
    EXPECT_EQ(brick_mask(bonded, {0.05f, 0.27f, 0.0f}), 1.0f) << "the middle of a brick of an odd row";
    EXPECT_EQ(brick_mask(wall(3), {0.05f, 0.27f, 0.0f}), 0.0f);
}

// The filter knows of both shifts: over many bricks it sees their shares.
TEST(Bricks, TheFilterOfBondedOnesAgreesWithSamples)
{
    BrickPattern b = wall(3);
    b.bond = 1;
    b.bump = vec3(0);
    const Finish f = {FINISH_MATTE, vec3(1), 0, 1, 1, 1, 0};
    const Illumination lit = {{0, 0, 1}, vec3(2), 0, {0, 1, 0}, vec3(0.5f), vec3(0.1f)};
    for (int i = 0; i < 60; ++i) {
        Random random(26, std::uint64_t(i));
        const auto number = [&](double size) { return float(random.uniform(-size, size)); };
        const int axis = i % 3; // a face of a box
        vec3 n(0), right(0), down(0);
        n[axis] = 1;
        const float size = 0.02f * std::exp(float(random.uniform(0, 3)));
        right[(axis + 1) % 3] = size;
        down[(axis + 2) % 3] = size;
        const PatternPoint p = {{number(2), number(2), number(2)}, n, n, right, down};
        const vec3 filtered = bricks_through(b, f, p, KERNEL_BOX, 1, lit);
        vec3 mean(0);
        for (int k = 0; k < 4096; ++k) {
            const vec3 at = p.position + (float(k % 64) + 0.5f - 32) / 64 * right + (float(k / 64) + 0.5f - 32) / 64 * down;
            mean += brick_at(b, f, at, n, n, lit) / 4096.0f;
        }
        EXPECT_LT(glm::length(filtered - mean), 0.03f) << "axis " << axis << ", size " << size;
    }
}

// Shares of ramps and mean places on them, from near to far, of rows that start at 0 and of those that are shifted.
TEST(Bricks, RampsHaveTheSharesAndPlacesOfSamples)
{
    const float m = 0.08f;
    const int n = 4001;
    for (int i = 0; i < 60; ++i) {
        Random random(31, std::uint64_t(i));
        const float sigma = float(std::exp(random.uniform(std::log(0.01), std::log(1.2)))), x = float(random.uniform(-2, 2)),
                    odd = float(i % 3) * 0.5f;
        const BrickAxes axes = shifted_axes(x, m, odd, blur_of(KERNEL_GAUSS, sigma, 0));
        double shares[2][3] = {}, places[2][2] = {}, all = 0;
        for (int k = 0; k < n; ++k) {
            const double off = (k - n / 2) * 10.0 / n, weight = std::exp(-0.5 * off * off); // standard deviations
            all += weight;
            for (const int shifted : {0, 1}) {
                const double at = double(x) + 0.5 * shifted + off * double(sigma), phase = at - std::floor(at);
                const int part = phase < double(m) ? 0 : phase < 1 - double(m) ? 1 : 2;
                shares[shifted][part] += weight;
                if (part != 1)
                    places[shifted][part / 2] += weight * std::min(phase, 1 - phase) / double(m);
            }
        }
        for (const int shifted : {0, 1}) {
            if (odd == (shifted == 1 ? 0.0f : 1.0f)) // there are no such rows
                continue;
            const BrickAxis& a = shifted == 1 ? axes.odd : axes.even;
            EXPECT_NEAR(a.up, shares[shifted][0] / all, 2e-3) << sigma;
            EXPECT_NEAR(a.top, shares[shifted][1] / all, 2e-3) << sigma;
            EXPECT_NEAR(a.down, shares[shifted][2] / all, 2e-3) << sigma;
            EXPECT_NEAR(a.up_place, places[shifted][0] / all, 2e-3) << sigma;
            EXPECT_NEAR(a.down_place, places[shifted][1] / all, 2e-3) << sigma;
        }
    }
}

// Every state of a bevelled wall is lit: ramps of all sides, and the corners where they meet.
TEST(Bricks, TheFilterOfBevelsAgreesWithSamples)
{
    double squares[2] = {};
    constexpr int count = 400;
    for (int i = 0; i < count; ++i) {
        Random random(32, std::uint64_t(i));
        const auto number = [&](double size) { return float(random.uniform(-size, size)); };
        BrickPattern b = wall(i % 4 < 2 ? 2 : 3);
        b.bump = vec3(0.006f) / b.cell;
        b.bond = i % 4 == 3 ? 1 : 0;
        const Finish f = {i % 2 == 0 ? FINISH_MATTE : FINISH_PHONG, vec3(1), 0.1f, 20, 1, 1, 0};
        const vec3 n = {0, 0, 1}, to_eye = glm::normalize(vec3(number(0.5), number(0.5), 1));
        const Illumination lit = {glm::normalize(vec3(number(1), number(1), 1)), vec3(2), 0, {0, 1, 0}, vec3(0.5f), vec3(0.1f)};
        const float size = 0.005f * std::exp(float(random.uniform(0, 5)));
        const PatternPoint p = {{number(2), number(2), 0.1f}, n, to_eye, vec3(size, 0, 0), vec3(0, size, 0)};
        const vec3 filtered = bricks_through(b, f, p, KERNEL_BOX, 1, lit);
        vec3 mean(0);
        for (int k = 0; k < 4096; ++k) {
            const vec3 at = p.position + (float(k % 64) + 0.5f - 32) / 64 * p.right + (float(k / 64) + 0.5f - 32) / 64 * p.down;
            mean += brick_at(b, f, at, n, to_eye, lit) / 4096.0f;
        }
        const vec3 off = filtered - mean;
        squares[i % 2] += double(glm::dot(off, off)) / (count / 2);
    }
    EXPECT_LT(std::sqrt(squares[0]), 0.0085) << "matte";
    EXPECT_LT(std::sqrt(squares[1]), 0.021) << "with highlights";
}

TEST(Checklist11, BricksCanBeCarvedToASphere)
{
    const BrickPattern b = wall(3);
    int bricks = 0, all = 0;
    for (int i = 0; i < 100000; ++i) {
        Random random(4, std::uint64_t(i));
        const vec3 n = glm::normalize(vec3(dvec3(random.normal(), random.normal(), random.normal())));
        bricks += brick_mask(b, 2.0f * n) > 0.5f;
        ++all;
    }
    EXPECT_NEAR(double(bricks) / all, 0.7733, 0.03);
}

TEST(Checklist12, BevelsHaveTheSlopesOfTheSpecificationAndFlatTops)
{
    const BrickPattern b = wall(2);
    const float m = mortar_part(b).x;
    EXPECT_NEAR(bevel_difference(m, 0.5f * m, 0.002f), 76.9f, 0.8f);
    EXPECT_NEAR(bevel_slope(m, 0.5f * m), 78.0f, 0.1f);
    EXPECT_EQ(bumped({0, 0, 1}, brick_gradient(b, {0.26f, 0.09f, 0})), vec3(0, 0, 1));
}

TEST(Checklist12, LightFromTheUpperLeftBrightensLeftAndTopBevels)
{
    const BrickPattern b = wall(2);
    const vec3 light = glm::normalize(vec3(-1, 1, 1));
    const auto lit = [&](float x, float y) { return facing(bumped({0, 0, 1}, brick_gradient(b, {x, y, 0})), light); };
    const float left = lit(0.005f, 0.09f), right = lit(0.515f, 0.09f), bottom = lit(0.26f, 0.005f), top = lit(0.26f, 0.175f),
                middle = lit(0.26f, 0.09f);
    EXPECT_GT(left, middle * 0.9f);
    EXPECT_GT(top, middle * 0.9f);
    EXPECT_LT(right, 0.3f * left);
    EXPECT_LT(bottom, 0.3f * top);
}

TEST(Checklist12, EveryFaceOfABoxIsBentAlongItsOwnAxes)
{
    const BrickPattern b = wall(3);
    for (int axis = 0; axis < 3; ++axis) {
        vec3 n(0);
        n[axis] = 1;
        vec3 p = vec3(0.26f, 0.09f, 0.105f); // the middle of a brick
        const int along = (axis + 1) % 3, across = (axis + 2) % 3;
        p[along] = 0.25f * b.joint; // on a bevel at the start of the cell
        const vec3 bent = bumped(n, brick_gradient(b, p));
        EXPECT_LT(bent[along], -0.5f) << axis;
        EXPECT_NEAR(bent[across], 0, 1e-5f) << axis;
    }
}

TEST(Checklist13, SmoothBevelsAreAsWideAsTheMortarAndHardOnesAsTheDifference)
{
    const float m = 0.1f, delta = 0.002f;
    const int n = 100000;
    int smooth = 0, hard = 0;
    for (int i = 0; i < n; ++i) {
        const float x = (float(i) + 0.5f) / n;
        smooth += bevel_slope(m, x) != 0;
        hard += pulse(m, x + delta) != pulse(m, x - delta);
    }
    EXPECT_NEAR(double(smooth) / n, 2 * double(m), 1e-3);
    EXPECT_NEAR(double(hard) / n, 2 * 2 * double(delta), 1e-3);
}

TEST(Checklist14, LightingInTheTangentFrameIsThatInTheWorld)
{
    for (int i = 0; i < 500; ++i) {
        Random random(6, std::uint64_t(i));
        const auto direction = [&] { return glm::normalize(vec3(dvec3(random.normal(), random.normal(), random.normal()))); };
        const vec3 n = direction(), t = glm::normalize(glm::cross(n, direction())), b = glm::cross(n, t), light = direction();
        const float u = float(random.normal()), v = float(random.normal());
        const glm::mat3 rows = glm::transpose(glm::mat3(t, b, n)); // to the tangent frame
        const float inside = facing(glm::normalize(vec3(-u, -v, 1)), rows * light), world = facing(bumped(n, u * t + v * b), light);
        EXPECT_NEAR(inside, world, 1.0f / 255);
    }
}

// Matte walls have a shorter way of their own.
TEST(Bricks, MatteOnesLookAsThoseWithAHighlightOfNoStrength)
{
    for (int i = 0; i < 3000; ++i) {
        Random random(22, std::uint64_t(i));
        const auto direction = [&] { return glm::normalize(vec3(dvec3(random.normal(), random.normal(), random.normal()))); };
        const auto number = [&](double size) { return float(random.uniform(-size, size)); };
        BrickPattern b = wall(i % 2 == 0 ? 2 : 3);
        b.bump = vec3(0.03f);
        b.bond = i % 4 == 3 ? 1 : 0;
        const vec3 n = i % 3 == 0 ? vec3(0, 0, 1) : direction();
        const float size = std::exp(number(4));
        const PatternPoint p = {{number(2), number(2), number(2)},
                                n,
                                n,
                                size * 0.1f * vec3(number(1), number(1), number(1)),
                                size * 0.1f * vec3(number(1), number(1), number(1))};
        const Illumination lit = {direction(), vec3(2), 0, direction(), vec3(0.5f), vec3(0.1f)};
        const vec3 matte = bricks_through(b, {FINISH_MATTE, vec3(1), 0, 10, 1, 1, 0}, p, KERNEL_GAUSS, 0.5f, lit),
                   phong = bricks_through(b, {FINISH_PHONG, vec3(1), 0, 10, 1, 1, 0}, p, KERNEL_GAUSS, 0.5f, lit);
        EXPECT_LT(glm::length(matte - phong), 2e-4f);
    }
}

} // namespace
} // namespace limn
