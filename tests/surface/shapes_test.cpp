#include <gtest/gtest.h>

#include "limn/surface/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "limn/base/parallel.h"
#include "limn/base/random.h"
#include "limn/geometry/adjacency.h"
#include "limn/surface/shape_grid.h"
#include "limn/surface/shape_parts.h"

namespace limn {
namespace {

const std::vector<std::string> smooth = {"sphere", "ellipsoid", "torus", "bumpy-torus", "sine-sheet", "bump", "plane", "bent-sheet",
                                         "rings", "knot", "blob", "discs", "spheres"};

ShapeOptions options(const std::string& name, std::size_t triangles = 5000, double jitter = 0)
{
    ShapeOptions o;
    o.name = name, o.triangles = triangles, o.jitter = jitter, o.float_positions = false;
    return o;
}

struct Topology {
    long euler;
    std::size_t border_edges, shells;
};

Topology topology(const Mesh& mesh)
{
    const Adjacency adjacency = build_adjacency(mesh.triangles, mesh.positions.size());
    std::size_t border = 0, edges = 0;
    for (std::uint32_t h = 0; h < adjacency.twin.size(); ++h) {
        border += adjacency.twin[h] == none;
        edges += adjacency.edge_id(h) == h;
    }
    const std::vector<std::uint32_t> shells = find_shells(adjacency);
    return {long(mesh.positions.size()) - long(edges) + long(mesh.triangles.size()), border,
            std::size_t(1 + *std::max_element(shells.begin(), shells.end()))};
}

double signed_volume(const Mesh& mesh)
{
    double sum = 0;
    for (const uvec3& t : mesh.triangles)
        sum += glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z])) / 6;
    return sum;
}

/// A random parameter of a part, away from the border of sheets.
dvec3 random_parameter(const ShapePart& part, Random& random)
{
    if (part.topology == ShapePart::Topology::sphere)
        return glm::normalize(dvec3(random.normal(), random.normal(), random.normal()));
    const dvec2 size = part.high - part.low;
    return {part.low.x + size.x * random.uniform(0.02, 0.98), part.low.y + size.y * random.uniform(0.02, 0.98), 0};
}

