#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "limn/base/random.h"
#include "limn/subdivision/bezier_roots.h"
#include "limn/subdivision/bezier_triangle.h"

namespace limn::test {
namespace {

template <int degree> BezierTriangle<degree, double> any_polynomial(Random& random)
{
    BezierTriangle<degree, double> b;
    for (double& c : b.c)
        c = random.uniform(-1, 1);
    return b;
}

/// The sum of Bernstein polynomials, term by term.
template <int degree> double sum_at(const BezierTriangle<degree, double>& b, double v, double w)
{
    double sum = 0;
    for (int k = 0; k <= degree; ++k)
        for (int j = 0; j <= degree - k; ++j)
            sum += b.at(j, k) * multinomial(degree, j, k) * std::pow(1 - v - w, degree - j - k) * std::pow(v, j) * std::pow(w, k);
    return sum;
}

constexpr dvec2 places[] = {{0, 0}, {1, 0}, {0, 1}, {0.2, 0.3}, {0.5, 0.5}, {0.1, 0.85}};

TEST(BezierTriangle, HasTheValuesOfItsTerms)
{
    Random random(1);
    for (int i = 0; i < 20; ++i) {
        const auto four = any_polynomial<4>(random);
        const auto ten = any_polynomial<10>(random);
        for (const dvec2& at : places) {
            EXPECT_NEAR(bezier_value(four, at.x, at.y), sum_at(four, at.x, at.y), 1e-14);
            EXPECT_NEAR(bezier_value(ten, at.x, at.y), sum_at(ten, at.x, at.y), 1e-14);
            EXPECT_LE(bezier_value(ten, at.x, at.y), *std::max_element(ten.c.begin(), ten.c.end()) + 1e-15);
        }
    }
}

TEST(BezierTriangle, HasItsDerivatives)
{
    Random random(2);
    constexpr double step = 1e-5;
    for (int i = 0; i < 20; ++i) {
        const auto b = any_polynomial<10>(random);
        for (const dvec2& at : {dvec2(0.2, 0.3), dvec2(0.6, 0.1), dvec2(0.1, 0.7)}) {
            const BezierPoint<double> point = bezier_point(b, at.x, at.y);
            EXPECT_NEAR(point.value, bezier_value(b, at.x, at.y), 1e-14);
            EXPECT_NEAR(point.dv, bezier_value(bezier_dv(b), at.x, at.y), 1e-12);
            EXPECT_NEAR(point.dw, bezier_value(bezier_dw(b), at.x, at.y), 1e-12);
            EXPECT_NEAR(point.dv, (bezier_value(b, at.x + step, at.y) - bezier_value(b, at.x - step, at.y)) / (2 * step), 1e-7);
            EXPECT_NEAR(point.dw, (bezier_value(b, at.x, at.y + step) - bezier_value(b, at.x, at.y - step)) / (2 * step), 1e-7);
        }
    }
}

TEST(BezierTriangle, MultipliesAsItsValuesDo)
{
    Random random(3);
    for (int i = 0; i < 20; ++i) {
        const auto a = any_polynomial<4>(random);
        const auto b = any_polynomial<6>(random);
        const auto product = bezier_product(a, b, [](double x, double y) { return x * y; });
        for (const dvec2& at : places) {
            EXPECT_NEAR(bezier_value(product, at.x, at.y), bezier_value(a, at.x, at.y) * bezier_value(b, at.x, at.y), 1e-13);
        }
    }
}

TEST(BezierTriangle, IsTheSameOverAPartOfIt)
{
    Random random(4);
    const std::array<dvec3, 3> corners = {dvec3(0.5, 0.5, 0), dvec3(0, 0.5, 0.5), dvec3(0.25, 0, 0.75)};
    for (int i = 0; i < 20; ++i) {
        const auto b = any_polynomial<10>(random);
        const auto part = bezier_part(b, corners);
        for (const dvec2& at : places) {
            const dvec3 whole = (1 - at.x - at.y) * corners[0] + at.x * corners[1] + at.y * corners[2];
            EXPECT_NEAR(bezier_value(part, at.x, at.y), bezier_value(b, whole.y, whole.z), 1e-13);
        }
    }
}

/// The polynomial with some roots, in Bernstein form: a product of lines.
std::vector<double> with_roots(const std::vector<double>& roots)
{
    std::vector<double> c = {1};
    for (const double root : roots) {
        const std::size_t n = c.size(); // times (t - root), whose coefficients are -root and 1 - root
        std::vector<double> next(n + 1);
        for (std::size_t i = 0; i <= n; ++i)
            next[i] = ((i < n ? double(n - i) * c[i] * -root : 0) + (i > 0 ? double(i) * c[i - 1] * (1 - root) : 0)) / double(n);
        c = next;
    }
    return c;
}

std::vector<double> roots_of(const std::vector<double>& c)
{
    std::vector<double> roots;
    append_sign_changes(c, roots);
    return roots;
}

TEST(BezierRoots, AreAllFound)
{
    Random random(5);
    for (int i = 0; i < 500; ++i) {
        std::vector<double> known, within;
        const int degree = 1 + i % 10;
        for (int k = 0; k < degree; ++k) {
            known.push_back(random.uniform(-0.5, 1.5));
            if (known.back() > 0 && known.back() < 1)
                within.push_back(known.back());
        }
        std::sort(within.begin(), within.end());
        const std::vector<double> found = roots_of(with_roots(known));
        ASSERT_EQ(found.size(), within.size()) << i;
        for (std::size_t k = 0; k < found.size(); ++k) {
            EXPECT_NEAR(found[k], within[k], 1e-6) << i; // near roots of such a degree are ill-conditioned
        }
    }
}

TEST(BezierRoots, AreFoundInPairs)
{
    for (const double apart : {1e-1, 1e-3, 1e-5}) {
        const std::vector<double> found = roots_of(with_roots({0.3, 0.3 + apart, 1.4, -0.2}));
        ASSERT_EQ(found.size(), 2u) << apart;
        EXPECT_NEAR(found[1] - found[0], apart, 0.01 * apart);
    }
    EXPECT_TRUE(roots_of(with_roots({0.3, 0.3 + 1e-9})).empty()); // nearer than 2^-20: taken for none
    EXPECT_TRUE(roots_of(with_roots({0.5, 0.5})).empty());        // touches 0, and changes no sign
}

TEST(BezierRoots, CountsNothingAsPositive)
{
    EXPECT_TRUE(roots_of({0, 0, 0}).empty());
    EXPECT_TRUE(roots_of({0, 1, 0}).empty());
    EXPECT_EQ(roots_of({0, -1, -2}).size(), 1u);
    EXPECT_EQ(roots_of({-1, 1}), std::vector<double>{0.5});
    std::vector<double> behind = {7};
    append_sign_changes(std::vector<double>{1, -1}, behind);
    EXPECT_EQ(behind, (std::vector<double>{7, 0.5}));
}

} // namespace
} // namespace limn::test
