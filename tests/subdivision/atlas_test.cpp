#include "limn/subdivision/atlas.h"

#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "subdivision/charted.h"
#include "subdivision/control_meshes.h"

namespace limn::test {
namespace {

/// The distance of two boxes along the axis where they are further apart.
double box_distance(const dvec2& low_a, const dvec2& high_a, const dvec2& low_b, const dvec2& high_b)
{
    const dvec2 d = glm::max(low_a - high_b, low_b - high_a);
    return std::max(d.x, d.y);
}

void expect_apart(const std::vector<Chart>& charts, const Atlas& atlas, std::size_t faces, const std::string& name)
{
    const auto low = [&](std::size_t i) { return atlas.texel(i, {0, charts[i].size.y}); };
    const auto high = [&](std::size_t i) { return atlas.texel(i, {charts[i].size.x, 0}); };
    double nearest = 1e9;
    for (std::size_t i = 0; i < charts.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
            nearest = std::min(nearest, box_distance(low(i), high(i), low(j), high(j)));
        const Atlas::Cell& cell = atlas.cells[i];
        for (int k = 0; k < 2; ++k) {
            EXPECT_GE(low(i)[k], cell.low[k] + atlas.gap / 2 - 1e-9) << name;
            EXPECT_LE(high(i)[k], cell.high[k] - atlas.gap / 2 + 1e-9) << name;
            EXPECT_EQ(cell.low[k] % atlas.gap + cell.high[k] % atlas.gap, 0) << name;
            EXPECT_TRUE(cell.low[k] >= 0 && cell.high[k] <= atlas.size) << name;
        }
    }
    EXPECT_GE(nearest, atlas.gap - 1e-9) << name;
    for (const vec2& uv : atlas_uvs(atlas, charts, faces)) {
        EXPECT_TRUE(uv.x > 0 && uv.y > 0 && uv.x < 1 && uv.y < 1) << name;
    }
    EXPECT_EQ(1 << atlas.mip_levels(), atlas.gap);
}

// Checklist 26.
TEST(Atlas, KeepsChartsApartInsideTheMap)
{
    for (const std::string& name : control_sample_names()) {
        const ControlMesh control = make_control_mesh(make_control_sample(name));
        for (const ChartKind kind : {ChartKind::triangles, ChartKind::pairs}) {
            const std::vector<Chart> charts = make_charts(control.topology, limit_positions(control.topology, control.positions), kind);
            for (const int gap : {2, 4, 16})
                expect_apart(charts, pack_charts(charts, 1000, gap), control.topology.triangles.size(), name);
        }
    }
}

TEST(Atlas, TellsHowMuchOfTheMapIsFilled)
{
    for (const std::string& name : control_sample_names()) {
        double fill[2];
        for (const ChartKind kind : {ChartKind::triangles, ChartKind::pairs}) {
            const Charted it(make_control_sample(name), {.size = 512, .charts = kind});
            double& found = fill[kind == ChartKind::pairs];
            found = it.layout.atlas.fill;
            const double covered = double(object_space_map(it.layout, it.shape, MapGutter::empty).covered) / (512.0 * 512);
            EXPECT_NEAR(covered / found, 1, 0.02) << name;
        }
        fmt::print("[ fill     ] {}: {:.1f} % in triangles, {:.1f} % in pairs\n", name, 100 * fill[0], 100 * fill[1]);
        EXPECT_LT(fill[0], 0.5) << name;
        EXPECT_GT(fill[0], 0.2) << name;
        EXPECT_GT(fill[1], fill[0] * 1.15) << name;
    }
}

TEST(Atlas, HoldsAsManyChartsAsHaveRoomAndRefusesMore)
{
    const ControlMesh control = make_control_mesh(sheet(8));
    const std::vector<Chart> charts = make_charts(control.topology, control.positions, ChartKind::triangles); // 128
    EXPECT_GT(pack_charts(charts, 48, 2).scale, 0);
    try {
        pack_charts(charts, 32, 4);
        FAIL();
    } catch (const Error::Input& error) {
        EXPECT_STREQ(error.what(), "128 charts with gaps of 4 texels do not fit into a map of 32 x 32; make it larger");
    }
    EXPECT_THROW(pack_charts(charts, 0, 4), Error::Input);
    EXPECT_THROW(pack_charts(charts, 1024, 3), Error::Input);
    EXPECT_THROW(pack_charts(std::vector<Chart>(1), 1024, 4), Error::Input);
}

TEST(Atlas, GivesChartsWithoutExtentAPlaceToo)
{
    Mesh mesh = sheet(2);
    mesh.positions[1] = mesh.positions[0];
    const ControlMesh control = make_control_mesh(mesh);
    const std::vector<Chart> charts = make_charts(control.topology, control.positions, ChartKind::pairs);
    const Atlas atlas = pack_charts(charts, 128, 4);
    for (const Atlas::Cell& cell : atlas.cells) {
        EXPECT_TRUE(cell.high.x - cell.low.x >= 8 && cell.high.y - cell.low.y >= 8);
    }
    for (const vec2& uv : atlas_uvs(atlas, charts, mesh.triangles.size())) {
        EXPECT_TRUE(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1);
    }
}

} // namespace
} // namespace limn::test
