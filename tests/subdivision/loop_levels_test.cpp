#include <gtest/gtest.h>

#include "limn/base/parallel.h"
#include "limn/subdivision/loop_levels.h"
#include "subdivision/control_meshes.h"

namespace limn::test {
namespace {

/// Meshes that have something of everything, one of them with a vertex without faces.
std::vector<std::pair<std::string, Mesh>> posed_meshes()
{
    std::vector<std::pair<std::string, Mesh>> meshes = various_meshes();
    meshes.emplace_back("valence 40", double_pyramid(40));
    meshes.emplace_back("vertex without faces", octahedron());
    meshes.back().second.positions.push_back({5, 6, 7});
    return meshes;
}

TEST(LoopLevels, ArePosedToTheBytesOfEachStep)
{
    for (const CreaseRule rule : every_rule)
        for (const auto& [name, mesh] : posed_meshes()) {
            const ControlMesh control = make_control_mesh(mesh);
            const LoopLevels levels(control.topology, 3, rule);
            LevelPositions posed;
            for (const double stretch : {1.0, 1.7}) { // the second pose finds the first's memory
                std::vector<dvec3> expected = control.positions;
                for (dvec3& p : expected)
                    p *= stretch;
                levels.pose(std::vector(expected), posed);
                ASSERT_EQ(posed.size(), 4u);
                for (int level = 0; level < 3; ++level) {
                    expected = refine_positions(levels.topology(level), expected, rule);
                    ASSERT_TRUE(posed[std::size_t(level + 1)] == expected) << name << ", level " << level + 1;
                }
            }
        }
}

TEST(LoopLevels, OfNoStepHoldTheControlMesh)
{
    const ControlMesh control = make_control_mesh(octahedron());
    const LoopLevels levels(control.topology, 0);
    EXPECT_EQ(levels.levels(), 0);
    EXPECT_EQ(levels.topology(0).triangles, control.topology.triangles);
    EXPECT_EQ(levels.pose(control.positions), LevelPositions{control.positions});
}

TEST(LoopLevels, GiveTheSameBytesForAnyNumberOfThreads)
{
    Mesh mesh = shaken(torus(60, 80), 0.01);
    for (std::uint32_t i = 0; i < 60; ++i)
        mesh.creases.push_back({i * 80, (i + 1) % 60 * 80, 10});
    const auto run = [&](int threads) {
        return with_threads(threads, [&] {
            const ControlMesh control = make_control_mesh(mesh);
            return LoopLevels(control.topology, 2, CreaseRule::biermann).pose(control.positions);
        });
    };
    EXPECT_TRUE(run(1) == run(4));
}

TEST(LoopLevels, OfALastStepMayBeTrianglesAlone)
{
    for (const auto& [name, mesh] : posed_meshes()) {
        const LoopTopology t = make_control_mesh(mesh).topology;
        EXPECT_EQ(refine_triangles(t), refine(t).triangles) << name;
    }
}

} // namespace
} // namespace limn::test
