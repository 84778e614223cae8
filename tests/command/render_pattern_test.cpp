// `limn render --material`: prints, bricks and thread.

#include <gtest/gtest.h>

#include "command/command.h"

#include "limn/drawing/png.h"

namespace limn::test {
namespace {

class RenderPattern : public WithTorus {
protected:
    ProgramResult render(const std::string& model, const std::string& arguments) const { return limn("render " + model + " --size 120x90 -o " + path("a.png") + " " + arguments); }
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
    EXPECT_NE(ply.errors.find("layers of 0.5 mm, the longest side taken as 100 mm (--units tells otherwise)"), std::string::npos) << ply.errors;
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
    const ProgramResult result = limn("render " + torus() + " --size 400x300 --background '#ffffff' -o " + path("a.png") + " --material layers --layer-height 1mm --show cusp");
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_NE(result.errors.find("cusps to 1 mm, mean 0."), std::string::npos) << result.errors;
    const Image image = read_png(path("a.png"));
    int coloured = 0; // in the corner of the legend
    for (int y = 200; y < 290; ++y)
        for (int x = 10; x < 140; ++x)
            coloured += std::abs(image.at(x, y)[0] - image.at(x, y)[2]) > 0.2f;
    EXPECT_GT(coloured, 500);
}

TEST_F(RenderPattern, BricksAndThreadAreDrawnWithEveryFilter)
{
    for (const std::string material : {"bricks", "thread"})
        for (const std::string filter : {"gauss", "box", "even", "seed", "none"})
            EXPECT_EQ(render(torus(), "--quiet --pattern-samples 4 --samples 4 --material " + material + " --pattern-filter " + filter).exit_code, 0) << material << " " << filter;
}

TEST_F(RenderPattern, SceneFilesHoldEveryNumberOfAPattern)
{
    write_text(path("scene.json"), R"({"limn": 1, "objects": [{"file": "torus.obj"}], "pattern": {"material": "layers", "layer-height": 2, "print-direction": [1, 0, 0], "bead-bulge": 0.8}})");
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
    expect_refusal("--material layers --layer-heights " + path("bad.txt") + " --layer-height 1", "--layer-heights and --layer-height both say how high layers are; give one");
    expect_refusal("--layer-height 1", "--layer-height is of prints; give --material layers too");
    expect_refusal("--material marble", "--material: 'marble' is none of plain|layers|bricks|thread");
    if (limn("render " + torus() + " --device gpu --size 8x6 -o " + path("g.png")).exit_code == 0) {
        expect_refusal("--material layers --device gpu --shadow ray", "--device gpu: shadows, lights with a size and --ao are computed on the processor; leave the option out");
    }
}

} // namespace
} // namespace limn::test
