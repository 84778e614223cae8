#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/subdivision/loop_masks.h"
#include "subdivision/control_meshes.h"

namespace limn::test {
namespace {

/// Checklist 2: twins, edge numbers and leaving half-edges agree with each other.
void expect_consistent(const LoopTopology& t, const std::string& name)
{
    ASSERT_EQ(t.twin.size(), 3 * t.triangles.size()) << name;
    for (std::uint32_t h = 0; h < t.twin.size(); ++h) {
        if (t.twin[h] != none) {
            ASSERT_EQ(t.twin[t.twin[h]], h) << name;
            ASSERT_EQ(t.edge[t.twin[h]], t.edge[h]) << name;
            ASSERT_EQ(t.start(t.twin[h]), t.end(h)) << name;
        }
        const std::uint32_t of_edge = t.half_edge[t.edge[h]];
        ASSERT_TRUE(of_edge == h || (of_edge == t.twin[h] && of_edge != none)) << name;
    }
    std::size_t spokes = 0;
    for (std::uint32_t v = 0; v < t.vertex_count(); ++v) {
        const Spokes around = t.gather(v);
        spokes += around.half_edges.size();
        ASSERT_EQ(t.is_at_sharp_edge(v), vertex_kind(around.sharpness) != VertexKind::smooth) << name;
        for (const std::uint32_t h : around.half_edges) {
            ASSERT_EQ(t.start(h), v) << name;
        }
        ASSERT_EQ(around.half_edges.size() + (around.closed ? 0 : 1), around.size()) << name;
    }
    ASSERT_EQ(spokes, t.twin.size()) << name; // every corner is seen once: the fans are whole
}

/// Checklist 3 and 4.
TEST(LoopTopology, OfAnOctahedronGrowsAsEulerTells)
{
    LoopTopology t = make_control_mesh(octahedron()).topology;
    for (const std::size_t vertices : {6, 18, 66, 258}) {
        EXPECT_EQ(t.vertex_count(), vertices);
        EXPECT_EQ(t.vertex_count() + t.triangles.size(), t.edge_count() + 2);
        t = refine(t);
    }
    EXPECT_EQ(t.triangles.size(), 8u * 256);
}

TEST(LoopTopology, OfARefinedMeshIsTheAdjacencyOfItsTriangles)
{
    for (const auto& [name, mesh] : various_meshes()) {
        LoopTopology t = make_control_mesh(mesh).topology;
        for (int level = 0; level < 3; ++level) {
            expect_consistent(t, name);
            EXPECT_EQ(t.twin, build_adjacency(t.triangles, t.vertex_count()).twin) << name << " level " << level;
            t = refine(t);
        }
    }
}

TEST(LoopTopology, KeepsVerticesAndGivesEdgesTheirPoints)
{
    const LoopTopology t = make_control_mesh(torus(4, 5)).topology, next = refine(t);
    for (std::uint32_t v = 0; v < t.vertex_count(); ++v) {
        const Spokes before = t.gather(v), after = next.gather(v);
        ASSERT_EQ(before.size(), after.size());
        for (std::size_t i = 0; i < before.size(); ++i) {
            EXPECT_EQ(after.neighbours[i], t.vertex_count() + before.edges[i]);
        }
    }
    for (std::uint32_t e = 0; e < t.edge_count(); ++e) {
        EXPECT_EQ(next.gather(std::uint32_t(t.vertex_count()) + e).size(), 6u);
        EXPECT_EQ(next.start(next.half_edge[2 * e]), t.start(t.half_edge[e]));
        EXPECT_EQ(next.end(next.half_edge[2 * e + 1]), t.end(t.half_edge[e]));
    }
}

TEST(LoopTopology, ChildrenOfSharpEdgesAreSharpByOneLess)
{
    Mesh mesh = octahedron();
    mesh.creases = {{0, 2, 2.5f}, {0, 3, 10}, {0, 4, 0.5f}};
    const LoopTopology t = make_control_mesh(mesh).topology, next = refine(t);
    const auto children = [&](std::uint32_t a, std::uint32_t b) {
        const std::uint32_t e = edge_between(t, a, b);
        return std::pair(next.sharpness[2 * e], next.sharpness[2 * e + 1]);
    };
    EXPECT_EQ(children(0, 2), std::pair(1.5f, 1.5f));
    EXPECT_EQ(children(0, 3), std::pair(10.0f, 10.0f));
    EXPECT_EQ(children(0, 4), std::pair(0.0f, 0.0f));
    EXPECT_EQ(std::count_if(next.sharpness.begin(), next.sharpness.end(), [](float s) { return s > 0; }), 4);
}

TEST(ControlMesh, CutsNonManifoldEdgesOpen)
{
    Mesh mesh; // three triangles at one edge
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
    const ControlMesh control = make_control_mesh(mesh);
    expect_consistent(control.topology, "book");
    EXPECT_EQ(control.notes.non_manifold_edges, 1u);
    EXPECT_EQ(control.notes.split_vertices, 4u); // each triangle has its own two at the edge
    EXPECT_EQ(control.positions.size(), 9u);
    EXPECT_EQ(notes_of(control.notes), (std::vector<std::string>{"1 non-manifold edge, cut open", "4 vertices added where fans of faces met"}));
    EXPECT_EQ(refined(mesh, 3).topology.triangles.size(), 3u * 64);
}

TEST(ControlMesh, CutsEdgesOpenWhoseFacesRunTheSameWay)
{
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
    const ControlMesh control = make_control_mesh(mesh);
    expect_consistent(control.topology, "turned");
    EXPECT_EQ(control.notes.non_manifold_edges, 1u);
    EXPECT_EQ(control.notes.split_vertices, 2u);
}

TEST(ControlMesh, GivesEachFanOfABowTieAVertex)
{
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
    const ControlMesh control = make_control_mesh(mesh);
    expect_consistent(control.topology, "bow tie");
    EXPECT_EQ(control.notes.split_vertices, 1u);
    EXPECT_EQ(control.source, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 0}));
    EXPECT_EQ(control.positions[5], mesh.positions[0]);
}

