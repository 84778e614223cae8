#include <gtest/gtest.h>

#include "command/command.h"
#include "limn/drawing/png.h"
#include "limn/geometry/read_mesh.h"

namespace limn::test {
namespace {

/// A temporary folder with a generated height map and a red image in it.
class TerrainDrape : public testing::Test {
protected:
    TerrainDrape()
    {
        EXPECT_EQ(limn("sample terrain --size 65x49 -o " + map()).exit_code, 0);
        Image red(ivec2(8, 8), 3);
        for (int i = 0; i < 64; ++i)
            red.samples[std::size_t(3 * i)] = 1;
        write_png(red, path("red.png"));
    }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string map() const { return path("map.tif"); }

private:
    TemporaryFolder folder_;
};

TEST_F(TerrainDrape, ColoursPicturesAndMeshes)
{
    const ProgramResult result = limn("terrain " + map() + " --drape " + path("red.png") + " --size 160x120 --samples 1 -o " + path("a.png") + " -o " + path("a.glb") + " -o " + path("a.ply"));
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_NE(result.errors.find("red.png is stretched over the map"), std::string::npos) << result.errors;
    const Image picture = read_png(path("a.png"));
    const float* const middle = picture.at(80, 70);
    EXPECT_GT(middle[0], 0.2f);
    EXPECT_EQ(middle[1], 0.0f);
    const Mesh ply = read_mesh(path("a.ply"));
    ASSERT_EQ(ply.colours.size(), ply.positions.size());
    for (const vec4& colour : ply.colours)
        ASSERT_EQ(colour, vec4(1, 0, 0, 1));
    const std::string glb = read_text(path("a.glb"));
    for (const char* part : {"baseColorTexture", "TEXCOORD_0", "image/png", "\x89PNG"})
        EXPECT_NE(glb.find(part), std::string::npos) << part;
    EXPECT_EQ(glb.find("COLOR_0"), std::string::npos) << "it would darken the texture";
}

TEST_F(TerrainDrape, SaysWhatIsWrong)
{
    const auto expect_error = [&](const std::string& arguments, int code, const std::string& part) {
        const ProgramResult result = limn("terrain " + map() + " " + arguments);
        EXPECT_EQ(result.exit_code, code) << arguments;
        EXPECT_EQ(line_count(result.errors), 1) << result.errors;
        EXPECT_NE(result.errors.find(part), std::string::npos) << result.errors;
    };
    expect_error("--drape " + path("none.png") + " -o " + path("x.png"), 1, "none.png: cannot be opened");
    expect_error("--drape " + path("red.png") + " -o " + path("x.svg"), 2, "--drape is for shaded pictures and for meshes");
    expect_error("--drape " + path("red.png") + " -o " + path("x.stl"), 2, "--drape is for shaded pictures and for meshes");
    expect_error("--drape " + path("red.png") + " --base 3 -o " + path("x.glb"), 2, "leave --base out");
    expect_error("--drape " + map() + " -o " + path("x.png"), 1, "is no image to drape");
    for (const char* name : {"x.png", "x.svg", "x.stl", "x.glb"})
        EXPECT_FALSE(std::filesystem::exists(path(name)));
}

} // namespace
} // namespace limn::test
