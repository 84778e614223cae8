// Meshes with sharp edges as smooth pieces that meet in creases: split.h, prepare.h, and the contours of such models.

#include "limn/lines/split.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "limn/lines/chain.h"
#include "limn/lines/contour.h"
#include "limn/lines/prepare.h"
#include "lines/cameras.h"
#include "lines/edge_shapes.h"

namespace limn {
namespace {

using namespace test;

LineModel model_of(const PreparedMesh& prepared)
{
    const PlacedSurface placed = prepared.placed();
    return build_line_model({&placed, 1});
}

TEST(Split, GivesEverySideOfACubeItsOwnCorners)
{
    const PreparedMesh cut = prepare_mesh(cube());
    ASSERT_EQ(cut.mesh.positions.size(), 24u);
    ASSERT_EQ(cut.weld.size(), 24u);
    std::vector<int> copies(8, 0);
    for (std::size_t v = 0; v < 24; ++v) {
        ASSERT_LT(cut.weld[v], 8u);
        EXPECT_EQ(cut.mesh.positions[v], cut.mesh.positions[cut.weld[v]]);
        ++copies[cut.weld[v]];
    }
    EXPECT_EQ(copies, std::vector<int>(8, 3));
    // Each copy has the normal of its side exactly.
    for (const uvec3& t : cut.mesh.triangles) {
        const dvec3 n = glm::normalize(glm::cross(cut.mesh.positions[t.y] - cut.mesh.positions[t.x], cut.mesh.positions[t.z] - cut.mesh.positions[t.x]));
        for (int k = 0; k < 3; ++k)
            EXPECT_LT(glm::distance(dvec3(cut.surface.normals[t[k]]), n), 1e-6);
    }
}

TEST(Split, CutsACylinderAtItsRimsAndLeavesItsSideWhole)
{
    const PreparedMesh cut = prepare_mesh(cylinder(48));
    EXPECT_EQ(cut.mesh.positions.size(), 4 * 48 + 2u); // both rims twice, and the middles of the caps
    for (std::uint32_t v = 0; v < 4 * 48 + 2; ++v)
        EXPECT_EQ(cut.mesh.positions[v], cut.mesh.positions[cut.weld[v]]);
    const LineModel model = model_of(cut);
    EXPECT_EQ(model.split_edges.size(), 96u);
    EXPECT_EQ(*std::max_element(model.component.begin(), model.component.end()), 0u); // still one solid
}

TEST(Split, LeavesASmoothMeshAlone)
{
    const Mesh sphere = icosphere(3);
    const PreparedMesh prepared = prepare_mesh(sphere);
    EXPECT_TRUE(prepared.weld.empty());
    EXPECT_EQ(prepared.mesh.positions, sphere.positions);
    EXPECT_EQ(prepared.mesh.triangles, sphere.triangles);
}

TEST(Split, IsLeftOutWhenNotWanted)
{
    PrepareOptions options;
    options.split = false;
    EXPECT_EQ(prepare_mesh(cube(), options).mesh.positions.size(), 8u);
}

TEST(Split, ACreaseThatEndsInsideASurfaceKeepsItsEndWhole)
{
    // A flat sheet of 4 x 4 cells folded along half of its middle row is one piece: the fan around the crease's end stays joined.
    Mesh mesh = sheet(4, 4, [](double u, double v) { return dvec3(u, v, 0); });
    const Surface none_yet;
    const PlacedSurface placed = {&mesh, &none_yet};
    const LineModel bare = build_line_model({&placed, 1});
    std::vector<FeatureEdge> half;
    for (std::uint32_t h = 0; h < 3 * bare.faces.size(); ++h) {
        const std::uint32_t a = bare.faces[h / 3][int(h % 3)], b = bare.faces[h / 3][int((h + 1) % 3)];
        if ((a == 10 && b == 11) || (a == 11 && b == 12))
            half.push_back({a, b, h / 3, bare.adjacency.twin[h] / 3, 1.0f, true});
    }
    ASSERT_EQ(half.size(), 2u);
    const SplitMesh split = split_at_creases(mesh, bare.adjacency, half);
    ASSERT_EQ(split.mesh.positions.size(), 27u); // vertices 10 (at the border) and 11; not 12
    EXPECT_EQ((std::set<std::uint32_t>{split.weld[25], split.weld[26]}), (std::set<std::uint32_t>{10, 11}));
}

/// Every chain of the contours of a closed model is closed, whatever the view.
void expect_closed_contours(const Mesh& mesh, bool crosses_faces)
{
    const PreparedMesh prepared = prepare_mesh(mesh);
    const LineModel model = model_of(prepared);
    std::size_t along = 0, within = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const View view = model.view(random_camera(mesh.bounds(), seed, seed % 2 == 1));
        const std::vector<Segment> segments = extract_contours(model, facing_of_vertices(model, view));
        const Chains chains = chain_segments(segments);
        ASSERT_GT(chains.size(), 0u) << "view " << seed;
        for (std::size_t c = 0; c < chains.size(); ++c)
            ASSERT_TRUE(chains.closed[c]) << "view " << seed << ", chain " << c << " of " << chains[c].size() << " segments";
        for (const Segment& s : segments)
            ++(s.along_edge ? along : within);
    }
    EXPECT_GT(along, 0u);
    EXPECT_EQ(within > 0, crosses_faces);
}

TEST(SplitContours, OfACubeAreClosedLoopsAlongItsEdges) { expect_closed_contours(cube(), false); }

TEST(SplitContours, OfACylinderAreClosedLoopsAcrossItsSideAndAlongItsRims) { expect_closed_contours(cylinder(48), true); }

} // namespace
} // namespace limn