TEST(ControlMesh, KeepsVerticesWithoutFacesWhereTheyAre)
{
    Mesh mesh = octahedron();
    mesh.positions.push_back({7, 8, 9});
    const ControlMesh control = make_control_mesh(mesh);
    EXPECT_EQ(notes_of(control.notes), (std::vector<std::string>{"1 vertex without faces"}));
    const Refined fine = refined(mesh, 2);
    EXPECT_EQ(fine.positions[6], dvec3(7, 8, 9));
    EXPECT_EQ(limit_surface(fine.topology, fine.positions).positions[6], dvec3(7, 8, 9));
}

TEST(ControlMesh, TakesTheSharperOfContradictingTagsAndCountsThoseWithoutAnEdge)
{
    Mesh mesh = octahedron();
    mesh.creases = {{0, 2, 1}, {2, 0, 3}, {0, 1, 5}, {0, 4, 7}, {4, 0, 7}};
    const ControlMesh control = make_control_mesh(mesh);
    EXPECT_EQ(control.notes.contradicting_tags, 1u);
    EXPECT_EQ(control.notes.ignored_tags, 1u);
    EXPECT_EQ(control.topology.sharpness[edge_between(control.topology, 0, 2)], 3);
    EXPECT_EQ(notes_of(control.notes),
              (std::vector<std::string>{"1 crease tag without an edge", "1 edge with contradicting crease tags, the sharper one holds"}));
}

TEST(ControlMesh, MakesEdgesSharpByTheAngleOfTheirFaces)
{
    const auto sharp = [](double angle) {
        const LoopTopology t = make_control_mesh(cube(), {.crease_angle = angle}).topology;
        return std::count(t.sharpness.begin(), t.sharpness.end(), infinitely_sharp);
    };
    EXPECT_EQ(sharp(0), 0);
    EXPECT_EQ(sharp(89), 12);
    EXPECT_EQ(sharp(91), 0);
}

TEST(ControlMesh, LeavesTagsOutWhereAsked)
{
    Mesh mesh = octahedron();
    mesh.creases = {{0, 2, 10}};
    const LoopTopology t = make_control_mesh(mesh, {.tags = false}).topology;
    EXPECT_EQ(std::count(t.sharpness.begin(), t.sharpness.end(), 0.0f), 12);
}

TEST(ControlMesh, RefusesWhatCannotBeSubdivided)
{
    Mesh twice = octahedron();
    twice.triangles.push_back({0, 0, 1});
    EXPECT_THROW(make_control_mesh(twice), Error::Input);
    EXPECT_THROW(make_control_mesh({}), Error::Input);
}

} // namespace
} // namespace limn::test