/// A small step of the parameter in a random direction.
dvec3 random_step(const ShapePart& part, const dvec3& q, double length, Random& random)
{
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    if (part.topology != ShapePart::Topology::sphere)
        return length * dvec3(std::cos(angle), std::sin(angle), 0);
    const dvec3 side = glm::normalize(glm::cross(q, std::abs(q.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    return length * (std::cos(angle) * side + std::sin(angle) * glm::cross(q, side));
}

TEST(Shapes, AreClosedWithTheRightEulerNumberAndVolumeOutwards)
{
    const struct {
        const char* name;
        long euler;
        std::size_t shells;
    } expected[] = {{"sphere", 2, 1}, {"ellipsoid", 2, 1}, {"blob", 2, 1}, {"discs", 4, 2}, {"spheres", 4, 2}, {"torus", 0, 1},
                    {"bumpy-torus", 0, 1}, {"rings", 0, 3}, {"knot", 0, 1}, {"cube", 2, 1}, {"cylinder", 2, 1}};
    for (const auto& e : expected)
        for (const std::size_t triangles : {100, 5000}) {
            const Shape shape = make_shape(options(e.name, triangles, 0.2));
            const Topology found = topology(shape.mesh);
            EXPECT_TRUE(shape.closed) << e.name;
            EXPECT_EQ(found.border_edges, 0u) << e.name;
            EXPECT_EQ(found.euler, e.euler) << e.name;
            EXPECT_EQ(found.shells, e.shells) << e.name;
            EXPECT_GT(signed_volume(shape.mesh), 0) << e.name;
        }
}

TEST(Shapes, SheetsAreDiscsWithOneBorder)
{
    for (const char* name : {"plane", "sine-sheet", "bump", "bent-sheet"}) {
        const Shape shape = make_shape(options(name, 5000, 0.2));
        const Topology found = topology(shape.mesh);
        EXPECT_FALSE(shape.closed) << name;
        EXPECT_EQ(found.euler, 1) << name;
        EXPECT_GT(found.border_edges, 150u) << name;
        EXPECT_LT(found.border_edges, 250u) << name;
    }
}

TEST(Shapes, MeetTheWantedTriangleCountWithinTenPercent)
{
    for (const std::string& name : shape_names())
        for (const std::size_t triangles : {5000, 7000, 20000, 31415, 50000}) {
            const double made = double(make_shape(options(name, triangles)).mesh.triangles.size());
            EXPECT_NEAR(made / double(triangles), 1, 0.1) << name << " " << triangles;
        }
}

TEST(Shapes, JitterOfTwentyPercentFoldsNoTriangle)
{
    for (const std::string& name : smooth)
        for (const ShapePart& part : shape_parts(name)) {
            const ParameterMesh domain = part_domain(part, 20000, 0.2, 7);
            std::size_t folded = 0;
            for (const uvec3& t : domain.triangles) {
                const dvec3 &a = domain.parameters[t.x], &b = domain.parameters[t.y], &c = domain.parameters[t.z];
                if (part.topology == ShapePart::Topology::sphere) {
                    folded += !(glm::dot(a, glm::cross(b, c)) > 0);
                    continue;
                }
                auto side = [&](const dvec3& q) { // the ends of a period meet
                    const dvec3 d = q - a;
                    const bool periodic = part.topology == ShapePart::Topology::torus;
                    return periodic ? dvec2(std::remainder(d.x, part.high.x), std::remainder(d.y, part.high.y)) : dvec2(d);
                };
                folded += !(side(b).x * side(c).y - side(b).y * side(c).x > 0);
            }
            EXPECT_EQ(folded, 0u) << name;
        }
}

TEST(Shapes, JitteredVerticesStayOnTheSurfaceAndBorder)
{
    for (const dvec3& p : make_shape(options("sphere", 2000, 0.2)).mesh.positions)
        EXPECT_NEAR(glm::length(p), 1, 1e-15);
    std::size_t moved = 0;
    for (const dvec3& p : make_shape(options("torus", 2000, 0.2)).mesh.positions) {
        EXPECT_NEAR(std::hypot(std::hypot(p.x, p.y) - 1, p.z), 0.4, 1e-15);
        moved += std::abs(std::remainder(std::atan2(p.y, p.x), 2 * std::numbers::pi / 64)) > 1e-3;
    }
    EXPECT_GT(moved, 500u);
    const Bounds box = make_shape(options("plane", 2000, 0.2)).mesh.bounds();
    EXPECT_EQ(box.low, dvec3(-1, -1, 0));
    EXPECT_EQ(box.high, dvec3(1, 1, 0));
}

TEST(Shapes, HaveUnitOutwardNormalsAndRightHandedFrames)
{
    for (const std::string& name : smooth) {
        const Shape shape = make_shape(options(name, 3000, 0.2));
        ASSERT_EQ(shape.exact.normals.size(), shape.mesh.positions.size()) << name;
        for (std::size_t i = 0; i < shape.exact.normals.size(); ++i) {
            const vec3 n = shape.exact.normals[i], e1 = shape.exact.e1[i];
            ASSERT_NEAR(glm::length(n), 1, 1e-6) << name;
            ASSERT_NEAR(glm::length(e1), 1, 1e-6) << name;
            ASSERT_NEAR(glm::dot(n, e1), 0, 1e-6) << name;
            ASSERT_LT(glm::distance(glm::cross(n, e1), shape.exact.e2[i]), 1e-6f) << name;
            ASSERT_GE(std::abs(shape.exact.k1[i]) * 1.000001f, std::abs(shape.exact.k2[i])) << name;
        }
    }
    EXPECT_GT(shape_point("torus", {0, 0, 0}).normal.x, 0.999999); // outermost point of the ring
    EXPECT_GT(shape_point("knot", {0, 0, 0}).normal.x, 0.9);       // side away from the axis
    EXPECT_GT(shape_point("blob", {0, 0, 1}).normal.z, 0);
    EXPECT_GT(shape_point("bump", {0, 0, 0}).normal.z, 0.999999);
    EXPECT_GT(shape_point("bent-sheet", {0, 0, 0}).normal.z, 0.999999);
}

TEST(Shapes, SphereHasUnitCurvatureAndNoDerivative)
{
    Random random(1);
    for (int i = 0; i < 100; ++i) {
        const SurfacePoint p = shape_point("sphere", {random.normal(), random.normal(), random.normal()});
        EXPECT_LT(glm::distance(p.normal, p.position), 1e-14);
        EXPECT_NEAR(p.k1, 1, 1e-13);
        EXPECT_NEAR(p.k2, 1, 1e-13);
        EXPECT_LT(glm::length(p.derivative), 1e-12);
    }
}

// Closed forms of the test kit of the contour-lines specification, section 7.
TEST(Shapes, TorusHasTheCurvatureOfItsFormulas)
{
    const double R = 1, r = 0.4;
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        const double around = random.uniform(0, 6.28), tube = random.uniform(0, 6.28), q = R + r * std::cos(tube);
        const SurfacePoint p = shape_point("torus", {around, tube, 0});
        const dvec3 outward = {std::cos(tube) * std::cos(around), std::cos(tube) * std::sin(around), std::sin(tube)};
        const dvec3 along_tube = {-std::sin(tube) * std::cos(around), -std::sin(tube) * std::sin(around), std::cos(tube)};
        const double sign = glm::dot(p.e1, along_tube) > 0 ? 1 : -1;
        EXPECT_LT(glm::distance(p.normal, outward), 1e-14);
        EXPECT_LT(glm::distance(sign * p.e1, along_tube), 1e-13);
        EXPECT_NEAR(p.k1, 1 / r, 1e-13);
        EXPECT_NEAR(p.k2, std::cos(tube) / q, 1e-13);
        EXPECT_LT(glm::distance(p.derivative, dvec4(0, 0, sign * -R * std::sin(tube) / (r * q * q), 0)), 1e-12);
    }
}

TEST(Shapes, EllipsoidHasTheCurvatureOfItsImplicitForm)
{
    const dvec3 axes = {1, 0.7, 0.5};
    Random random(3);
    for (int i = 0; i < 200; ++i) {
        const SurfacePoint p = shape_point("ellipsoid", {random.normal(), random.normal(), random.normal()});
        const dvec3 gradient = p.position / (axes * axes);
        const double g = glm::length(gradient), product = axes.x * axes.y * axes.z;
        const double gauss = 1 / (product * product * g * g * g * g);
        const double trace = glm::dot(dvec3(1), 1.0 / (axes * axes));
        const double mean = (trace * g * g - glm::dot(gradient, gradient / (axes * axes))) / (2 * g * g * g);
        EXPECT_NEAR(glm::dot(p.position, gradient), 1, 1e-14);
        EXPECT_LT(glm::distance(p.normal, gradient / g), 1e-14);
        EXPECT_NEAR(p.k1 * p.k2, gauss, 1e-12 * gauss);
        EXPECT_NEAR((p.k1 + p.k2) / 2, mean, 1e-12 * mean);
    }
}

TEST(Shapes, SineSheetHasInflectionsAtMultiplesOfHalfAPeriod)
{
    for (int m = -2; m <= 2; ++m) {
        const SurfacePoint p = shape_point("sine-sheet", {0.5 * m, 0.3, 0});
        EXPECT_NEAR(p.k1, 0, 1e-13);
        EXPECT_NEAR(p.k2, 0, 1e-13);
    }
    EXPECT_NEAR(shape_point("sine-sheet", {0.25, 0, 0}).k1, 0.1 * 4 * std::numbers::pi * std::numbers::pi, 1e-12);
}

// Normal against positions, shape operator against normals, C against shape operators: each by central differences.
TEST(Shapes, ExactFieldsAgreeWithFiniteDifferences)
{
    for (const std::string& name : smooth) {
        Random random(4);
        for (const ShapePart& part : shape_parts(name))
            for (int i = 0; i < 200; ++i) {
                const dvec3 q = random_parameter(part, random), step = random_step(part, q, 1e-5, random);
                const SurfacePoint p = surface_point(part.jet(q)), a = surface_point(part.jet(q - step)), b = surface_point(part.jet(q + step));
                const dvec3 move = b.position - a.position;
                const double length = glm::length(move), size = std::abs(p.k1) + 1;
                ASSERT_LT(glm::distance(part.point(q), p.position), 1e-14 * 4);
                ASSERT_LT(std::abs(glm::dot(p.normal, move)), 1e-7 * length * size * size * size) << name;
                ASSERT_LT(glm::distance(b.normal - a.normal, p.shape_operator() * move), 1e-5 * length * size * size) << name;
                const dmat3 change = b.shape_operator() - a.shape_operator();
                for (const auto& [x, y] : {std::pair(p.e1, p.e1), std::pair(p.e1, p.e2), std::pair(p.e2, p.e2)})
                    ASSERT_NEAR(glm::dot(x, change * y) / length, p.derivative_along(x, y, move / length),
                                2e-5 * (glm::length(p.derivative) + size * size * size)) << name << " point " << i;
            }
    }
}

// Checklist 4: C(a,b,c), the change of II(a,b) along c, does not depend on the order of the three, in the differences of shape
// operators as in the four numbers that stand for it.
TEST(Shapes, DerivativeOfCurvatureIsSymmetricInItsThreeDirections)
{
    Random random(14);
    const ShapePart part = shape_parts("bumpy-torus").front();
    for (int i = 0; i < 200; ++i) {
        const dvec3 q = random_parameter(part, random);
        const SurfacePoint p = surface_point(part.jet(q));
        struct Direction {
            dvec3 unit;
            dmat3 change; ///< of the shape operator, per unit of length
        };
        std::array<Direction, 3> d;
        for (Direction& x : d) {
            const dvec3 step = random_step(part, q, 1e-5, random);
            const SurfacePoint a = surface_point(part.jet(q - step)), b = surface_point(part.jet(q + step));
            const double length = glm::distance(a.position, b.position);
            x = {(b.position - a.position) / length, (b.shape_operator() - a.shape_operator()) / length};
        }
        const double size = glm::length(p.derivative) + std::pow(std::abs(p.k1) + 1, 3);
        const double stored = p.derivative_along(d[0].unit, d[1].unit, d[2].unit);
        std::array<std::size_t, 3> order = {0, 1, 2};
        do {
            const auto [x, y, z] = order;
            ASSERT_NEAR(p.derivative_along(d[x].unit, d[y].unit, d[z].unit), stored, 1e-13 * size) << "point " << i;
            ASSERT_NEAR(glm::dot(d[x].unit, d[z].change * d[y].unit), stored, 2e-5 * size) << "point " << i;
        } while (std::next_permutation(order.begin(), order.end()));
    }
}

TEST(Shapes, AreTheSameBytesForTheSameSeedAndAnyNumberOfThreads)
{
    auto same = [](const auto& a, const auto& b) {
        return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
    };
    for (const std::string& name : shape_names()) {
        ShapeOptions o = options(name, 8000, 0.2);
        o.noise = 0.001;
        const Shape one = with_threads(1, [&] { return make_shape(o); }), two = with_threads(2, [&] { return make_shape(o); });
        EXPECT_TRUE(same(one.mesh.positions, two.mesh.positions)) << name;
        EXPECT_TRUE(same(one.mesh.triangles, two.mesh.triangles)) << name;
        EXPECT_TRUE(same(one.exact.k1, two.exact.k1)) << name;
        EXPECT_TRUE(same(one.exact.derivative, two.exact.derivative)) << name;
        o.seed = 2;
        EXPECT_FALSE(same(one.mesh.positions, make_shape(o).mesh.positions)) << name;
    }
}

TEST(Shapes, NoiseHasTheWantedStandardDeviationAlongTheNormal)
{
    ShapeOptions o = options("sphere", 20000);
    o.noise = 0.01;
    double sum = 0, squares = 0;
    const Mesh mesh = make_shape(o).mesh;
    for (const dvec3& p : mesh.positions) {
        const double off = glm::length(p) - 1;
        sum += off, squares += off * off;
    }
    const double n = double(mesh.positions.size());
    EXPECT_NEAR(sum / n, 0, 4 * 0.01 / std::sqrt(n));
    EXPECT_NEAR(std::sqrt(squares / n), 0.01, 4 * 0.01 / std::sqrt(2 * n));
}

TEST(Shapes, RoundPositionsToFloatUnlessAskedNotTo)
{
    ShapeOptions o = options("torus");
    std::size_t changed = 0;
    for (const dvec3& p : make_shape(o).mesh.positions)
        changed += dvec3(vec3(p)) != p;
    EXPECT_GT(changed, 2000u);
    o.float_positions = true;
    for (const dvec3& p : make_shape(o).mesh.positions)
        ASSERT_EQ(dvec3(vec3(p)), p);
}

TEST(Shapes, RefuseUnknownNamesAndImpossibleNumbers)
{
    auto message = [](const ShapeOptions& o) {
        try {
            make_shape(o);
        } catch (const Error::Input& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    const std::string unknown = message(options("spere"));
    EXPECT_NE(unknown.find("'spere'"), std::string::npos) << unknown;
    for (const std::string& name : shape_names())
        EXPECT_NE(unknown.find(name), std::string::npos) << unknown;
    for (const std::string& name : shape_names())
        for (const std::size_t triangles : {std::size_t(0), std::size_t(1), std::size_t(1e12)}) {
            const std::string text = message(options(name, triangles));
            EXPECT_NE(text.find("--triangles"), std::string::npos) << name << ": " << text;
        }
    EXPECT_NE(message(options("torus", 5000, -1)).find("--jitter"), std::string::npos);
    EXPECT_NE(message(options("torus", 5000, NAN)).find("--jitter"), std::string::npos);
    ShapeOptions noisy = options("torus");
    noisy.noise = -1;
    EXPECT_NE(message(noisy).find("--noise"), std::string::npos);
}

TEST(Shapes, OptionTableSetsEveryField)
{
    ShapeOptions o;
    for (const auto& row : shape_option_table()) {
        const std::string value = row.name == "triangles" ? "500" : row.name == "jitter" ? "0.25" : row.name == "noise" ? "0.5"
                                : row.name == "seed" ? "7" : "yes";
        EXPECT_NE(row.get(o), value) << row.name;
        row.set(o, value);
        EXPECT_EQ(row.get(o), value) << row.name;
    }
    EXPECT_EQ(o.triangles, 500u);
    EXPECT_EQ(o.jitter, 0.25);
    EXPECT_EQ(o.noise, 0.5);
    EXPECT_EQ(o.seed, 7u);
    EXPECT_FALSE(o.float_positions);
}

} // namespace
} // namespace limn
