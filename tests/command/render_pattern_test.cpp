// `limn render --material`: prints, bricks and thread.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "command/command.h"

#include "limn/drawing/png.h"

namespace limn::test {
namespace {

class RenderPattern : public WithTorus {
protected:
    ProgramResult render(const std::string& model, const std::string& arguments) const
    {
        return limn("render " + model + " --size 120x90 -o " + path("a.png") + " " + arguments);
    }
    std::string sphere(const std::string& format) const
    {
        const std::string file = path("sphere." + format);
        EXPECT_EQ(limn("sample sphere --triangles 2000 --quiet -o " + file).exit_code, 0);
        return file;
    }
    void expect_refusal(const std::string& arguments, const std::string& message) const
    {
        const ProgramResult result = limn("render " + torus() + " -o " + path("b.png") + " " + arguments);
        EXPECT_NE(result.exit_code, 0) << arguments;
        EXPECT_NE(result.errors.find(message), std::string::npos) << result.errors;
        EXPECT_EQ(result.errors.find('\n'), result.errors.size() - 1) << "one line";
        EXPECT_FALSE(std::filesystem::exists(path("b.png")));
    }
};

TEST_F(RenderPattern, APrintStandsOnItsPlateAndTheLastLineTellsItsSize)
{
    const ProgramResult ply = render(torus(), "--material layers --layer-height 0.5mm");
    ASSERT_EQ(ply.exit_code, 0) << ply.errors;
    EXPECT_NE(ply.errors.find("layers of 0.5 mm, the longest side taken as 100 mm (--units tells otherwise)"), std::string::npos)
        << ply.errors;
    const ProgramResult stl = render(sphere("stl"), "--material layers --layer-height 50um --filament petg-black");
    EXPECT_NE(stl.errors.find("layers of 0.05 mm, the longest side is 2 mm"), std::string::npos) << stl.errors;
    const ProgramResult glb = render(sphere("glb"), "--material layers");
    EXPECT_NE(glb.errors.find("layers of 0.2 mm, the longest side is 2000 mm"), std::string::npos) << glb.errors;
    const ProgramResult inches = render(torus(), "--material layers --units in");
    EXPECT_NE(inches.errors.find("the longest side is 71.0"), std::string::npos) << inches.errors;
}

TEST_F(RenderPattern, LayersShowAndTheSamePictureComesFromAnyNumberOfThreads)
{
    ASSERT_EQ(render(torus(), "--quiet").exit_code, 0);
    const Image plain = read_png(path("a.png"));
    ASSERT_EQ(render(torus(), "--quiet --material layers --layer-height 3mm --threads 1").exit_code, 0);
    const std::string once = read_text(path("a.png"));
    ASSERT_EQ(render(torus(), "--quiet --material layers --layer-height 3mm --threads 3").exit_code, 0);
    EXPECT_EQ(read_text(path("a.png")), once);
    EXPECT_NE(read_png(path("a.png")).samples, plain.samples);
}

TEST_F(RenderPattern, CuspHeightsAreColouredCountedAndExplained)
{
    const ProgramResult result = limn("render " + torus() + " --size 400x300 --background '#ffffff' -o " + path("a.png") +
                                      " --material layers --layer-height 1mm --show cusp");
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_NE(result.errors.find("cusps to 1 mm, mean 0."), std::string::npos) << result.errors;
    const Image image = read_png(path("a.png"));
    int coloured = 0; // in the corner of the legend
    for (int y = 200; y < 290; ++y)
        for (int x = 10; x < 140; ++x)
            coloured += std::abs(image.at(x, y)[0] - image.at(x, y)[2]) > 0.2f;
    EXPECT_GT(coloured, 500);
}

TEST_F(RenderPattern, CuspHeightsAreInTheReport)
{
    ASSERT_EQ(limn("sample sphere --triangles 20000 --quiet -o " + path("ball.ply")).exit_code, 0);
    const std::string ball = "render " + path("ball.ply") + " --size 60x45 --quiet --json --material layers --layer-height 2mm";
    const nlohmann::json cusps = nlohmann::json::parse(limn(ball + " --show cusp").output).at("cusps");
    EXPECT_EQ(cusps.at("unit"), "mm");
    EXPECT_EQ(cusps.at("most"), 2.0);
    EXPECT_NEAR(cusps.at("mean").get<double>(), 1, 0.02) << "over a ball the cosine is spread evenly";
    EXPECT_NEAR(cusps.at("median").get<double>(), 1, 0.03);
    ASSERT_EQ(cusps.at("shares").size(), 20u);
    double sum = 0;
    for (const double share : cusps.at("shares")) {
        EXPECT_NEAR(share, 0.05, 0.015);
        sum += share;
    }
    EXPECT_NEAR(sum, 1, 1e-9);
    EXPECT_FALSE(nlohmann::json::parse(limn(ball).output).contains("cusps"));
}

// Checklist 1 of the procedural structures specification: large OBJ files, and faceted shading in the tests of pictures.
TEST_F(RenderPattern, Checklist1AFileOfMoreThan65535VerticesIsDrawnWithItsOwnCounts)
{
    // A ball whose 281 x 281 vertices come row by row: the last ones are those of its top.
    const int side = 281;
    std::string text;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const double down = std::numbers::pi * (1 - (row + 0.5) / side), around = 2 * std::numbers::pi * column / side;
            text += fmt::format("v {:.7f} {:.7f} {:.7f}\n", std::sin(down) * std::sin(around), std::cos(down),
                                std::sin(down) * std::cos(around));
        }
    for (int row = 0; row + 1 < side; ++row)
        for (int column = 0; column < side; ++column) {
            const int a = row * side + column + 1, b = row * side + (column + 1) % side + 1;
            text += fmt::format("f {} {} {}\nf {} {} {}\n", a, b, b + side, a, b + side, a + side);
        }
    write_text(path("ball.obj"), text);
    const int vertices = side * side, triangles = 2 * side * (side - 1);
    ASSERT_GT(vertices, 65535);
    const nlohmann::json mesh = nlohmann::json::parse(limn("info " + path("ball.obj") + " --quiet --json").output).at("mesh");
    EXPECT_EQ(mesh.at("vertices"), vertices);
    EXPECT_EQ(mesh.at("triangles"), triangles);
    const ProgramResult result = render(path("ball.obj"), "--material layers --layer-height 4mm --view front");
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_NE(result.errors.find("157,360 triangles"), std::string::npos) << result.errors;
    // As the generated ball, whose vertices are fewer: from its top, which has the last vertices, to its foot.
    const Image large = read_png(path("a.png"));
    ASSERT_EQ(limn("sample sphere --triangles 100000 --quiet -o " + path("small.obj")).exit_code, 0);
    ASSERT_EQ(render(path("small.obj"), "--material layers --layer-height 4mm --view front").exit_code, 0);
    const Image small = read_png(path("a.png"));
    int differ = 0;
    for (std::size_t i = 0; i < large.samples.size(); ++i)
        differ += std::abs(large.samples[i] - small.samples[i]) > 0.1f;
    EXPECT_LT(differ, int(large.samples.size() / 50));
}

// Checklist 2: what `limn render --material layers` does to a model without units.
TEST_F(RenderPattern, Checklist2AModelWithoutUnitsIs100MillimetresLongAndItsLowestPointIsInTheLowestLayer)
{
    // A wall 30 units wide and 20 high, far from the origin: 66.67 mm high, so 20 layers of 10/3 mm, in pixels of 1/10 layer.
    write_text(path("wall.obj"), "v 1000 507 -40\nv 1030 507 -40\nv 1030 527 -40\nv 1000 527 -40\nf 1 2 3 4\n");
    const std::string wall = "render " + path("wall.obj") +
                             " --quiet --samples 1 --size 300x200 --ortho --eye 1015,517,60 --look 1015,517,-40 --background '#ff00ff' "
                             "--light 0,0.6,1 --ground=no " +
                             "--variety 0 --material layers --layer-height 3.333333333 -o " + path("a.png");
    const ProgramResult result = limn(wall + " --json");
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const Image image = read_png(path("a.png"));
    // Grooves between layers are dark: where they are from the wall's foot on, which is the lowest row of it.
    std::vector<int> rows;
    for (int y = 0; y < image.height; ++y)
        if (image.at(150, y)[0] < 0.95f)
            rows.push_back(y);
    ASSERT_GT(rows.size(), 150u);
    const double layer = double(rows.size()) / 20;
    std::vector<double> grooves;
    for (std::size_t k = 1; k + 1 < rows.size(); ++k) {
        const auto tone = [&](std::size_t i) { return image.at(150, rows[i])[1]; };
        if (tone(k) <= tone(k - 1) && tone(k) < tone(k + 1))
            grooves.push_back((double(rows.back()) + 1 - rows[k] - 0.5) / layer);
    }
    ASSERT_EQ(grooves.size(), 19u) << "between 20 layers";
    for (std::size_t k = 0; k < grooves.size(); ++k)
        EXPECT_NEAR(grooves[grooves.size() - 1 - k], double(k + 1), 0.25) << "whole layers above the foot";
}

TEST_F(RenderPattern, BricksAndThreadAreDrawnWithEveryFilter)
{
    for (const std::string material : {"bricks", "thread"})
        for (const std::string filter : {"gauss", "box", "even", "seed", "none"})
            EXPECT_EQ(
                render(torus(), "--quiet --pattern-samples 4 --samples 4 --material " + material + " --pattern-filter " + filter).exit_code,
                0)
                << material << " " << filter;
}

TEST_F(RenderPattern, SceneFilesHoldEveryNumberOfAPattern)
{
    write_text(
        path("scene.json"),
        R"({"limn": 1, "objects": [{"file": "torus.obj"}], "pattern": {"material": "layers", "layer-height": 2, "print-direction": [1, 0, 0], "bead-bulge": 0.8}})");
    ASSERT_EQ(render(path("scene.json"), "").exit_code, 0);
    const std::string from_scene = read_text(path("a.png"));
    ASSERT_EQ(render(torus(), "--material layers --layer-height 2 --print-direction 1,0,0 --bead-bulge 0.8").exit_code, 0);
    EXPECT_EQ(read_text(path("a.png")), from_scene);
}

TEST_F(RenderPattern, ATableOfHeightsIsFollowed)
{
    write_text(path("same.txt"), "2\n2\n2\n");
    write_text(path("other.txt"), "0 1\n20 3\n");
    ASSERT_EQ(render(torus(), "--material layers --layer-height 2").exit_code, 0);
    const std::string even = read_text(path("a.png"));
    ASSERT_EQ(render(torus(), "--material layers --layer-heights " + path("same.txt")).exit_code, 0);
    const Image same = read_png(path("a.png"));
    ASSERT_EQ(render(torus(), "--material layers --layer-heights " + path("other.txt")).exit_code, 0);
    EXPECT_NE(read_text(path("a.png")), even);
    write_text(path("even.png"), even);
    const Image wanted = read_png(path("even.png"));
    int differ = 0;
    for (std::size_t i = 0; i < same.samples.size(); ++i)
        differ += std::abs(same.samples[i] - wanted.samples[i]) > 2.5f / 255;
    EXPECT_LT(differ, int(same.samples.size() / 1000));
}

TEST_F(RenderPattern, BadInputIsRefusedInOneLineAndNothingIsWritten)
{
    write_text(path("bad.txt"), "0.2\n0.2 x\n");
    expect_refusal("--material layers --layer-height 0", "--layer-height: 0 is outside 0.001..1000 mm");
    expect_refusal("--material layers --layer-height thick", "--layer-height: 'thick' is not a number");
    expect_refusal("--material layers --layer-height 500", "--layer-height: a layer of 500 mm is higher than the print, which is ");
    expect_refusal("--material layers --print-direction 0,0,0", "--print-direction: 0,0,0 is no direction");
    expect_refusal("--material layers --print-direction 1,2", "--print-direction: '1,2' is not up, x, y, z, -x, -y, -z or x,y,z");
    expect_refusal("--material layers --filament petg-balck", "there is no 'petg-balck'; did you mean 'petg-black'?");
    expect_refusal("--material layers --layer-heights " + path("bad.txt"), "bad.txt, line 2: 'x' is not a number");
    expect_refusal("--material layers --layer-heights " + path("bad.txt") + " --layer-height 1",
                   "--layer-heights and --layer-height both say how high layers are; give one");
    expect_refusal("--layer-height 1", "--layer-height is of prints; give --material layers too");
    expect_refusal("--material marble", "--material: 'marble' is none of plain|layers|bricks|thread");
    if (limn("render " + torus() + " --device gpu --size 8x6 -o " + path("g.png")).exit_code == 0) {
        expect_refusal("--material layers --device gpu --shadow ray",
                       "--device gpu: shadows, lights with a size and --ao are computed on the processor; leave the option out");
    }
}

} // namespace
} // namespace limn::test
