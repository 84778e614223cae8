#include "limn/subdivision/charts.h"

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "subdivision/charted.h"
#include "subdivision/control_meshes.h"

namespace limn::test {
namespace {

const ChartKind every_kind[] = {ChartKind::triangles, ChartKind::pairs};

// Checklist 25.
TEST(Charts, EdgesAreAsLongAsInSpace)
{
    for (const std::string& name : control_sample_names())
        for (const ChartKind kind : every_kind) {
            const Charted it(make_control_sample(name), {.charts = kind});
            std::vector<int> seen(it.mesh.triangles.size(), 0);
            for (const Chart& chart : it.layout.charts)
                for (int f = 0; f < chart.face_count(); ++f) {
                    const uvec3& t = it.control.topology.triangles[chart.faces[f]];
                    ++seen[chart.faces[f]];
                    for (int k = 0; k < 3; ++k) {
                        const double wanted = glm::distance(it.limit[t[k]], it.limit[t[(k + 1) % 3]]);
                        const double flat = glm::distance(chart.corners[f][k], chart.corners[f][(k + 1) % 3]);
                        EXPECT_NEAR(flat, wanted, 1e-12) << name;
                        const std::size_t c = 3 * std::size_t(chart.faces[f]);
                        const double in_map = glm::distance(dvec2(it.layout.uvs[c + std::size_t(k)]), dvec2(it.layout.uvs[c + std::size_t((k + 1) % 3)])) * 1024;
                        EXPECT_NEAR(in_map / it.layout.atlas.scale, wanted, 1e-5 * std::max(wanted, 10 / it.layout.atlas.scale)) << name;
                    }
                    const dvec2 a = chart.corners[f][1] - chart.corners[f][0], b = chart.corners[f][2] - chart.corners[f][0];
                    EXPECT_GT(a.x * b.y - a.y * b.x, 0) << name << " face " << chart.faces[f] << " is turned over";
                    for (const dvec2& p : chart.corners[f]) {
                        EXPECT_TRUE(p.x >= 0 && p.y >= 0 && p.x <= chart.size.x && p.y <= chart.size.y) << name;
                    }
                }
            EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), std::ptrdiff_t(seen.size())) << name;
        }
}

TEST(Charts, OfOneTriangleLieOnTheLongestSide)
{
    const Charted it(make_control_sample("creature"), {.charts = ChartKind::triangles});
    ASSERT_EQ(it.layout.charts.size(), it.mesh.triangles.size());
    for (const Chart& chart : it.layout.charts) {
        double longest = 0;
        for (int k = 0; k < 3; ++k)
            longest = std::max(longest, glm::distance(chart.corners[0][k], chart.corners[0][(k + 1) % 3]));
        EXPECT_NEAR(chart.size.x, longest, 1e-12);
        EXPECT_NEAR(chart.area(), chart.size.x * chart.size.y / 2, 1e-12);
    }
}

TEST(Charts, OfPairsMeetAlongASmoothEdgeAndFillTheirBoxBetter)
{
    std::size_t pairs = 0, faces = 0;
    for (const std::string& name : control_sample_names()) {
        const Charted it(make_control_sample(name), {.charts = ChartKind::pairs});
        faces += it.mesh.triangles.size();
        for (const Chart& chart : it.layout.charts) {
            if (chart.face_count() == 1)
                continue;
            ++pairs;
            EXPECT_GT(chart.area(), 0.5 * chart.size.x * chart.size.y);
            EXPECT_LT(chart.area(), 1.000001 * chart.size.x * chart.size.y);
            std::size_t shared = 0;
            const LoopTopology& t = it.control.topology;
            for (std::uint32_t h = 3 * chart.faces[0]; h < 3 * chart.faces[0] + 3; ++h)
                if (t.twin[h] != none && t.twin[h] / 3 == chart.faces[1]) {
                    const std::uint32_t over = t.twin[h];
                    EXPECT_LT(glm::distance(chart.corners[0][h % 3], chart.corners[1][(over % 3 + 1) % 3]), 1e-12);
                    EXPECT_LT(glm::distance(chart.corners[0][(h % 3 + 1) % 3], chart.corners[1][over % 3]), 1e-12);
                    EXPECT_EQ(t.sharpness[t.edge[h]], 0);
                    ++shared;
                }
            EXPECT_GE(shared, 1u) << name;
        }
    }
    EXPECT_GT(2 * pairs, 0.9 * double(faces));
}

TEST(Charts, OfASquareCutInTwoIsTheSquare)
{
    const ControlMesh control = make_control_mesh(sheet(1));
    const std::vector<Chart> charts = make_charts(control.topology, control.positions, ChartKind::pairs);
    ASSERT_EQ(charts.size(), 1u);
    EXPECT_NEAR(charts[0].size.x, 1, 1e-12);
    EXPECT_NEAR(charts[0].size.y, 1, 1e-12);
    EXPECT_NEAR(charts[0].area(), 1, 1e-12);
}

} // namespace
} // namespace limn::test
