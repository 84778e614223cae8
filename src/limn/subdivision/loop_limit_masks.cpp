#include "limn/subdivision/loop_limit_masks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/subdivision/loop_ring.h"

namespace limn {
namespace {

constexpr double pi = std::numbers::pi;

/// A mask of sines with given weights at the vertex and at both creases.
RingMask sine_mask(std::size_t points, double self, double ends, double scale)
{
    RingMask mask{self, std::vector<double>(points, ends)};
    for (std::size_t i = 1; i + 1 < points; ++i)
        mask.points[i] = scale * std::sin(double(i) * pi / double(points - 1));
    return mask;
}

/// The left eigenvector of the local matrix for the eigenvalue 3/8 + cos(a)/4, a = pi / triangles. Its sines settle all columns but
/// those of the vertex (s) and of a crease's end (e): (l - 3/4) s - e = 3/8 cot(a/2) and (l - 1/2) e - s/8 = sin(a)/8.
RingMask opensubdiv_across_mask(std::size_t points)
{
    const double angle = pi / double(points - 1), l = 0.375 + 0.25 * std::cos(angle);
    const double cotangent = 1 / std::tan(angle / 2), sine = std::sin(angle);
    const double ends = (0.375 * cotangent + (l - 0.75) * sine) / (8 * (l - 0.75) * (l - 0.5) - 1);
    return sine_mask(points, 8 * (l - 0.5) * ends - sine, ends, 1);
}

RingMask hoppe_across_mask(std::size_t points, bool regular)
{
    if (regular)
        return opensubdiv_across_mask(points); // all masks around are the same
    if (points == 3)
        return {-1, {0, 1, 0}};
    const double angle = pi / double(points - 1);
    return sine_mask(points, 0, -std::sin(angle), 2 - 2 * std::cos(angle));
}

RingMask biermann_across_mask(std::size_t points)
{
    const double angle = pi / double(points - 1), sine = std::sin(angle);
    return sine_mask(points, -sine, 0.25 * (sine - (1 + std::cos(angle)) / std::tan(angle / 2)), 1);
}

/// The local subdivision matrix of a dart for values that are the same on both sides of its crease: those of the vertex and of the
/// neighbours 0 (along the crease) to n / 2.
Eigen::MatrixXd symmetric_dart_matrix(std::size_t n, CreaseRule rule)
{
    const std::size_t size = n / 2 + 2;
    Eigen::MatrixXd matrix(size, size);
    for (std::size_t column = 0; column < size; ++column) {
        LoopRing ring{dvec3(column == 0), std::vector<dvec3>(n, dvec3(0)), std::vector<float>(n, 0.0f), true};
        ring.sharpness[0] = infinitely_sharp;
        if (column > 0)
            ring.points[column - 1] = ring.points[(n + 1 - column) % n] = dvec3(1);
        const LoopRing next = refined_ring(ring, rule);
        matrix(0, Eigen::Index(column)) = next.centre.x;
        for (std::size_t i = 0; i + 1 < size; ++i)
            matrix(Eigen::Index(i + 1), Eigen::Index(column)) = next.points[i].x;
    }
    return matrix;
}

/// A symmetric mask from a left eigenvector of that matrix: pairs of neighbours share their weight.
RingMask unfolded(const Eigen::VectorXd& vector, std::size_t n)
{
    RingMask mask{vector(0), std::vector<double>(n)};
    for (std::size_t i = 0; i <= n / 2; ++i) {
        const std::size_t other = (n - i) % n;
        mask.points[i] = mask.points[other] = vector(Eigen::Index(i + 1)) / (i == other ? 1 : 2);
    }
    return mask;
}

} // namespace

LimitMasks smooth_limit_masks(std::size_t n)
{
    LimitMasks masks;
    const double each = 1 / (double(n) + 3 / (8 * loop_beta(n)));
    masks.position = {1 - double(n) * each, std::vector<double>(n, each)};
    for (std::size_t i = 0; i < n; ++i) {
        masks.u.points.push_back(std::cos(2 * pi * double(i) / double(n)));
        masks.v.points.push_back(std::sin(2 * pi * double(i) / double(n)));
    }
    return masks;
}

LimitMasks dart_limit_masks(std::size_t n, CreaseRule rule)
{
    if (n < 2)
        throw Error::Input(fmt::format("a dart has 2 edges or more, not {}", n));
    LimitMasks masks = smooth_limit_masks(n); // v: its sines are 0 along the crease, whatever its rule
    if (rule == CreaseRule::hoppe)
        return masks;
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(symmetric_dart_matrix(n, rule).transpose());
    std::vector<Eigen::Index> order(std::size_t(solver.eigenvalues().size()));
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = Eigen::Index(i);
    std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return solver.eigenvalues()(a).real() > solver.eigenvalues()(b).real(); });
    const Eigen::VectorXd first = solver.eigenvectors().col(order[0]).real(), second = solver.eigenvectors().col(order[1]).real();
    masks.position = unfolded(first / first.sum(), n);
    masks.u = unfolded(second(1) < 0 ? Eigen::VectorXd(-second) : second, n);
    return masks;
}

double crease_limit_weight(bool regular, CreaseRule rule) { return rule == CreaseRule::hoppe && !regular ? 0.6 : 2.0 / 3; }

RingMask across_mask(std::size_t points, bool regular, CreaseRule rule)
{
    if (points == 2)
        return {-2, {1, 1}};
    switch (rule) {
    case CreaseRule::opensubdiv: return opensubdiv_across_mask(points);
    case CreaseRule::hoppe: return hoppe_across_mask(points, regular);
    case CreaseRule::biermann: return biermann_across_mask(points);
    }
    return {};
}

} // namespace limn
