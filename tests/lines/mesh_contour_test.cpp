#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <random>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "edge_shapes.h"
#include "limn/base/parallel.h"
#include "limn/geometry/read_mesh.h"
#include "limn/lines/contour.h"
#include "limn/lines/mesh_contour.h"
#include "limn/surface/estimate.h"
#include "limn/surface/shapes.h"

namespace limn {
namespace {

using test::icosphere, test::model_of, test::stretched;

const dvec3 axes(1, 0.7, 0.5);

std::vector<View> random_views(int count, bool with_orthographic)
{
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::vector<View> views;
    for (int i = 0; i < count; ++i) {
        const dvec3 d = glm::normalize(dvec3(normal(random), normal(random), normal(random)));
        const bool orthographic = with_orthographic && i % 2;
        views.push_back({orthographic, vec3(orthographic ? d : 4.0 * d)});
    }
    return views;
}

/// Signed volume of the tetrahedron of a face and the eye: positive where the face is seen from its front.
double seen_volume(const LineModel& model, const View& view, std::uint32_t face)
{
    const uvec3 t = model.faces[face];
    const dvec3 p = model.positions[t.x], q = model.positions[t.y], r = model.positions[t.z];
    const dvec3 to_eye = view.orthographic ? dvec3(view.eye) : dvec3(view.eye) - p;
    return glm::determinant(dmat3(q - p, r - p, to_eye));
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::multiset<Edge> edges_of(const std::vector<Segment>& segments)
{
    std::multiset<Edge> edges;
    for (const Segment& s : segments)
        edges.insert(std::minmax(s.edge_a, s.edge_b));
    return edges;
}

std::multiset<Edge> edges_by_brute_force(const LineModel& model, const View& view)
{
    std::map<Edge, std::vector<std::uint32_t>> faces;
    for (std::uint32_t f = 0; f < model.faces.size(); ++f)
        for (int k = 0; k < 3; ++k)
            faces[std::minmax(model.faces[f][k], model.faces[f][(k + 1) % 3])].push_back(f);
    std::multiset<Edge> edges;
    for (const auto& [edge, sides] : faces)
        if (sides.size() == 2 && (seen_volume(model, view, sides[0]) > 0) != (seen_volume(model, view, sides[1]) > 0))
            edges.insert(edge);
    return edges;
}

double length_of(const std::vector<Segment>& segments)
{
    double length = 0;
    for (const Segment& s : segments)
        length += double(glm::distance(s.a, s.b));
    return length;
}

TEST(MeshContour, IsEveryEdgeBetweenAFrontAndABackFaceOnce) // checklist 7
{
    for (const LineModel& model : {model_of(stretched(icosphere(3), axes)), model_of(test::cylinder(17)), model_of(test::cube()),
                                   model_of(test::sheet(9, 7, [](double u, double v) { return dvec3(u, v, 0.3 * std::sin(9 * u + 4 * v)); }))})
        for (const View& view : random_views(20, true)) {
            const auto segments = extract_mesh_contours(model, view);
            ASSERT_EQ(edges_of(segments), edges_by_brute_force(model, view));
            for (const Segment& s : segments) {
                ASSERT_GT(seen_volume(model, view, s.face), 0) << "a segment belongs to its front face";
                ASSERT_EQ(s.a, model.positions[s.edge_a]);
                ASSERT_EQ(s.b, model.positions[s.edge_b]);
            }
        }
}

TEST(MeshContour, FormsClosedLoopsOnAClosedMesh)
{
    const LineModel model = model_of(stretched(icosphere(4), axes));
    for (const View& view : random_views(20, true)) {
        std::map<std::uint32_t, int> balance, degree;
        const auto segments = extract_mesh_contours(model, view);
        ASSERT_FALSE(segments.empty());
        for (const Segment& s : segments) {
            ++balance[s.edge_a], --balance[s.edge_b];
            ++degree[s.edge_a], ++degree[s.edge_b];
        }
        for (const auto& [vertex, sum] : balance)
            ASSERT_EQ(sum, 0) << "as many segments start as end at vertex " << vertex;
        for (const auto& [vertex, count] : degree)
            ASSERT_EQ(count % 2, 0);
    }
}

/// In the model's frame an ellipsoid p.(A p) = 1 and the eye c: the contour lies in the plane p.(A c) = 1.
struct EllipsoidView {
    dvec3 semi_axes, eye;
    dvec3 plane() const { return eye / (semi_axes * semi_axes); }
    double distance(const dvec3& p) const { return (glm::dot(p, plane()) - 1) / glm::length(plane()); }
    double length() const; ///< of the contour, by summing chords
};

double EllipsoidView::length() const
{
    // In coordinates scaled by 1/axes the ellipsoid is a sphere and the contour a circle in the plane q.d = 1.
    const dvec3 d = eye / semi_axes;
    const double distance = 1 / glm::length(d), radius = std::sqrt(1 - distance * distance);
    const dvec3 n = glm::normalize(d), u = glm::normalize(glm::cross(n, std::abs(n.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0))), v = glm::cross(n, u);
    const auto point = [&](int i) {
        const double angle = 2 * std::numbers::pi * i / 20000;
        return semi_axes * (distance * n + radius * (std::cos(angle) * u + std::sin(angle) * v));
    };
    double sum = 0;
    for (int i = 0; i < 20000; ++i)
        sum += glm::distance(point(i), point(i + 1));
    return sum;
}

struct Accuracy {
    double mesh_rms = 0, mesh_ratio = 0, smooth_ratio = 0; ///< means over the views
};

Accuracy measure_ellipsoid(int levels)
{
    const Mesh mesh = stretched(icosphere(levels), axes);
    const LineModel model = model_of(mesh, test::ellipsoid_normals(mesh, axes));
    const dvec3 scaled = axes / model.scale;
    Accuracy mean;
    const std::vector<View> views = random_views(12, false);
    for (const View& view : views) {
        const EllipsoidView truth = {scaled, dvec3(view.eye)};
        const auto segments = extract_mesh_contours(model, view);
        double squares = 0;
        for (const Segment& s : segments)
            squares += std::pow(truth.distance(dvec3(s.a)), 2) / double(segments.size());
        mean.mesh_rms += std::sqrt(squares) / double(views.size());
        mean.mesh_ratio += length_of(segments) / truth.length() / double(views.size());
        mean.smooth_ratio += length_of(extract_contours(model, facing_of_vertices(model, view))) / truth.length() / double(views.size());
    }
    return mean;
}

TEST(MeshContour, ConvergesToFirstOrderInPositionButNotInLength) // checklist 7
{
    const Accuracy coarse = measure_ellipsoid(3), middle = measure_ellipsoid(4), fine = measure_ellipsoid(5);
    EXPECT_NEAR(std::log2(coarse.mesh_rms / middle.mesh_rms), 1, 0.25);
    EXPECT_NEAR(std::log2(middle.mesh_rms / fine.mesh_rms), 1, 0.25);
    for (const Accuracy& level : {coarse, middle, fine}) {
        EXPECT_GT(level.mesh_ratio, 1.17) << "zig-zag edges are longer than the contour at every level";
        EXPECT_LT(level.mesh_ratio, 1.27);
    }
    EXPECT_GT(fine.smooth_ratio, 0.999);
    EXPECT_LT(fine.smooth_ratio, 1.001);
}

/// How many closed loops the lines have, those that touch counted one by one: segments - nodes + connected loops.
std::size_t loops_of(const std::vector<Segment>& segments)
{
    std::map<std::uint32_t, std::uint32_t> parent;
    const auto root = [&](std::uint32_t node) {
        parent.try_emplace(node, node);
        while (parent[node] != node)
            node = parent[node] = parent[parent[node]];
        return node;
    };
    for (const Segment& s : segments)
        parent[root(s.edge_a)] = root(s.edge_b);
    std::set<std::uint32_t> roots;
    for (const Segment& s : segments)
        roots.insert(root(s.edge_a));
    return segments.size() + roots.size() - parent.size();
}

struct Loops {
    double on_edges = 0, interpolated = 0; ///< means over the views
};

Loops count_loops(const LineModel& model)
{
    Loops mean;
    const std::vector<View> views = random_views(20, true);
    for (const View& view : views) {
        mean.on_edges += double(loops_of(extract_mesh_contours(model, view))) / double(views.size());
        mean.interpolated += double(loops_of(extract_contours(model, facing_of_vertices(model, view)))) / double(views.size());
    }
    return mean;
}

// Checklist 7: where the normals of neighbouring faces straddle the contour the mesh has loops of its own, which the smooth contour
// has not.
TEST(MeshContour, BreaksIntoLoopsOnCoarseMeshes)
{
    for (const char* name : {"torus", "knot", "bumpy-torus"}) {
        const Shape shape = make_shape({.name = name, .triangles = 2000, .jitter = 0.2});
        const Loops loops = count_loops(model_of(shape.mesh, shape.exact));
        fmt::print("[   loops   ] {} of 2000: {:.1f} loops on edges, {:.1f} interpolated\n", name, loops.on_edges, loops.interpolated);
        EXPECT_GT(loops.on_edges, 2 * loops.interpolated) << name;
    }
}

TEST(MeshContour, OfTheBunnyHasMoreLoopsThanItsInterpolatedContour)
{
    const std::filesystem::path file = "/usr/share/glmark2/models/bunny.obj";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << file << " (package glmark2-data) is not installed";
    const Mesh mesh = read_mesh(file);
    const Loops loops = count_loops(model_of(mesh, estimate_surface(mesh, {.need = Need::normals})));
    fmt::print("[   loops   ] bunny: {:.1f} loops on edges, {:.1f} interpolated\n", loops.on_edges, loops.interpolated);
    EXPECT_GT(loops.on_edges, 4 * loops.interpolated);
}

/// How far the line jumps: the largest distance from the middle of a segment of `to` to the nearest point of `from`.
double largest_jump(const std::vector<Segment>& from, const std::vector<Segment>& to)
{
    const auto distance = [](const vec3& p, const Segment& s) {
        const vec3 d = s.b - s.a;
        const float t = glm::clamp(glm::dot(p - s.a, d) / std::max(glm::dot(d, d), 1e-20f), 0.0f, 1.0f);
        return glm::distance(p, s.a + t * d);
    };
    float largest = 0;
    for (const Segment& s : to) {
        float nearest = 1e9f;
        for (const Segment& r : from)
            nearest = std::min(nearest, distance(0.5f * (s.a + s.b), r));
        largest = std::max(largest, nearest);
    }
    return double(largest);
}

TEST(MeshContour, JumpsAtLeastFiveTimesAsFarAsTheInterpolatedContour) // checklist 8
{
    const Mesh mesh = stretched(icosphere(2), axes);
    const LineModel model = model_of(mesh, test::ellipsoid_normals(mesh, axes));
    const auto view = [](int quarter_degrees) {
        const double a = quarter_degrees * std::numbers::pi / 720;
        return View{false, 4.0f * vec3(dvec3(std::cos(a) * 0.9, 0.436, std::sin(a) * 0.9))};
    };
    double on_edges = 0, interpolated = 0; // sums over the frames of a slow quarter turn
    for (int i = 0; i < 360; ++i) {
        on_edges += largest_jump(extract_mesh_contours(model, view(i)), extract_mesh_contours(model, view(i + 1)));
        interpolated += largest_jump(extract_contours(model, facing_of_vertices(model, view(i))),
                                     extract_contours(model, facing_of_vertices(model, view(i + 1))));
    }
    EXPECT_GT(on_edges, 5 * interpolated) << on_edges << " and " << interpolated;
}

TEST(MeshContour, TakesBordersOfFrontFacesOnlyWhenAsked)
{
    const LineModel model = model_of(test::sheet(4, 3, [](double u, double v) { return dvec3(u, v, 0); }));
    EXPECT_TRUE(extract_mesh_contours(model, {true, vec3(0, 0, 1)}).empty());
    EXPECT_EQ(extract_mesh_contours(model, {true, vec3(0, 0, 1)}, {.borders = true}).size(), 14u);
    EXPECT_TRUE(extract_mesh_contours(model, {true, vec3(0, 0, -1)}, {.borders = true}).empty()) << "the sheet is seen from its back";
    EXPECT_TRUE(extract_mesh_contours(model, {true, vec3(1, 0, 0)}, {.borders = true}).empty()) << "edge-on counts as back";
}

TEST(MeshContour, IgnoresAFaceWithoutArea)
{
    // A square of two triangles, one side of which is split by a sliver that has no area.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 4}, {0, 4, 3}, {4, 2, 3}};
    EXPECT_TRUE(extract_mesh_contours(model_of(mesh), {true, vec3(0, 0, 1)}).empty());
}

TEST(MeshContour, IsTheSameForAnyNumberOfThreads)
{
    const LineModel model = model_of(stretched(icosphere(5), axes));
    const View view = {false, vec3(2, 3, 1)};
    const auto one = with_threads(1, [&] { return extract_mesh_contours(model, view); });
    const auto two = with_threads(2, [&] { return extract_mesh_contours(model, view); });
    ASSERT_EQ(one.size(), two.size());
    for (std::size_t i = 0; i < one.size(); ++i)
        ASSERT_TRUE(one[i].edge_a == two[i].edge_a && one[i].edge_b == two[i].edge_b && one[i].face == two[i].face);
}

} // namespace
} // namespace limn
