#include <gtest/gtest.h>

#include "limn/drawing/hdr.h"
#include "limn/drawing/png.h"
#include "limn/geometry/read_mesh.h"
#include "limn/shadow/bake_shadow_maps.h"

#include "command/command.h" // after the formulas: Taylor's functions would hide theirs

namespace limn::test {
namespace {

class RenderLight : public WithTorus {
protected:
    std::string arguments(const std::string& options, const std::string& name) const
    {
        return "render " + torus() + " --size 96x72 --samples 4 --quiet --view 30,40 --ground -o " + path(name) + " " + options;
    }
    std::string bytes(const std::string& options)
    {
        const ProgramResult result = limn(arguments(options, "a.png"));
        EXPECT_EQ(result.exit_code, 0) << options << ": " << result.errors;
        return read_text(folder_ / "a.png");
    }
    void refuses(const std::string& options, const std::string& message, int exit_code = 2)
    {
        const ProgramResult result = limn(arguments(options, "never.png"));
        EXPECT_EQ(result.exit_code, exit_code) << options;
        EXPECT_NE(result.errors.find(message), std::string::npos) << options << ": " << result.errors;
        EXPECT_EQ(line_count(result.errors), 1) << result.errors;
        EXPECT_FALSE(exists("never.png"));
    }
    /// How much of the picture is darker than in another one.
    double darker(const std::string& options, const std::string& than)
    {
        bytes(than);
        const Image plain = read_png(path("a.png"));
        bytes(options);
        const Image image = read_png(path("a.png"));
        std::size_t count = 0;
        for (std::size_t i = 0; i < image.samples.size(); i += 3)
            count += image.samples[i] < plain.samples[i] - 0.05f;
        return double(count) / (96 * 72);
    }
};

TEST_F(RenderLight, HidesNothingUnlessAsked)
{
    const std::string usual = bytes("--light 1,2,1");
    EXPECT_EQ(bytes("--light 1,2,1 --shadow none"), usual);
    EXPECT_EQ(bytes("--light 1,2,1 --shadow auto"), usual);
    EXPECT_NE(bytes("--light 1,2,1 --shadow ray"), usual);
    EXPECT_EQ(bytes("--shadow ray"), bytes("")) << "the eye sees no shadow of a light beside it";
    EXPECT_EQ(bytes("--ao=no"), bytes(""));
}

TEST_F(RenderLight, DarkensWhereLightIsHidden)
{
    EXPECT_GT(darker("--light 1,2,1 --shadow ray", "--light 1,2,1"), 0.02);
    EXPECT_GT(darker("--lamp 2,4,2 --shadow ray", "--lamp 2,4,2"), 0.02);
    EXPECT_GT(darker("--light sphere:2,4,2,0.5", "--light sphere:2,4,2,0.5 --shadow none"), 0.02);
    EXPECT_GT(darker("--light rect:2,4,2,1,0.5,0,0,0", "--light rect:2,4,2,1,0.5,0,0,0 --shadow none"), 0.02);
    EXPECT_GT(darker("--ao", ""), 0.02);
    EXPECT_GT(darker("--ao=5", "--ao=0.2"), 0.02);
}

TEST_F(RenderLight, IsTheSameForAnyNumberOfThreads)
{
    const std::string options = "--light sphere:2,4,2,0.5 --shadow-samples 16 --ao --threads ";
    EXPECT_EQ(bytes(options + "1"), bytes(options + "2"));
}

TEST_F(RenderLight, TakesLightFromAPicture)
{
    Image sky({16, 8}, 3, 0.1f);
    for (int c = 0; c < 3; ++c)
        sky.at(10, 1)[c] = 200;
    write_text(folder_ / "sky.hdr", encode_hdr(sky));
    EXPECT_GT(darker("--light env:" + path("sky.hdr"), "--light env:" + path("sky.hdr") + " --shadow none"), 0.02);
    write_text(folder_ / "cut.hdr", encode_hdr(sky).substr(0, 100));
    refuses("--light env:" + path("cut.hdr"), "cut.hdr: byte", 1);
    write_text(folder_ / "dark.hdr", encode_hdr(Image({4, 4}, 3)));
    refuses("--light env:" + path("dark.hdr"), "dark.hdr: an environment that is dark all over", 1);
    refuses("--light env:" + path("none.hdr"), "none.hdr", 1);
}

TEST_F(RenderLight, TakesMapsOfTheModel)
{
    BakeOptions options;
    options.maps = 256, options.resolution = 32;
    write_csm(bake_shadow_maps(read_mesh(torus()), options), path("torus.csm"));
    const std::string light = "--light 1,2,1 ", maps = " --shadow-maps " + path("torus.csm");
    EXPECT_GT(darker(light + maps, light), 0.02);
    EXPECT_EQ(bytes(light + maps + " --shadow none"), bytes(light));
    EXPECT_NE(bytes(light + maps), bytes(light + "--shadow ray"));
    write_text(folder_ / "scene.json", R"({"limn": 1, "objects": [{"file": "torus.obj", "shadow-maps": "torus.csm"}], "lights": [{"kind": "distant", "direction": [1, 2, 1]}],
        "camera": {"view": "30,40", "size": [96, 72]}, "render": {"ground": true, "samples": 4}})");
    ASSERT_EQ(limn("render " + path("scene.json") + " --quiet -o " + path("b.png")).exit_code, 0);
    EXPECT_EQ(read_text(folder_ / "b.png"), bytes(light + maps));

    write_csm(bake_shadow_maps(make_shape({.name = "knot", .triangles = 500}).mesh, options), path("knot.csm"));
    refuses("--shadow-maps " + path("knot.csm"), "knot.csm: was baked of another model than is shown", 1);
    refuses("--shadow-maps " + path("none.csm"), "none.csm", 1);
    refuses("--subdivision loop" + maps, "--shadow-maps: maps are of a mesh as it is");
    refuses("--shadow csm --light 1,2,1", "--shadow csm: no object has maps");
}

TEST_F(RenderLight, RefusesWhatIsNoLight)
{
    refuses("--light sphere:1,2,3", "--light: 3 numbers are not sphere:x,y,z,radius");
    refuses("--light sphere:1,2,3,0", "--light: the radius 0 of a sphere is not above 0");
    refuses("--light rect:1,2,3,1", "--light: 4 numbers are not rect:x,y,z,width,height");
    refuses("--light rect:1,2,3,1,-1", "--light: the sides 1 and -1 of a rectangle are not above 0");
    refuses("--light rect:1,2,3,1,nan", "--light: 'nan' is not a number");
    refuses("--light env:", "--light: env:FILE needs the name of a Radiance picture");
    refuses("--light 1,2", "--light: '1,2' is not x,y,z");
    refuses("--light sphere:1,2,3,1 --lamp 1,2,3", "a light with a size and one without were both asked for");
    refuses("--ao=-1", "--ao: -1 is outside 0.001..1000");
    refuses("--shadow soft", "--shadow: 'soft' is none of auto|csm|ray|none");
    refuses("--shadow-samples 0", "--shadow-samples: 0 is outside 1..4096");
}

} // namespace
} // namespace limn::test
