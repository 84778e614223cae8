#include <gtest/gtest.h>

#include <map>
#include <set>

#include "limn/base/parallel.h"
#include "limn/subdivision/contour_crossings.h"
#include "limn/subdivision/silhouette_face.h"
#include "subdivision/exact_views.h"

namespace limn::test {
namespace {

/// Meshes of all kinds, then those that outlines are measured on.
std::vector<NamedMesh> every_mesh()
{
    std::vector<NamedMesh> meshes;
    for (auto& [name, mesh] : various_meshes())
        meshes.push_back({name, std::move(mesh)});
    for (NamedMesh& model : outline_models())
        meshes.push_back(std::move(model));
    meshes.push_back({"cube", cube()}); // symmetrical
    return meshes;
}

/// Some of the views, others for each mesh; or every one of them.
std::vector<Camera> some_views(const Bounds& bounds, std::size_t mesh, bool every = false)
{
    std::vector<Camera> cameras = symmetric_views(bounds);
    for (int i = 0; i < 10; ++i)
        cameras.push_back(any_view(bounds, i));
    if (every)
        return cameras;
    std::vector<Camera> some;
    for (std::size_t i = mesh % 6; i < cameras.size(); i += 6)
        some.push_back(cameras[i]);
    return some;
}

bool is_finite(const dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Half-edges by start and end, and how often each is there.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> half_edges_of(const Mesh& mesh)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> seen;
    for (const uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            ++seen[{t[k], t[(k + 1) % 3]}];
    return seen;
}

/// Every edge has a face on both sides, but for those along borders of the control mesh, told by the parameters of their corners.
void expect_manifold(const std::string& what, const LoopTopology& control, const SilhouetteMesh& s)
{
    const auto seen = half_edges_of(s.mesh);
    std::set<std::pair<std::uint32_t, std::uint32_t>> border;
    for (std::size_t t = 0; t < s.mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const dvec2 a = s.parameters[3 * t + std::size_t(k)], b = s.parameters[3 * t + std::size_t((k + 1) % 3)];
            for (std::uint32_t side = 0; side < 3; ++side) {
                const auto off = [&](const dvec2& at) { return side == 0 ? at.y : side == 1 ? 1 - at.x - at.y : at.x; };
                if (control.twin[3 * s.faces[t] + side] == none && std::abs(off(a)) < 1e-14 && std::abs(off(b)) < 1e-14)
                    border.insert({s.mesh.triangles[t][k], s.mesh.triangles[t][(k + 1) % 3]});
            }
        }
    for (const auto& [edge, count] : seen) {
        ASSERT_EQ(count, 1) << what << ": " << edge.first << " " << edge.second;
        ASSERT_NE(seen.contains({edge.second, edge.first}), border.contains(edge)) << what << ": " << edge.first << " " << edge.second;
    }
}

void expect_finite(const std::string& what, const SilhouetteMesh& s)
{
    for (const dvec3& p : s.mesh.positions) {
        ASSERT_TRUE(is_finite(p)) << what;
    }
    ASSERT_EQ(s.mesh.corner_normals.size(), 3 * s.mesh.triangles.size()) << what;
    for (const vec3& n : s.mesh.corner_normals) {
        ASSERT_NEAR(glm::length(n), 1, 1e-5) << what;
    }
    for (const dvec2& at : s.parameters) {
        ASSERT_TRUE(at.x >= 0 && at.y >= 0 && at.x + at.y <= 1 + 1e-12) << what;
    }
    for (const uvec3& t : s.mesh.triangles) {
        ASSERT_LT(std::max({t.x, t.y, t.z}), s.mesh.positions.size()) << what;
    }
}

/// Closed where the control mesh is, open at its borders only, every edge used once in each direction; and each control face is covered once.
void check_meshes(bool every)
{
    std::size_t number = 0;
    for (const auto& [name, mesh] : every_mesh()) {
        const ExactSubject subject(mesh);
        int view = 0;
        for (const Camera& camera : some_views(subject.bounds(), number++, every)) {
            const std::string what = fmt::format("{}, view {}", name, view++);
            ExactSilhouetteReport report;
            const SilhouetteMesh s = exact_silhouette(subject.pose(), camera, {}, &report);
            expect_finite(what, s);
            expect_manifold(what, subject.topology(), s);
            std::vector<double> covered(mesh.triangles.size(), 0);
            for (std::size_t t = 0; t < s.faces.size(); ++t) {
                const dvec2 a = s.parameters[3 * t], b = s.parameters[3 * t + 1] - a, c = s.parameters[3 * t + 2] - a;
                covered[s.faces[t]] += b.x * c.y - b.y * c.x;
            }
            for (const double area : covered) {
                ASSERT_NEAR(area, 1, 1e-9) << what;
            }
            EXPECT_LE(report.turned_over, 0.25) << what; // half of the error that is allowed
        }
    }
}

TEST(ExactSilhouette, IsAManifoldMesh) { check_meshes(false); }
TEST(ExactSilhouette, IsAManifoldMeshSlow) { check_meshes(true); }

/// How far a place of a face is from its nearest corner, in parameters.
double from_corner(const dvec2& at) { return 1 - std::max({1 - at.x - at.y, at.x, at.y}); }

bool has_semi_sharp_edge(const LoopTopology& t, std::uint32_t face)
{
    for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h)
        if (t.sharpness[t.edge[h]] > 0 && t.sharpness[t.edge[h]] < infinitely_sharp)
            return true;
    return false;
}

/// All vertices lie on the limit surface, and those of curves on its contour: not nearer to corners of control faces than arcs are followed,
/// and beside semi-sharp edges, where they may run straight. There the outline in the picture tells how good they are (outline_test.cpp).
TEST(ExactSilhouette, LiesOnTheSurfaceAndItsContour)
{
    constexpr double followed = 1.0 / 64;
    double off_contour = 0;
    std::size_t points = 0;
    std::size_t number = 0;
    for (const auto& [name, mesh] : every_mesh()) {
        const ExactSubject subject(mesh);
        int view = 0;
        for (const Camera& camera : some_views(subject.bounds(), number++)) {
            const std::string what = fmt::format("{}, view {}", name, view++);
            const SilhouetteMesh s = exact_silhouette(subject.pose(), camera);
            std::set<std::uint32_t> on_curves;
            for (const auto& curve : s.curves)
                on_curves.insert(curve.begin(), curve.end());
            std::map<std::uint32_t, double> off; // the nearest of its faces: at a crease only one of them has the contour
            for (std::size_t t = 0; t < s.faces.size(); ++t)
                for (int k = 0; k < 3; ++k) {
                    const std::uint32_t v = s.mesh.triangles[t][k];
                    const dvec2 at = s.parameters[3 * t + std::size_t(k)];
                    const SurfaceSample sample = subject.pose().shape.sample({s.faces[t], at.x, at.y});
                    ASSERT_LT(glm::distance(sample.position, s.mesh.positions[v]), 1e-12) << what;
                    ASSERT_LT(glm::distance(sample.normal, dvec3(s.mesh.corner_normals[3 * t + std::size_t(k)])), 1e-6) << what;
                    if (on_curves.contains(v) && from_corner(at) > followed && !has_semi_sharp_edge(subject.topology(), s.faces[t])) {
                        const double height = std::abs(glm::dot(glm::normalize(camera.to_eye(sample.position)), sample.normal));
                        const auto [place, is_new] = off.insert({v, height});
                        place->second = std::min(place->second, height);
                    }
                }
            points += off.size();
            for (const auto& [v, height] : off) {
                EXPECT_LT(height, 1e-6) << what << ", vertex " << v;
                off_contour = std::max(off_contour, height);
            }
        }
    }
    EXPECT_GT(points, 5000u);
    RecordProperty("off_contour", fmt::format("{:.2e}", off_contour));
}

/// Checklist 24.
TEST(ExactSilhouette, IsTheMeshOnTheLimitWhereNothingIsCrossed)
{
    const Mesh mesh = octahedron();
    const ExactSubject subject(mesh);
    Camera inside;
    inside.eye = {0.01, 0.02, 0.03};
    ExactSilhouetteReport report;
    const SilhouetteMesh s = exact_silhouette(subject.pose(), inside, {}, &report);
    const LimitSurface limit = limit_surface(subject.topology(), mesh.positions);
    EXPECT_EQ(s.mesh.positions, limit.positions);
    EXPECT_EQ(s.mesh.triangles, mesh.triangles);
    EXPECT_TRUE(s.curves.empty());
    EXPECT_EQ(report.crossed_edges + report.cut_faces + report.curves, 0u);
    for (std::size_t i = 0; i < limit.normals.size(); ++i) {
        EXPECT_EQ(s.mesh.corner_normals[i], vec3(limit.normals[i]));
    }
}

bool same_bits(const SilhouetteMesh& a, const SilhouetteMesh& b)
{
    return a.mesh.positions == b.mesh.positions && a.mesh.triangles == b.mesh.triangles && a.mesh.corner_normals == b.mesh.corner_normals
           && a.faces == b.faces && a.parameters == b.parameters && a.curves == b.curves;
}

/// Checklist 41.
TEST(ExactSilhouette, IsTheSameForAnyNumberOfThreads)
{
    const Mesh mesh = shaken(torus(60, 50), 0.01);
    const auto make = [&] {
        const ExactSubject subject(mesh);
        return exact_silhouette(subject.pose(), any_view(subject.bounds(), 2));
    };
    const SilhouetteMesh one = with_threads(1, make);
    EXPECT_GT(one.curves.size(), 200u);
    for (const int threads : {2, 3}) {
        EXPECT_TRUE(same_bits(with_threads(threads, make), one)) << threads;
    }
}

/// Checklist 34.
TEST(ExactSilhouette, OfAMovedMeshIsThatOfAFreshOne)
{
    for (const char* name : {"creature", "leaf"}) {
        const Mesh mesh = make_control_sample(name);
        ExactSubject kept(mesh);
        for (std::uint64_t frame = 0; frame < 4; ++frame) {
            const Mesh moved = shaken(mesh, 0.03, frame);
            const ControlMesh control = make_control_mesh(moved);
            kept.move_to(control.positions);
            const ExactSubject fresh(control);
            const Camera camera = any_view(fresh.bounds(), int(frame));
            EXPECT_TRUE(same_bits(exact_silhouette(kept.pose(), camera), exact_silhouette(fresh.pose(), camera))) << name << " " << frame;
        }
    }
}

/// Crossings of all edges, on the side of each half-edge with one of its own, with or without ruling edges out first.
std::size_t count_crossings(const SilhouetteView& view, const EdgePoints* found)
{
    const LoopTopology& t = view.topology();
    std::size_t count = 0;
    CrossingSearch search(view.pose.shape, view.eye);
    for (std::uint32_t e = 0; e < t.edge_count(); ++e)
        for (std::size_t side = 0; side < 2; ++side) {
            const std::uint32_t h = side == 0 ? t.half_edge[e] : t.twin[t.half_edge[e]];
            if (h == none || (side == 1 && t.sharpness[e] < infinitely_sharp))
                continue;
            if (found)
                for (const CutPoint& p : (*found)[e])
                    count += p.crossing[side];
            else
                count += search.along(h, {view.faces_eye(h), view.faces_eye(next_half_edge(h))}).size();
        }
    return count;
}

/// Checklist 39: edges are ruled out by a few normals, and none of those has a crossing; nor has a face that is ruled out a closed contour.
TEST(ExactSilhouette, MissesNoCrossings)
{
    std::size_t all = 0, even = 0, ruled_out = 0;
    for (const auto& [name, mesh] : outline_models()) {
        const ExactSubject subject(mesh);
        for (int number = 0; number < 6; ++number) {
            const Camera camera = any_view(subject.bounds(), number);
            const SilhouetteView view{subject.pose(), PicturePlane(camera), searched_eye(camera, dvec3(0)), 0.25, 0, 0};
            const EdgePoints edges = cut_edges(view);
            const std::size_t exact = count_crossings(view, nullptr);
            EXPECT_EQ(count_crossings(view, &edges), exact) << name << ", view " << number;
            all += exact;
            ExactSilhouetteReport report;
            exact_silhouette(subject.pose(), camera, {}, &report);
            even += report.even_edges;
            for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
                if (may_hold_contour(view, f, edges))
                    continue;
                const auto arcs = trace_contour(contour_cell(subject.pose().shape, view.eye, f), {}, [](const dvec2&, const dvec2&, const dvec2&, int) { return false; });
                EXPECT_TRUE(arcs.empty()) << name << ", view " << number << ", face " << f;
                ++ruled_out;
            }
        }
    }
    EXPECT_GT(all, 3000u);
    EXPECT_GT(even, 50u);
    EXPECT_GT(ruled_out, 3000u);
}

/// Checklist 40.
TEST(ExactSilhouette, HasNoNumbersThatAreNone)
{
    std::vector<NamedMesh> meshes;
    for (const std::uint32_t n : {2u, 3u, 4u, 5u, 7u, 11u, 20u, 40u})
        meshes.push_back({fmt::format("pyramid {}", n), shaken(double_pyramid(n), 0.05)});
    for (const std::uint32_t n : {1u, 3u, 40u})
        meshes.push_back({fmt::format("fan {}", n), open_fan(n)});
    Mesh point = octahedron(), line = octahedron(), flat = octahedron(), folded = cube();
    for (dvec3& p : point.positions)
        p = {1, 2, 3};
    for (dvec3& p : line.positions)
        p = {p.x, 0, 0};
    for (dvec3& p : flat.positions)
        p.z = 0;
    folded.positions[7] = folded.positions[0]; // faces without area
    meshes.insert(meshes.end(), {{"point", point}, {"line", line}, {"flat", flat}, {"folded", folded}});
    for (const auto& [name, mesh] : meshes) {
        const ExactSubject subject(mesh);
        std::vector<dvec3> eyes = {{3, 2, 4}, {0.01, 0.02, 0.03}, {0, 0, 0}};
        const std::size_t off_surface = eyes.size();
        for (std::size_t i = 0; i < subject.pose().corners.positions.size() && i < 3; ++i)
            eyes.push_back(subject.pose().corners.positions[i]); // on the surface
        eyes.push_back(subject.pose().middles[0]);
        eyes.push_back(subject.pose().shape.position({0, 0.3, 0.2}));
        for (std::size_t i = 0; i < eyes.size(); ++i)
            for (const bool away : {false, true})
                for (const bool orthographic : {false, true}) {
                    const dvec3& eye = eyes[i];
                    Camera camera;
                    camera.eye = eye;
                    camera.look = away ? 2.0 * eye + dvec3(0.1, 0.2, 1) : dvec3(0.05, -0.1, 0.2);
                    camera.orthographic = orthographic;
                    camera.size = {256, 256};
                    const std::string what = fmt::format("{} from {} {} {}{}{}", name, eye.x, eye.y, eye.z, away ? ", looking away" : "", orthographic ? ", parallel" : "");
                    const SilhouetteMesh s = exact_silhouette(subject.pose(), camera);
                    expect_finite(what, s);
                    if (i < off_surface && name != "pyramid 2") { // where two edges have the same ends
                        expect_manifold(what, subject.topology(), s);
                    }
                }
    }
}

/// More points on arcs when asked for, and a finer outline when asked for.
TEST(ExactSilhouette, HasAsManyPointsAsAskedFor)
{
    const ExactSubject subject(octahedron());
    const Camera camera = any_view(subject.bounds(), 0);
    const auto points = [&](double error, int curve_points) {
        ExactSilhouetteOptions options;
        options.outline_error = error;
        options.curve_points = curve_points;
        std::size_t count = 0;
        for (const auto& curve : exact_silhouette(subject.pose(), camera, options).curves)
            count += curve.size() - 1;
        return count;
    };
    const double coarse = double(points(8, 0)), fine = double(points(0.5, 0)), finer = double(points(0.125, 0));
    EXPECT_GT(fine / coarse, 2.5); // 4, but for arcs that have one piece at least
    EXPECT_NEAR(finer / fine, 2, 0.7); // the error falls with the square
    EXPECT_GE(points(8, 16), 2 * points(8, 4));
}

} // namespace
} // namespace limn::test
