#include <gtest/gtest.h>

#include "command/command.h"
#include "console.h"
#include "limn/geometry/read_mesh.h"
#include "limn/subdivision/control_samples.h"
#include "limn/terrain/read_height_map.h"
#include "limn/terrain/terrain_samples.h"

namespace limn::test {
namespace {

class SampleCommand : public WithTorus {
protected:
    void expect_refused(const std::string& arguments, int code, const std::string& part) const
    {
        const ProgramResult result = limn("sample " + arguments);
        EXPECT_EQ(result.exit_code, code) << arguments;
        EXPECT_NE(result.errors.find(part), std::string::npos) << result.errors;
    }
};

TEST_F(SampleCommand, WritesControlMeshesWithTheirCreases)
{
    const ProgramResult result = limn("sample creature --double -o " + path("creature.obj"));
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    const Mesh wanted = make_control_sample("creature");
    const Mesh mesh = read_mesh(path("creature.obj"), {.keep_polygons = true});
    EXPECT_EQ(mesh.positions, wanted.positions);
    EXPECT_EQ(mesh.triangles, wanted.triangles);
    EXPECT_EQ(mesh.creases.size(), wanted.creases.size());
    EXPECT_NE(result.errors.find(counted(wanted.triangles.size(), "triangle")), std::string::npos) << result.errors;
}

TEST_F(SampleCommand, SaysThatAFormatHoldsNoCreases)
{
    const ProgramResult result = limn("sample mug -o " + path("mug.ply") + " -o " + path("mug.obj"));
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_NE(result.errors.find("warning: " + path("mug.ply") + ": "), std::string::npos) << result.errors;
    EXPECT_NE(result.errors.find("creases left out, which only OBJ can hold\n"), std::string::npos) << result.errors;
    expect_refused("mug --strict -o " + path("strict.ply"), 1, "which only OBJ can hold (--strict)");
    EXPECT_FALSE(exists("strict.ply"));
    EXPECT_EQ(limn("sample bent-cylinder --strict -o " + path("bent.ply")).exit_code, 0);
}

TEST_F(SampleCommand, RefusesToChangeControlMeshes)
{
    expect_refused("creature --triangles 100 -o " + path("a.obj"), 2, "--triangles: 'creature' is a control mesh of ");
    expect_refused("leaf --noise 0.1 -o " + path("a.obj"), 2, "--noise: 'leaf' is a control mesh of 60 triangles, and stays as it is");
    expect_refused("creatures -o " + path("a.obj"), 2, "did you mean 'creature'?");
    EXPECT_FALSE(exists("a.obj"));
}

TEST_F(SampleCommand, WritesTerrain)
{
    const ProgramResult result = limn("sample terrain --size 65x33 --seed 4 -o " + path("t.tif"));
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_NE(result.errors.find("65 x 33 samples"), std::string::npos) << result.errors;
    const HeightMap map = read_height_map(path("t.tif"));
    EXPECT_EQ(map.heights, make_terrain({.columns = 65, .rows = 33, .seed = 4}).heights);
    EXPECT_EQ(limn("sample terrain --landform reference --size 257 -o - --to tif > " + path("g.tif")).exit_code, 0);
    EXPECT_EQ(read_height_map(path("g.tif")).height(37, 100), 75.0f);
    const nlohmann::json report = nlohmann::json::parse(limn("sample terrain --size 9 --json --quiet -o " + path("j.tif")).output);
    EXPECT_EQ(report["columns"], 9);
    EXPECT_EQ(report["terrain"], "mountains");
}

TEST_F(SampleCommand, KeepsTheOptionsOfShapesAndTerrainApart)
{
    expect_refused("terrain --triangles 100 -o " + path("a.tif"), 2, "--triangles: a terrain has no triangles to change");
    expect_refused("torus --size 65 -o " + path("a.ply"), 2, "--size: 'torus' is no terrain");
    expect_refused("terrain -o " + path("a.ply"), 2, "'ply' is not a format to write; known: tif, tiff");
    expect_refused("terrain --size 1 -o " + path("a.tif"), 2, "--size: '1' is outside 2..1048576 samples a side");
    expect_refused("terrain --landform reverence -o " + path("a.tif"), 2, "--landform: 'reverence' is none of mountains|reference|");
    expect_refused("terain -o " + path("a.tif"), 2, "did you mean 'terrain'?");
    EXPECT_FALSE(exists("a.tif") || exists("a.ply"));
}

} // namespace
} // namespace limn::test
