// What a run keeps from view to view, and what it says of where the eyes are.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "command/command.h"

namespace limn::test {
namespace {

using Json = nlohmann::json;

class Views : public WithTorus {
protected:
    /// Draws the torus from an eye in the plane of its ring: outside at (0,0,1), within the tube a quarter turn on.
    ProgramResult turn_through_the_tube(const std::string& options) const
    {
        return limn("draw " + torus() + " --size 160x120 --eye 0,0,1 --look 0,0,0 --turntable 4 --quiet -o " + path("turn.svg") + " " + options);
    }
};

TEST_F(Views, ATurntableGoesBackToAllClustersWhereBoundsRuleOutTooFew)
{
    const ProgramResult result = limn("draw " + torus() + " --size 80x60 --turntable 50 --json --quiet -o " + path("turn.svg"));
    const Json views = Json::parse(result.output)["views"];
    ASSERT_EQ(views.size(), 50u);
    EXPECT_GT(views[0]["clusters"]["survivors"], 0.5); // a coarse torus: most clusters hold a line
    EXPECT_TRUE(views[0]["clusters"]["bounded"]);
    for (int i = 1; i <= 16; ++i)
        EXPECT_FALSE(views[std::size_t(i)]["clusters"]["bounded"]) << i;
    EXPECT_TRUE(views[17]["clusters"]["bounded"]); // tried again
}

TEST_F(Views, AnEyeThatEntersTheModelInALaterFrameIsWarnedOfOnce)
{
    const ProgramResult result = turn_through_the_tube("");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.errors, "limn: warning: camera: the eye is inside a closed model in 2 of 4 views\n");
    EXPECT_EQ(files().size(), 5u);
}

TEST_F(Views, StrictWritesNoFrameWhereALaterEyeIsInside)
{
    const ProgramResult result = turn_through_the_tube("--strict");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.errors, "limn: camera: the eye is inside a closed model in 2 of 4 views (--strict)\n");
    EXPECT_EQ(files(), std::vector<std::string>{"torus.obj"});
}

/// Eyes on a vertex, an edge and a face of a shape.
class EyeOnTheSurface : public WithTorus {
protected:
    void expect_warned(const std::string& shape)
    {
        const Mesh mesh = make_shape({.name = shape, .triangles = 1000}).mesh;
        write_text(folder_ / "model.obj", obj_text(mesh));
        const uvec3 t = mesh.triangles[mesh.triangles.size() / 3];
        const dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        for (const dvec3& eye : {a, 0.5 * (a + b), (a + b + c) / 3.0}) {
            const ProgramResult result = limn(fmt::format("draw {} --size 160x120 --eye {:.9g},{:.9g},{:.9g} --look 0.1,0.2,3 --lines contour,suggestive --quiet -o {}",
                                                          path("model.obj"), eye.x, eye.y, eye.z, path("a.svg")));
            EXPECT_EQ(result.exit_code, 0) << result.errors;
            EXPECT_EQ(line_count(result.errors), 1) << result.errors;
            EXPECT_NE(result.errors.find("the eye is on the surface"), std::string::npos) << result.errors;
            EXPECT_EQ(result.errors.find("inside"), std::string::npos) << result.errors;
            EXPECT_NE(read_text(folder_ / "a.svg").find("</svg>"), std::string::npos);
        }
    }
};

TEST_F(EyeOnTheSurface, OfAnOpenSheetIsWarnedOf) { expect_warned("sine-sheet"); }

TEST_F(EyeOnTheSurface, OfAClosedTorusIsWarnedOf) { expect_warned("torus"); }

TEST_F(EyeOnTheSurface, IsNotAnEyeJustOffIt)
{
    // The torus' outermost point is (1.4, 0, 0).
    const ProgramResult result = limn("draw " + torus() + " --size 160x120 --eye 1.401,0,0 --look 0,0,0 --quiet -o " + path("a.svg"));
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.errors, "");
}

} // namespace
} // namespace limn::test
