// Jet fits: sections 3, 4 and 6.3 of the curvature-jets specification; items 3, 4 and 13 of the contour-lines checklist.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/base/parallel.h"
#include "limn/surface/estimate.h"
#include "limn/surface/jets.h"
#include "limn/surface/surface_point.h"
#include "limn/surface/tangent.h"
#include "support/instruction_sets.h"
#include "surface/surface_error.h"

namespace limn::test {
namespace {

JetContext context_of(const Mesh& mesh)
{
    return make_jet_context(mesh, build_vertex_faces(mesh.triangles, mesh.positions.size()));
}

constexpr JetSetting standard = {{4, true}, 2};

/// Error of the derivative on the jittered torus, where the default choice must be made and no fit may fail.
double jittered_torus_error(std::size_t triangles)
{
    const Shape torus = make_test_shape("torus", triangles);
    EstimateReport report;
    const Surface surface = estimate_surface(torus.mesh, {}, &report);
    EXPECT_EQ(report.radius, 2);
    EXPECT_EQ(report.failed, 0u);
    return derivative_error(surface, torus.exact).all;
}

/// The measured errors of the specification are .0079, .0019, .00049 and .00012.
void expect_second_order(const std::vector<std::size_t>& triangles, const std::vector<double>& bounds)
{
    double last = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const double error = jittered_torus_error(triangles[i]);
        EXPECT_LE(error, bounds[i]) << triangles[i];
        if (i > 0) {
            EXPECT_GE(std::log2(last / error), 1.8) << triangles[i];
        }
        last = error;
    }
}

TEST(Jets, DerivativeOfAJitteredTorusConvergesWithSecondOrder) { expect_second_order({31'000, 124'000, 496'000}, {0.0101, 0.0025, 0.00065}); }

TEST(Jets, DerivativeOfAJitteredTorusConvergesOverFourLevelsSlow)
{
    expect_second_order({31'000, 124'000, 496'000, 1'984'000}, {0.0101, 0.0025, 0.00065, 0.00016});
}

TEST(Jets, CurvatureAndNormalsOfAJitteredTorusAreRightToFiveDigits)
{
    const Shape torus = make_test_shape("torus", 124'000);
    const Surface surface = estimate_surface(torus.mesh);
    EXPECT_LE(k1_error(surface, torus.exact), 1e-5);
    EXPECT_LE(normal_error(surface, torus.exact), 1e-6);
}

// Checklist 2, 3 and 4. The bound of C, 1 %, was set for the tensor method; jets reach over two rings (specification: .0018 at 124k,
// second order, which is .0137 here).
TEST(Jets, HoldTheBoundsOfTheRegularTorus)
{
    double last_k = 0, last_c = 0;
    for (const std::size_t triangles : {16'384u, 65'536u, 262'144u}) {
        const Shape torus = make_test_shape("torus", triangles, 0);
        const Surface surface = estimate_surface(torus.mesh);
        const double k = k1_error(surface, torus.exact), c = derivative_error(surface, torus.exact).all;
        if (triangles == 16'384u) {
            EXPECT_LE(normal_error(surface, torus.exact), 1e-4);
            EXPECT_LE(k, 0.0005);
            EXPECT_LE(c, 0.018);
        } else {
            EXPECT_GE(std::log2(last_k / k), 1.9) << triangles;
            EXPECT_GE(std::log2(last_c / c), 1.9) << triangles;
        }
        fmt::print("[   jets    ] regular torus {}: k1 {:.2e}, C {:.2e}\n", triangles, k, c);
        last_k = k;
        last_c = c;
    }
}

TEST(Jets, DerivativeOfATorusInFloatStaysWithinTwoPercent)
{
    for (const std::size_t triangles : {124'000u, 500'000u}) {
        const Shape torus = make_test_shape("torus", triangles, 0.2, true);
        EXPECT_LE(derivative_error(estimate_surface(torus.mesh), torus.exact).all, 0.02) << triangles;
    }
}

TEST(Jets, DerivativeOfATorusInFloatStaysWithinTwoPercentAtTwoMillionTrianglesSlow)
{
    const Shape torus = make_test_shape("torus", 2'000'000, 0.2, true);
    EXPECT_LE(derivative_error(estimate_surface(torus.mesh), torus.exact).all, 0.02);
}

TEST(Jets, EveryComponentOfAnEllipsoidConvergesWithItsSign)
{
    dvec4 last(0);
    for (const std::size_t triangles : {31'000u, 123'000u}) {
        const Shape ellipsoid = make_test_shape("ellipsoid", triangles);
        const DerivativeError error = derivative_error(estimate_surface(ellipsoid.mesh), ellipsoid.exact);
        for (int k = 0; k < 4; ++k) {
            EXPECT_LE(error.each[k], triangles == 31'000u ? 0.015 : 0.004) << "PQST"[k] << " at " << triangles;
            if (last[k] > 0) {
                EXPECT_GE(std::log2(last[k] / error.each[k]), 1.5) << "PQST"[k];
            }
        }
        last = error.each;
    }
}

TEST(Jets, ATiltedHeightDirectionStillConverges)
{
    const Shape torus = make_test_shape("torus", 124'000);
    JetContext context = context_of(torus.mesh);
    for (dvec3& n : context.normals)
        n = glm::normalize(n + std::tan(0.436) * any_frame(n).u); // 25 degrees
    Surface surface;
    fit_surface(context, standard, Need::derivative, surface);
    EXPECT_LE(derivative_error(surface, torus.exact).all, 0.03);
}

template <class T> T quartic(const T& x, const T& y)
{
    return 0.3 * x - 0.2 * y + 0.8 * x * x - 0.5 * x * y + 0.3 * y * y + 0.7 * x * x * x - 0.4 * x * x * y + 0.6 * x * y * y
         - 0.9 * y * y * y + 0.5 * x * x * x * x + 0.2 * x * x * y * y;
}

/// The graph of a quartic with a slope at the origin, seen from the origin through 30 scattered points.
struct QuarticGraph {
    std::vector<dvec3> positions = {dvec3(0)}, normals;
    Neighbourhoods hoods;
    QuarticGraph()
    {
        Random random(5);
        hoods.clear();
        for (std::uint32_t i = 1; i <= 30; ++i) {
            const double x = random.uniform(-0.5, 0.5), y = random.uniform(-0.5, 0.5);
            positions.push_back({x, y, quartic(x, y)});
            hoods.neighbour.push_back(i);
        }
        hoods.close(0);
        normals.assign(positions.size(), dvec3(0, 0, 1));
    }
};

TEST(Jets, AQuarticGraphIsFittedExactly)
{
    const QuarticGraph graph;
    const SurfacePoint exact = surface_point({Taylor::u(0), Taylor::v(0), quartic(Taylor::u(0), Taylor::v(0))});
    for (const bool interpolating : {true, false}) {
        Jet jet;
        fit_jets({graph.positions, graph.normals, &graph.hoods, true}, {4, interpolating}, {&jet, 1});
        ASSERT_TRUE(jet.ok);
        EXPECT_LE(jet.residual, 1e-12);
        EXPECT_LE(glm::distance(jet.normal, exact.normal), 1e-12);
        EXPECT_NEAR(std::abs(glm::dot(jet.e1, exact.e1)), 1, 1e-12);
        EXPECT_NEAR(jet.k1, exact.k1, 1e-10);
        EXPECT_NEAR(jet.k2, exact.k2, 1e-10);
        const double sign = glm::dot(jet.e1, exact.e1) < 0 ? -1 : 1;
        EXPECT_LE(glm::distance(sign * jet.derivative, exact.derivative), 1e-9);
    }
}

TEST(Jets, AFitDoesNotDependOnItsNeighboursInTheBatch)
{
    const Mesh mesh = make_test_shape("torus", 3000).mesh;
    const JetContext context = context_of(mesh);
    RingCollector collector(context.positions, context.normals, context.neighbours);
    Neighbourhoods all, one;
    all.clear();
    for (std::uint32_t v = 0; v < 21; ++v) {
        collector.collect(v, {.rings = 2 + int(v % 3)}, all.neighbour);
        all.close(v);
    }
    std::vector<Jet> together(21);
    fit_jets({context.positions, context.normals, &all, false}, {4, false}, together);
    for (std::uint32_t v = 0; v < 21; ++v) {
        one.clear();
        collector.collect(v, {.rings = 2 + int(v % 3)}, one.neighbour);
        one.close(v);
        Jet alone;
        fit_jets({context.positions, context.normals, &one, false}, {4, false}, {&alone, 1});
        EXPECT_EQ(alone.k1, together[v].k1) << v;
        EXPECT_EQ(alone.derivative, together[v].derivative) << v;
    }
}

TEST(Jets, AFitToCollinearPointsFails)
{
    QuarticGraph graph;
    for (dvec3& p : graph.positions)
        p.y = 0.5 * p.x;
    Jet jet;
    fit_jets({graph.positions, graph.normals, &graph.hoods, false}, {4, true}, {&jet, 1});
    EXPECT_FALSE(jet.ok);
}

/// Rows from the border of a sheet: 0 on it.
std::vector<int> border_rows(const Mesh& mesh)
{
    const Adjacency adjacency = build_adjacency(mesh.triangles, mesh.positions.size());
    std::vector<int> row(mesh.positions.size(), 1000);
    for (std::uint32_t h = 0; h < adjacency.twin.size(); ++h)
        if (adjacency.twin[h] == none)
            row[mesh.triangles[h / 3][int(h % 3)]] = row[mesh.triangles[h / 3][int((h + 1) % 3)]] = 0;
    for (int pass = 1; pass <= 3; ++pass)
        for (const uvec3& t : mesh.triangles)
            for (int k = 0; k < 3; ++k)
                if (row[t[k]] == pass - 1)
                    for (int j = 0; j < 3; ++j)
                        row[t[j]] = std::min(row[t[j]], pass);
    return row;
}

/// Error of the derivative in a row, in units of its size over the whole mesh.
double row_error(const Shape& shape, const Surface& surface, const std::vector<int>& rows, int row)
{
    double error = 0, size = 0;
    std::size_t count = 0;
    for (std::size_t v = 0; v < rows.size(); ++v) {
        const dvec4 d = derivative_difference(surface, shape.exact, v), exact(shape.exact.derivative[v]);
        size += glm::dot(exact, exact) / double(rows.size());
        if (rows[v] == row) {
            error += glm::dot(d, d);
            ++count;
        }
    }
    return std::sqrt(error / double(count) / size);
}

// Specification, section 4: border, next row and interior .068 / .016 / .008 at 15k, .0038 / .0009 / .0005 at 247k, 8 times
// the interior on its sheet; on ours 9 to 10 times.
TEST(Jets, BordersConvergeWithSecondOrderAndStayWithinAFactorOfTheInterior)
{
    double last = 0;
    for (const std::size_t triangles : {15'000u, 60'000u, 240'000u}) {
        const Shape sheet = make_test_shape("bent-sheet", triangles);
        const Surface surface = estimate_surface(sheet.mesh, {.radius = 2});
        const std::vector<int> rows = border_rows(sheet.mesh);
        const double border = row_error(sheet, surface, rows, 0), next = row_error(sheet, surface, rows, 1), interior = row_error(sheet, surface, rows, 1000);
        fmt::print("[   jets    ] rows of a sheet of {}: border {:.4f}, next {:.4f}, interior {:.4f}\n", triangles, border, next, interior);
        EXPECT_LE(next, border) << triangles;
        EXPECT_LE(border, 13 * interior) << triangles;
        EXPECT_LE(border, triangles == 15'000u ? 0.018 : triangles == 60'000u ? 0.0045 : 0.0012);
        if (last > 0) {
            EXPECT_GE(std::log2(last / border), 1.8) << triangles;
        }
        last = border;
    }
}

TEST(Jets, BordersOfRegularGridsAreRefittedInsteadOfRankDeficient)
{
    const Shape sheet = make_test_shape("bent-sheet", 60'000, 0);
    EstimateReport report;
    const Surface surface = estimate_surface(sheet.mesh, {.radius = 2}, &report);
    EXPECT_LE(row_error(sheet, surface, border_rows(sheet.mesh), 0), 0.05);
    EXPECT_EQ(report.failed, 0u);
}

TEST(Jets, FoldedSliversDoNotFlipANormal)
{
    const Shape folded = make_test_shape("torus", 62'000, 0.4);
    const Surface surface = estimate_surface(folded.mesh, {.radius = 2});
    EXPECT_LE(derivative_error(surface, folded.exact).all, 0.012);
    for (std::size_t v = 0; v < surface.normals.size(); ++v)
        ASSERT_GT(glm::dot(surface.normals[v], folded.exact.normals[v]), 0.999f) << "at vertex " << v;
}

TEST(Jets, ASphereHasNoDerivativeAndAPlaneNothing)
{
    const Shape sphere = make_test_shape("sphere", 62'000);
    EstimateReport report;
    const Surface on_sphere = estimate_surface(sphere.mesh, {}, &report);
    EXPECT_TRUE(report.reliable);
    EXPECT_EQ(report.radius, 2);
    for (std::size_t v = 0; v < on_sphere.k1.size(); ++v) {
        ASSERT_NEAR(on_sphere.k1[v], 1, 1e-3) << v;
        ASSERT_LE(glm::length(on_sphere.derivative[v]), 1e-3f) << v;
    }
    const Shape plane = make_test_shape("plane", 5'000);
    const Surface on_plane = estimate_surface(plane.mesh, {}, &report);
    EXPECT_TRUE(report.reliable);
    for (std::size_t v = 0; v < on_plane.k1.size(); ++v) {
        ASSERT_NEAR(on_plane.k1[v], 0, 1e-6) << v;
        ASSERT_LE(glm::length(on_plane.derivative[v]), 1e-4f) << v;
    }
}

TEST(Jets, ScaleAndPlaceOfTheModelOnlyScaleTheResult)
{
    const Shape torus = make_test_shape("torus", 20'000);
    const Surface reference = estimate_surface(torus.mesh);
    for (const double scale : {1e-6, 37.0, 1e6}) {
        Mesh mesh = torus.mesh;
        for (dvec3& p : mesh.positions)
            p = scale * (p + dvec3(3, -2, 1));
        Surface surface = estimate_surface(mesh);
        for (std::size_t v = 0; v < reference.k1.size(); ++v) {
            ASSERT_NEAR(surface.k1[v] * scale, reference.k1[v], 1e-5 * std::abs(reference.k1[v]));
            surface.derivative[v] *= float(scale * scale);
        }
        EXPECT_LE(derivative_error(surface, reference).all, 1e-5) << scale;
    }
}

// Checklist 3: what rounding the positions to float may do to curvature.
TEST(Estimate, CurvatureFromFloatPositionsIsScaledWithinTheirRounding)
{
    const Shape torus = make_test_shape("torus", 20'000, 0);
    const double h = mean_edge(torus.mesh), bound = 8 * 0x1p-24 * 1.4 / (h * h);
    for (const CurvatureMethod method : {CurvatureMethod::jets, CurvatureMethod::tensor}) {
        const Surface reference = estimate_surface(torus.mesh, {.method = method, .radius = 2});
        double worst = 0;
        for (const double scale : {0.3, 37.0}) {
            Mesh mesh = torus.mesh;
            for (dvec3& p : mesh.positions)
                p = dvec3(vec3(scale * p));
            const Surface surface = estimate_surface(mesh, {.method = method, .radius = 2});
            for (std::size_t v = 0; v < reference.k1.size(); ++v)
                worst = std::max(worst, std::abs(surface.k1[v] * scale - reference.k1[v]));
        }
        fmt::print("[ estimate  ] curvature moves by {:.2e} through float positions, allowed {:.2e}\n", worst, bound);
        EXPECT_LE(worst, bound);
    }
}

TEST(Jets, ARotatedModelGivesARotatedResult)
{
    const Shape torus = make_test_shape("torus", 20'000);
    const Surface reference = estimate_surface(torus.mesh);
    const dvec3 axis = glm::normalize(dvec3(1, 2, 3));
    const double c = std::cos(1.1), s = std::sin(1.1);
    const auto turn = [&](const dvec3& x) { return c * x + s * glm::cross(axis, x) + (1 - c) * glm::dot(axis, x) * axis; };
    Mesh mesh = torus.mesh;
    for (dvec3& p : mesh.positions)
        p = turn(p);
    Surface expected = reference;
    for (std::size_t v = 0; v < reference.k1.size(); ++v) {
        expected.normals[v] = vec3(turn(dvec3(reference.normals[v])));
        expected.e1[v] = vec3(turn(dvec3(reference.e1[v])));
    }
    const Surface surface = estimate_surface(mesh);
    EXPECT_LE(k1_error(surface, expected), 1e-5);
    EXPECT_LE(normal_error(surface, expected), 1e-6);
    EXPECT_LE(derivative_error(surface, expected).all, 1e-5);
}

TEST(Jets, AnInsideOutMeshTurnsTheSignsThatItShould)
{
    Shape ellipsoid = make_test_shape("ellipsoid", 20'000);
    const Surface outside = estimate_surface(ellipsoid.mesh);
    for (uvec3& t : ellipsoid.mesh.triangles)
        std::swap(t.y, t.z);
    const Surface inside = estimate_surface(ellipsoid.mesh);
    for (std::size_t v = 0; v < outside.k1.size(); ++v) {
        ASSERT_NEAR(inside.k1[v], -outside.k1[v], 1e-3);
        ASSERT_LE(glm::distance(inside.normals[v], -outside.normals[v]), 1e-4f);
    }
    // n and e2 turn with the side: k, P and S change their sign, Q and T keep it (for the same e1).
    dvec4 error(0), size(0);
    for (std::size_t v = 0; v < outside.k1.size(); ++v) {
        const double sign = glm::dot(inside.e1[v], outside.e1[v]) < 0 ? -1 : 1;
        const dvec4 expected = dvec4(-1, 1, -1, 1) * dvec4(outside.derivative[v]);
        const dvec4 d = sign * dvec4(inside.derivative[v]) - expected;
        error += d * d;
        size += expected * expected;
    }
    for (int k = 0; k < 4; ++k)
        EXPECT_LE(std::sqrt(error[k] / size[k]), 0.02) << "PQST"[k];
}

TEST(Jets, GiveTheSameBytesForOneAndTwoThreads)
{
    const Mesh mesh = with_noise(make_test_shape("torus", 12'000).mesh, 1e-3);
    for (const int radius : {0, 2, 4}) {
        const EstimateOptions options = {.radius = radius, .smooth = radius / 2};
        const Surface one = with_threads(1, [&] { return estimate_surface(mesh, options); });
        const Surface two = with_threads(2, [&] { return estimate_surface(mesh, options); });
        EXPECT_EQ(one.normals, two.normals);
        EXPECT_EQ(one.e1, two.e1);
        EXPECT_EQ(one.e2, two.e2);
        EXPECT_EQ(one.k1, two.k1);
        EXPECT_EQ(one.k2, two.k2);
        EXPECT_EQ(one.derivative, two.derivative);
    }
}

/// The largest difference of curvature and of the derivative between two sets of fits, relative to the largest of each.
struct JetDifference {
    double k = 0, derivative = 0;
    std::size_t states = 0; ///< fits that one of them has and the other has not
};

JetDifference largest_difference(const std::vector<Jet>& a, const std::vector<Jet>& b)
{
    JetDifference difference;
    double largest_k = 0, largest_derivative = 0;
    for (std::size_t v = 0; v < a.size(); ++v) {
        difference.states += a[v].ok != b[v].ok;
        if (!a[v].ok || !b[v].ok)
            continue;
        const double sign = glm::dot(a[v].e1, b[v].e1) < 0 ? -1 : 1;
        difference.k = std::max({difference.k, std::abs(a[v].k1 - b[v].k1), std::abs(a[v].k2 - b[v].k2)});
        difference.derivative = std::max(difference.derivative, glm::distance(sign * a[v].derivative, b[v].derivative));
        largest_k = std::max(largest_k, std::abs(b[v].k1));
        largest_derivative = std::max(largest_derivative, glm::length(b[v].derivative));
    }
    difference.k /= largest_k;
    difference.derivative /= largest_derivative;
    return difference;
}

// Vectors without a fused multiply-add round once more, and the normal equations magnify that by their condition: 7e-13 and 5e-12
// measured on SSE4; AVX2 and AVX-512 give the same bits.
TEST(Jets, AreTheSameOnEveryInstructionSetWithinRounding)
{
    const Mesh mesh = make_test_shape("torus", 20'000).mesh;
    const JetContext context = context_of(mesh);
    for (const JetModel model : {JetModel{4, true}, JetModel{4, false}, JetModel{3, true}, JetModel{3, false}}) {
        RingCollector collector(context.positions, context.normals, context.neighbours);
        Neighbourhoods hoods;
        hoods.clear();
        for (std::uint32_t v = 0; v < context.positions.size(); ++v) {
            collector.collect(v, {.rings = model.interpolating ? 2 : 3}, hoods.neighbour);
            hoods.close(v);
        }
        const JetProblem problem = {context.positions, context.normals, &hoods, false};
        std::vector<Jet> best(hoods.size()), other(hoods.size());
        fit_jets(problem, model, best);
        int sets = 0;
        with_each_instruction_set([&](const char* name) {
            fit_jets(problem, model, other);
            const JetDifference difference = largest_difference(other, best);
            fmt::print("[   jets    ] degree {}{} on {}: k {:.1e}, derivative {:.1e}\n", model.degree, model.interpolating ? " interpolating" : " free", name,
                       difference.k, difference.derivative);
            EXPECT_EQ(difference.states, 0u) << name;
            EXPECT_LE(difference.k, 2e-12) << name;
            EXPECT_LE(difference.derivative, 1e-11) << name;
            ++sets;
        });
        EXPECT_GE(sets, 1);
    }
}

TEST(Jets, CurvatureIsTheSameWithAndWithoutItsDerivative)
{
    const Shape torus = make_test_shape("torus", 10'000);
    const Surface both = estimate_surface(torus.mesh), one = estimate_surface(torus.mesh, {.need = Need::curvature});
    EXPECT_EQ(both.k1, one.k1);
    EXPECT_FALSE(one.has_derivative());
    EXPECT_FALSE(estimate_surface(torus.mesh, {.need = Need::normals}).has_curvature());
}

} // namespace
} // namespace limn::test
