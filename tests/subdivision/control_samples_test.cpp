#include "limn/subdivision/control_samples.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/geometry/diagnose.h"
#include "limn/geometry/read_mesh.h"
#include "limn/geometry/write_mesh.h"
#include "limn/subdivision/loop_topology.h"
#include "limn/subdivision/subdivide.h"
#include "support/support.h"

namespace limn::test {
namespace {

struct Expected {
    const char* name;
    std::int64_t euler;
    std::size_t border_edges;
    std::size_t fewest, most; ///< edges at a vertex
};

const Expected expected[] = {{"creature", 2, 0, 4, 8}, {"rook", 2, 0, 4, 8}, {"mug", 0, 0, 5, 8}, {"bracket", -2, 0, 6, 8}, {"leaf", 1, 20, 2, 6}, {"bent-cylinder", 2, 0, 5, 8}};

std::map<std::size_t, std::size_t> valences(const Mesh& mesh)
{
    const ControlMesh control = make_control_mesh(mesh);
    std::map<std::size_t, std::size_t> count;
    for (std::uint32_t v = 0; v < control.topology.vertex_count(); ++v)
        ++count[control.topology.gather(v).size()];
    return count;
}

TEST(ControlSamples, AreCleanCoarseSurfacesOfTheStatedKind)
{
    for (const Expected& e : expected) {
        const Mesh mesh = make_control_sample(e.name);
        const Diagnosis found = diagnose(mesh);
        EXPECT_TRUE(found.manifold && found.oriented) << e.name;
        EXPECT_EQ(found.shells, 1u) << e.name;
        EXPECT_EQ(found.euler, e.euler) << e.name;
        EXPECT_EQ(found.border_edges, e.border_edges) << e.name;
        EXPECT_EQ(found.unreferenced_vertices + found.degenerate_faces + found.duplicate_faces, 0u) << e.name;
        EXPECT_GE(mesh.triangles.size(), 50u) << e.name;
        EXPECT_LE(mesh.triangles.size(), 800u) << e.name;
        if (e.border_edges == 0) {
            EXPECT_GT(found.volume.value_or(-1), 0) << e.name << " is inside out";
        }
    }
}

TEST(ControlSamples, HaveVerticesOfTheStatedValences)
{
    for (const Expected& e : expected) {
        const std::map<std::size_t, std::size_t> count = valences(make_control_sample(e.name));
        std::string all;
        for (const auto& [valence, vertices] : count)
            all += fmt::format("{} of {}; ", vertices, valence);
        EXPECT_EQ(count.begin()->first, e.fewest) << e.name << ": " << all;
        EXPECT_EQ(count.rbegin()->first, e.most) << e.name << ": " << all;
        EXPECT_GE(count.size(), 3u) << e.name << ": " << all;
    }
    for (const auto& [valence, vertices] : valences(make_control_sample("creature")))
        EXPECT_GE(vertices, 4u) << valence;
}

TEST(ControlSamples, CreasesAreEdgesAndSurviveAFile)
{
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "sample.obj";
    for (const Expected& e : expected) {
        const Mesh mesh = make_control_sample(e.name);
        const ControlNotes notes = make_control_mesh(mesh).notes;
        EXPECT_EQ(notes.ignored_tags + notes.contradicting_tags + notes.split_vertices + notes.isolated_vertices, 0u) << e.name;
        EXPECT_EQ(mesh.creases.empty(), std::string(e.name) == "bent-cylinder");
        write_mesh(mesh, file, {.double_positions = true});
        const Mesh read = read_mesh(file, {.keep_polygons = true});
        EXPECT_EQ(read.triangles, mesh.triangles) << e.name;
        EXPECT_EQ(read.positions, mesh.positions) << e.name;
        ASSERT_EQ(read.creases.size(), mesh.creases.size()) << e.name;
        for (std::size_t i = 0; i < read.creases.size(); ++i) {
            EXPECT_EQ(read.creases[i].a, mesh.creases[i].a);
            EXPECT_EQ(read.creases[i].b, mesh.creases[i].b);
            EXPECT_EQ(read.creases[i].sharpness, mesh.creases[i].sharpness);
        }
    }
}

TEST(ControlSamples, HaveSharpAndSemiSharpCreasesAndADart)
{
    std::size_t sharp = 0, semi_sharp = 0;
    for (const std::string& name : control_sample_names())
        for (const CreaseEdge& crease : make_control_sample(name).creases)
            ++(crease.sharpness >= infinitely_sharp ? sharp : semi_sharp);
    EXPECT_GT(sharp, 20u);
    EXPECT_GT(semi_sharp, 20u);
    const LoopTopology leaf = make_control_mesh(make_control_sample("leaf")).topology;
    std::size_t darts = 0, corners = 0;
    for (std::uint32_t v = 0; v < leaf.vertex_count(); ++v) {
        const Spokes spokes = leaf.gather(v);
        const std::ptrdiff_t at = std::count_if(spokes.sharpness.begin(), spokes.sharpness.end(), [](float s) { return s > 0; });
        darts += at == 1;
        corners += at > 2;
    }
    EXPECT_EQ(darts, 1u);
    EXPECT_EQ(corners, 1u);
}

TEST(ControlSamples, HalvesOfTheCreatureAreMirrorImages)
{
    const Subdivided made = subdivide(make_control_sample("creature"), {.levels = 2, .limit = true});
    std::vector<dvec3> points = made.mesh.positions, mirrored = points;
    for (dvec3& p : mirrored)
        p.z = -p.z;
    double worst = 0;
    for (const dvec3& p : mirrored) {
        double nearest = 1;
        for (const dvec3& q : points)
            nearest = std::min(nearest, glm::distance(p, q));
        worst = std::max(worst, nearest);
    }
    EXPECT_LT(worst, 1e-12);
}

TEST(ControlSamples, UnknownNameIsAnError) { EXPECT_THROW(make_control_sample("teapot"), Error::Input); }

} // namespace
} // namespace limn::test
