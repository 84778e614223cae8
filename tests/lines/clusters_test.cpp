#include "limn/lines/cluster_extract.h"

#include <algorithm>
#include <cstring>
#include <random>

#include <gtest/gtest.h>

#include "analytic.h"
#include "limn/base/parallel.h"
#include "limn/lines/contour.h"
#include "limn/lines/draw.h"
#include "limn/lines/suggestive.h"
#include "limn/surface/shapes.h"
#include "support/instruction_sets.h"

namespace limn::test {
namespace {

constexpr unsigned seed = 2027;

LineModel model_of(const Mesh& mesh, const Surface& surface)
{
    const PlacedSurface placed = {&mesh, &surface};
    return build_line_model({&placed, 1});
}

LineModel shape_model(const std::string& name, std::size_t triangles, double jitter = 0.2)
{
    ShapeOptions options;
    options.name = name;
    options.triangles = triangles;
    options.jitter = jitter;
    const Shape shape = make_shape(options);
    return model_of(shape.mesh, shape.exact);
}

bool same_segment(const Segment& x, const Segment& y)
{
    return std::memcmp(&x.a, &y.a, sizeof x.a) == 0 && std::memcmp(&x.b, &y.b, sizeof x.b) == 0 && std::memcmp(&x.ink_a, &y.ink_a, sizeof x.ink_a) == 0 &&
           std::memcmp(&x.ink_b, &y.ink_b, sizeof x.ink_b) == 0 && x.face == y.face && x.edge_a == y.edge_a && x.edge_b == y.edge_b && x.other == y.other &&
           x.along_edge == y.along_edge;
}

bool same_segments(const std::vector<Segment>& x, const std::vector<Segment>& y) { return std::equal(x.begin(), x.end(), y.begin(), y.end(), same_segment); }

SuggestiveOptions with_limit(float limit, bool highlight = false)
{
    SuggestiveOptions options;
    options.limit = limit;
    options.highlight = highlight;
    return options;
}

/// What the passes over the whole model find.
ClusterLines flat_lines(const LineModel& model, const View& view, const ClusterRequest& request)
{
    ClusterLines lines;
    if (request.contours)
        lines.contours = extract_contours(model, facing_of_vertices(model, view));
    if (request.suggestive)
        lines.suggestive = extract_suggestive(model, view, *request.suggestive);
    if (request.highlights)
        lines.highlights = extract_suggestive(model, view, *request.highlights);
    return lines;
}

bool same_lines(const ClusterLines& x, const ClusterLines& y)
{
    return same_segments(x.contours, y.contours) && same_segments(x.suggestive, y.suggestive) && same_segments(x.highlights, y.highlights);
}

View random_view(const LineModel& model, std::mt19937& random, bool orthographic)
{
    const dvec3 direction = random_direction(random);
    if (orthographic)
        return orthographic_view(direction);
    const double distance = std::uniform_real_distribution(1.2, 5.0)(random);
    return {false, vec3(distance * direction) + model.positions[0] * 0.1f};
}

/// Compares every use of clusters with the flat passes.
void expect_same_lines(const LineModel& model, const LineClusters& clusters, const View& view, float limit, const std::string& what)
{
    const SuggestiveOptions contours = with_limit(limit), highlights = with_limit(limit, true);
    ClusterRequest request;
    request.suggestive = &contours;
    const ClusterLines expected = flat_lines(model, view, request);
    for (const ClusterUse use : {ClusterUse::all, ClusterUse::bounded}) {
        request.use = use;
        ASSERT_TRUE(same_lines(extract_from_clusters(model, clusters, view, request), expected)) << what << ", use " << int(use);
    }
    request.highlights = &highlights;
    const ClusterLines more = flat_lines(model, view, request);
    ASSERT_TRUE(same_lines(extract_from_clusters(model, clusters, view, request), more)) << what << ", with highlights";
}

/// Section 7: set equality over models, views and limits.
void compare_over_views(std::size_t triangles, int views)
{
    std::mt19937 random(seed);
    for (const std::string name : {"torus", "blob", "bumpy-torus", "sine-sheet", "knot"}) {
        const LineModel model = shape_model(name, triangles);
        const LineClusters clusters = build_clusters(model);
        for (int i = 0; i < views; ++i)
            for (const float limit : {0.0f, 0.01f, 1.0f})
                for (const bool orthographic : {false, true})
                    expect_same_lines(model, clusters, random_view(model, random, orthographic), limit,
                                      name + ", seed 2027, view " + std::to_string(i) + ", limit " + std::to_string(limit));
    }
}

TEST(Clusters, HoldEveryFaceOnceAndTheVerticesOfItsCorners)
{
    const LineModel model = shape_model("blob", 5000);
    const LineClusters clusters = build_clusters(model);
    std::vector<int> seen(model.faces.size(), 0);
    for (const Cluster& c : clusters.clusters)
        for (std::uint32_t i = c.first_face; i < c.first_face + c.faces; ++i) {
            ++seen[clusters.face[i]];
            for (int k = 0; k < 3; ++k) {
                const std::size_t place = clusters.corners_of(c)[std::size_t(k) * cluster_faces + i - c.first_face];
                const float* row = clusters.rows_of(c).facing + place / cluster_lanes * facing_rows * cluster_lanes + place % cluster_lanes;
                EXPECT_EQ(vec3(row[0], row[cluster_lanes], row[2 * cluster_lanes]), model.positions[model.faces[clusters.face[i]][k]]);
            }
        }
    EXPECT_EQ(seen, std::vector<int>(model.faces.size(), 1));
}

TEST(Clusters, GiveTheLinesOfTheFlatPassesBitForBit) { compare_over_views(12000, 12); }

TEST(Clusters, GiveTheLinesOfTheFlatPassesBitForBitOverManyViewsSlow) { compare_over_views(100000, 100); }

TEST(Clusters, GiveTheSameLinesForAnyNumberOfThreads)
{
    const LineModel model = shape_model("blob", 30000);
    const View view = {false, vec3(0.5f, 1.5f, 2.0f)};
    const SuggestiveOptions options = with_limit(0.01f);
    ClusterRequest request;
    request.suggestive = &options;
    const auto lines = [&] { return extract_from_clusters(model, build_clusters(model), view, request); };
    const ClusterLines one = with_threads(1, lines);
    EXPECT_GT(one.contours.size(), 100u);
    EXPECT_GT(one.suggestive.size(), 100u);
    EXPECT_TRUE(same_lines(one, with_threads(2, lines)));
}

TEST(Clusters, GiveTheSameLinesOnEveryInstructionSet)
{
    std::mt19937 random(seed);
    const LineModel model = shape_model("blob", 12000);
    const LineClusters clusters = build_clusters(model);
    with_each_instruction_set([&](const char* name) {
        for (const float limit : {0.0f, 0.01f, 1.0f})
            for (int i = 0; i < 6; ++i)
                expect_same_lines(model, clusters, random_view(model, random, i % 2), limit, name);
    });
}

TEST(Clusters, MakeNoDifferenceToADrawing)
{
    const LineModel model = shape_model("blob", 20000);
    const RayScene rays = build_ray_scene(model);
    LineOptions options;
    options.lines.push_back(LineType::highlight);
    const LineFeatures flat = find_line_features(model, options), clustered = find_line_features(model, options, views_worth_clusters);
    ASSERT_FALSE(flat.clusters);
    ASSERT_TRUE(clustered.clusters);
    ClusterHistory history;
    Bounds box;
    for (const vec3& p : {vec3(-1), vec3(1)})
        box.add(model.to_world(p));
    for (const char* view : {"front", "iso", "20,-50"}) {
        Framing framing;
        framing.view = view;
        const Camera camera = Camera::framing(box, framing);
        const Drawing x = draw_lines(model, rays, flat, camera, options), y = draw_lines(model, rays, clustered, camera, options, nullptr, &history);
        ASSERT_EQ(x.strokes.size(), y.strokes.size());
        ASSERT_GT(x.strokes.size(), 20u);
        for (std::size_t i = 0; i < x.strokes.size(); ++i) {
            EXPECT_EQ(x.strokes[i].type, y.strokes[i].type);
            EXPECT_EQ(x.strokes[i].points, y.strokes[i].points);
            EXPECT_EQ(x.strokes[i].ink, y.strokes[i].ink);
        }
    }
}

TEST(Clusters, AgreeWhereTheEyeIsInsideOrNearOrNVIsZeroAtVertices)
{
    for (const std::string name : {"torus", "blob"}) {
        const LineModel model = shape_model(name, 12000);
        const LineClusters clusters = build_clusters(model);
        for (const float limit : {0.0f, 0.01f}) {
            expect_same_lines(model, clusters, {false, vec3(0)}, limit, name + ", centre");
            for (std::size_t v = 0; v < model.vertex_count(); v += model.vertex_count() / 20) {
                const vec3 p = model.positions[v], n = model.normals[v];
                expect_same_lines(model, clusters, {false, p}, limit, name + ", at a vertex");
                expect_same_lines(model, clusters, {false, p + 1e-3f * n}, limit, name + ", just outside");
                expect_same_lines(model, clusters, {false, p - 1e-3f * n}, limit, name + ", just inside");
                expect_same_lines(model, clusters, {false, p + 0.5f * model.e1[v]}, limit, name + ", in a tangent plane");
                expect_same_lines(model, clusters, {true, model.e1[v]}, limit, name + ", along a tangent");
            }
        }
    }
    // An axis view of an undisturbed torus: n.v = 0 at whole rings of vertices.
    const LineModel even = shape_model("torus", 12000, 0);
    const LineClusters clusters = build_clusters(even);
    for (const vec3& axis : {vec3(0, 0, 1), vec3(1, 0, 0), vec3(0, -1, 0)}) {
        expect_same_lines(even, clusters, {true, axis}, 0.01f, "axis");
        expect_same_lines(even, clusters, {false, 3.0f * axis}, 0.01f, "axis");
    }
}

TEST(Clusters, AgreeOnSliversFacesWithoutAreaAndWildNumbers)
{
    std::mt19937 random(seed);
    ShapeOptions options;
    options.name = "blob";
    options.triangles = 8000;
    Shape shape = make_shape(options);
    for (dvec3& p : shape.mesh.positions)
        p.z = p.z * 1e-4 + 0.3 * p.x; // slivers all over
    const std::size_t faces = shape.mesh.triangles.size();
    for (std::size_t f = 0; f < faces; f += 50) {
        const uvec3 t = shape.mesh.triangles[f];
        shape.mesh.triangles.push_back({t.x, t.y, t.y});
        shape.mesh.triangles.push_back({t.x, t.x, t.x});
    }
    shape.exact.k1[17] = 1e30f;
    shape.exact.normals[99] = vec3(0);
    shape.exact.e1[1000] = vec3(3, 0, 0);
    shape.exact.derivative[2000] = vec4(std::numeric_limits<float>::infinity());
    shape.exact.normals[3000] = vec3(std::numeric_limits<float>::quiet_NaN());
    const LineModel model = model_of(shape.mesh, shape.exact);
    const LineClusters clusters = build_clusters(model);
    for (int i = 0; i < 20; ++i)
        for (const bool orthographic : {false, true})
            expect_same_lines(model, clusters, random_view(model, random, orthographic), i % 2 ? 0.01f : 0.0f, "view " + std::to_string(i));
}

TEST(Clusters, AgreeWhereNoTwoFacesShareAVertex)
{
    std::mt19937 random(seed);
    ShapeOptions options;
    options.name = "blob";
    options.triangles = 4000;
    Shape shape = make_shape(options);
    Mesh soup;
    Surface surface;
    for (const uvec3& t : shape.mesh.triangles) {
        const auto first = std::uint32_t(soup.positions.size());
        soup.triangles.push_back({first, first + 1, first + 2});
        for (int k = 0; k < 3; ++k) {
            soup.positions.push_back(shape.mesh.positions[t[k]]);
            surface.normals.push_back(shape.exact.normals[t[k]]);
            surface.e1.push_back(shape.exact.e1[t[k]]);
            surface.e2.push_back(shape.exact.e2[t[k]]);
            surface.k1.push_back(shape.exact.k1[t[k]]);
            surface.k2.push_back(shape.exact.k2[t[k]]);
            surface.derivative.push_back(shape.exact.derivative[t[k]]);
        }
    }
    const LineModel model = model_of(soup, surface);
    const LineClusters clusters = build_clusters(model);
    ASSERT_EQ(clusters.clusters[0].blocks * cluster_lanes, cluster_most_vertices);
    with_each_instruction_set([&](const char* name) { expect_same_lines(model, clusters, random_view(model, random, false), 0.01f, name); });
}

TEST(Clusters, AgreeUnderALimitOfSpeed)
{
    std::mt19937 random(seed);
    const LineModel model = shape_model("blob", 12000);
    const LineClusters clusters = build_clusters(model);
    SuggestiveOptions options = with_limit(0.01f);
    ClusterRequest request;
    request.suggestive = &options;
    for (int i = 0; i < 6; ++i) {
        const View view = random_view(model, random, i % 2);
        options.speed_limit = 0;
        const ClusterLines all = flat_lines(model, view, request);
        options.speed_limit = 0.05f;
        const ClusterLines slow = flat_lines(model, view, request);
        EXPECT_FALSE(same_lines(slow, all)) << "seed 2027, view " << i;
        EXPECT_TRUE(same_lines(extract_from_clusters(model, clusters, view, request), slow)) << "seed 2027, view " << i;
    }
}

TEST(Clusters, AgreeOnMeshesOfAnySize)
{
    std::mt19937 random(seed);
    for (const double scale : {1e-3, 1e3}) {
        ShapeOptions options;
        options.name = "bumpy-torus";
        options.triangles = 8000;
        const Shape shape = make_shape(options);
        dmat4 scaling(scale);
        scaling[3][3] = 1;
        const PlacedSurface placed = {&shape.mesh, &shape.exact, scaling};
        const LineModel model = build_line_model({&placed, 1});
        const LineClusters clusters = build_clusters(model);
        for (int i = 0; i < 10; ++i)
            expect_same_lines(model, clusters, random_view(model, random, i % 2), 0.01f, "scale " + std::to_string(scale));
    }
}

TEST(Clusters, RejectMostOfASmoothTorus)
{
    const LineModel model = shape_model("torus", 100000, 0);
    const LineClusters clusters = build_clusters(model);
    const SuggestiveOptions options = with_limit(0.01f);
    ClusterRequest request;
    request.suggestive = &options;
    ClusterHistory history;
    extract_from_clusters(model, clusters, {false, vec3(1, 1.5f, 2)}, request, &history);
    EXPECT_GT(history.survivors, 0.01);
    EXPECT_LT(history.survivors, 0.35);
}

TEST(Clusters, FallBackToAllClustersWhereBoundsRejectLittle)
{
    const LineModel model = shape_model("blob", 3000); // coarse: bounds are wide
    const LineClusters clusters = build_clusters(model);
    const View view = {false, vec3(1, 1.5f, 2)};
    const SuggestiveOptions options = with_limit(0);
    ClusterRequest request;
    request.suggestive = &options;
    ClusterHistory history;
    const ClusterLines first = extract_from_clusters(model, clusters, view, request, &history);
    ASSERT_GT(history.survivors, 0.5);
    EXPECT_EQ(history.since_bounded, 0);
    EXPECT_TRUE(same_lines(extract_from_clusters(model, clusters, view, request, &history), first));
    EXPECT_EQ(history.since_bounded, 1);
}

// The guard of section 7: with half-widths that are too small every view loses lines, so the comparisons above can fail.
TEST(Clusters, LoseLinesWhereHalfWidthsAreTooSmall)
{
    std::mt19937 random(seed);
    const LineModel model = shape_model("blob", 100000, 0);
    const SuggestiveOptions options = with_limit(0);
    ClusterRequest request;
    request.suggestive = &options;
    request.use = ClusterUse::bounded;
    for (const double factor : {0.8, 0.5}) {
        const LineClusters clusters = build_clusters(model, {factor});
        int different = 0;
        for (int i = 0; i < 20; ++i) {
            const View view = random_view(model, random, false);
            different += !same_lines(extract_from_clusters(model, clusters, view, request), flat_lines(model, view, request));
        }
        EXPECT_EQ(different, 20) << factor;
    }
}

} // namespace
} // namespace limn::test
