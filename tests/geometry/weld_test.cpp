#include <map>

#include <gtest/gtest.h>

#include "geometry/meshes.h"
#include "limn/base/parallel.h"
#include "limn/geometry/diagnose.h"
#include "limn/geometry/weld.h"

using namespace limn;

namespace {

/// Every triangle with three vertices of its own.
Mesh soup_of(const Mesh& mesh)
{
    Mesh soup;
    for (const uvec3& t : mesh.triangles) {
        const std::uint32_t first = std::uint32_t(soup.positions.size());
        for (int k = 0; k < 3; ++k)
            soup.positions.push_back(mesh.positions[t[k]]);
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    return soup;
}

} // namespace

TEST(Weld, TurnsASoupBackIntoAClosedMesh)
{
    const Mesh mesh = test::torus(150, 120);
    Mesh soup = soup_of(test::shuffled(mesh, 7));
    EXPECT_EQ(weld(soup), 3 * mesh.triangles.size() - mesh.positions.size());
    EXPECT_EQ(soup.positions.size(), mesh.positions.size());
    EXPECT_EQ(diagnose(soup).euler, 0);
    EXPECT_TRUE(diagnose(soup).closed);
}

TEST(Weld, NumbersVerticesInTheirFirstOrderAndKeepsTheFirstColour)
{
    Mesh mesh;
    mesh.positions = {{2, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}, {1, 0, 0}};
    mesh.colours = {vec4(0.1f), vec4(0.2f), vec4(0.3f), vec4(0.4f), vec4(0.5f)};
    mesh.triangles = {{0, 1, 3}, {2, 4, 3}};
    EXPECT_EQ(weld(mesh), 2u);
    EXPECT_EQ(mesh.positions, (std::vector<dvec3>{{2, 0, 0}, {1, 0, 0}, {0, 0, 0}}));
    EXPECT_EQ(mesh.colours, (std::vector<vec4>{vec4(0.1f), vec4(0.2f), vec4(0.4f)}));
    EXPECT_EQ(mesh.triangles[1], uvec3(0, 1, 2));
}

TEST(Weld, TakesBothZerosForOneAndNanForNone)
{
    const double nan = std::nan("");
    const std::vector<dvec3> positions = {{0.0, 0, 0}, {-0.0, 0, -0.0}, {nan, 0, 0}, {nan, 0, 0}, {1e-320, 0, 0}};
    EXPECT_EQ(find_same_positions(positions), (std::vector<std::uint32_t>{0, 0, 2, 3, 4}));
}

TEST(Weld, TakesManyNanVerticesWithoutComparingEachWithEach)
{
    const std::vector<dvec3> positions(1000000, dvec3(std::nan("")));
    EXPECT_EQ(find_same_positions(positions)[999999], 999999u);
}

TEST(Weld, DoesNotDependOnTheNumberOfThreads)
{
    std::mt19937 random(3);
    std::vector<dvec3> positions(300000);
    for (dvec3& p : positions)
        p = {double(random() % 40), double(random() % 40), double(random() % 40)};
    const auto one = with_threads(1, [&] { return find_same_positions(positions); });
    const auto two = with_threads(2, [&] { return find_same_positions(positions); });
    EXPECT_EQ(one, two);
    std::map<std::array<double, 3>, std::uint32_t> first;
    for (std::uint32_t v = 0; v < positions.size(); ++v)
        ASSERT_EQ(one[v], first.try_emplace({positions[v].x, positions[v].y, positions[v].z}, v).first->second);
}

TEST(Weld, JoinsWithinATolerance)
{
    Mesh mesh = test::torus(60, 40);
    Mesh soup = soup_of(mesh);
    std::mt19937 random(11);
    for (dvec3& p : soup.positions)
        p += dvec3(random() % 1000, random() % 1000, random() % 1000) * 1e-9;
    Mesh exact = soup;
    weld(exact);
    EXPECT_GT(exact.positions.size(), mesh.positions.size()) << "the noise keeps equal positions apart";
    weld(soup, 1e-5);
    EXPECT_EQ(soup.positions.size(), mesh.positions.size());
    EXPECT_TRUE(diagnose(soup).closed);
}

TEST(Weld, SurvivesPositionsFarOutsideOfTheToleranceGrid)
{
    const std::vector<dvec3> positions = {{1e300, 0, 0}, {1e300, 0, 0}, {HUGE_VAL, 0, 0}, {0, 0, 0}, {0, 0, 1e-9}};
    EXPECT_EQ(find_near_positions(positions, 1e-6), (std::vector<std::uint32_t>{0, 1, 2, 3, 3}));
}
