// How `limn render` shades control meshes: --normals and --map-size.

#include <gtest/gtest.h>

#include "command/command.h"
#include "limn/drawing/png.h"
#include "limn/geometry/write_mesh.h"
#include "limn/subdivision/control_samples.h"

namespace limn::test {
namespace {

class RenderNormals : public WithTorus {
protected:
    RenderNormals() { write_mesh(make_control_sample("bracket"), folder_ / "bracket.obj"); }

    Image rendered(const std::string& arguments, const std::string& model = "bracket.obj") const
    {
        const ProgramResult result = limn("render " + path(model) + " --subdivision loop --size 120x90 --device cpu -o " + path("a.png") + " " + arguments);
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        return read_png(path("a.png"));
    }
    static double difference(const Image& a, const Image& b)
    {
        double sum = 0;
        for (std::size_t i = 0; i < a.samples.size(); ++i)
            sum += std::abs(double(a.samples[i]) - double(b.samples[i]));
        return sum / double(a.samples.size());
    }
};

TEST_F(RenderNormals, AMapIsAsGoodAsItIsLarge)
{
    const Image limit = rendered(""), map = rendered("--normals map"), small = rendered("--normals map --map-size 128"), vertex = rendered("--normals vertex");
    EXPECT_LT(difference(map, limit), 0.5 * difference(small, limit));
    EXPECT_LT(difference(small, limit), 0.5 * difference(vertex, limit));
}

TEST_F(RenderNormals, ASceneSaysTheSame)
{
    const std::string scene = R"({"limn": 1, "objects": [{"file": "bracket.obj"}], "subdivision": {"subdivision": "loop", "normals": "map", "map-size": 128},
                                 "render": {"shading": "normals"}})";
    write_text(path("scene.json"), scene);
    EXPECT_EQ(rendered("", "scene.json").samples, rendered("--normals map --map-size 128 --shading normals").samples);
    EXPECT_EQ(rendered("--normals vertex --shading gouraud", "scene.json").samples, rendered("--normals vertex --shading gouraud").samples);
}

TEST_F(RenderNormals, AMapThatIsTooSmallIsNamed)
{
    for (const auto& [arguments, part] : {std::pair<const char*, const char*>{"--normals map --map-size 16", "--map-size 16: "}, {"--map-size 8", "outside 16..8192"},
                                          {"--normals cube", "none of limit|map|vertex"}}) {
        const ProgramResult result = limn("render " + path("bracket.obj") + " --subdivision loop -o " + path("b.png") + " " + arguments);
        EXPECT_EQ(result.exit_code, 2) << arguments;
        EXPECT_EQ(line_count(result.errors), 1) << result.errors;
        EXPECT_NE(result.errors.find(part), std::string::npos) << result.errors;
    }
}

} // namespace
} // namespace limn::test
