#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "command/command.h"

#include "limn/drawing/png.h"

namespace limn::test {
namespace {

using Json = nlohmann::json;

class Render : public WithTorus {
protected:
    ProgramResult render(const std::string& arguments) const
    {
        ProgramResult result = limn("render " + torus() + " --size 160x120 --quiet " + arguments);
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        return result;
    }
    Image picture(const std::string& name) const { return read_png(path(name)); }
};

TEST_F(Render, ShowsALitShapeOnItsBackground)
{
    render("-o " + path("a.png") + " --background '#102030' --surface-colour '#ffffff' --view front");
    const Image image = picture("a.png");
    ASSERT_EQ(image.size(), ivec2(160, 120));
    EXPECT_NEAR(image.at(0, 0)[0], 0x10 / 255.0, 1e-6);
    EXPECT_NEAR(image.at(0, 0)[2], 0x30 / 255.0, 1e-6);
    float brightest = 0;
    for (const float sample : image.samples)
        brightest = std::max(brightest, sample);
    EXPECT_GT(brightest, 0.95f) << "the headlight";
}

TEST_F(Render, LaysLinesOverThePicture)
{
    render("-o " + path("bare.png"));
    render("-o " + path("lines.png") + " --lines contour");
    const Image bare = picture("bare.png"), lines = picture("lines.png");
    std::size_t darker = 0, brighter = 0;
    for (std::size_t i = 0; i < bare.samples.size(); ++i) {
        darker += lines.samples[i] < bare.samples[i] - 0.3f;
        brighter += lines.samples[i] > bare.samples[i] + 0.01f;
    }
    EXPECT_GT(darker, 300u);
    EXPECT_EQ(brighter, 0u);
}

TEST_F(Render, SixteenBitsHoldMoreThanEight)
{
    render("-o " + path("8.png"));
    render("-o " + path("16.png") + " --bits 16 --lines contour");
    EXPECT_EQ(read_text(path("8.png"))[24], 8);
    EXPECT_EQ(read_text(path("16.png"))[24], 16);
    std::set<float> tones;
    const Image image = picture("16.png");
    for (std::size_t i = 0; i < image.samples.size(); i += 3)
        tones.insert(image.samples[i]);
    EXPECT_GT(tones.size(), 1000u) << "shading in steps of 1/255 has at most 256";
}

TEST_F(Render, WritesPassesWithTheirScales)
{
    for (const std::string format : {"png", "exr"}) {
        render("-o " + path("data." + format) + " --pass all");
        const Json scales = Json::parse(read_text(path("data-passes.json")));
        ASSERT_EQ(scales["passes"].size(), 9u); // no lines are drawn
        for (const auto& [name, scale] : scales["passes"].items()) {
            EXPECT_EQ(scale["file"], "data-" + name + "." + format);
            EXPECT_TRUE(std::filesystem::exists(path(scale["file"]))) << name;
            EXPECT_LT(scale["low"], scale["high"].get<double>() + (name == "id" ? 1 : 0)) << name;
        }
        EXPECT_EQ(scales["passes"]["dwkr"]["unit"], "1/length^2");
        EXPECT_EQ(scales["camera"]["size"], Json::array({160, 120}));
    }
    EXPECT_EQ(read_text(path("data-normal.png"))[24], 16);
}

TEST_F(Render, WritesTheLinesAsAPassOfTheirOwn)
{
    render("-o " + path("l.png") + " --lines contour --pass lines --background '#000000' --surface-colour '#000000'");
    const Json scales = Json::parse(read_text(path("l-passes.json")));
    EXPECT_EQ(scales["passes"]["lines"]["low"], 0);
    EXPECT_EQ(scales["passes"]["lines"]["high"], 1);
    render("-o " + path("white.png") + " --lines contour --background '#ffffff' --surface-colour '#ffffff' --unlit 1");
    const Image lines = picture("l-lines.png"), white = picture("white.png");
    std::size_t inked = 0;
    for (int y = 0; y < lines.height; ++y)
        for (int x = 0; x < lines.width; ++x) {
            const float cover = (lines.at(x, y)[0] * 65535 - 1) / 65534;
            inked += cover > 0.5f;
            ASSERT_NEAR(cover, 1 - white.at(x, y)[0], 2.0f / 255) << x << "," << y;
        }
    EXPECT_GT(inked, 200u);
}

// Faces at NaN vertices are dropped when the file is read; the rest is a picture, and the warning counts them.
TEST_F(Render, DrawsWhatIsLeftOfAModelWithNan)
{
    write_text(path("nan.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 1 0\nf 1 2 3\nf 2 4 3\n");
    for (const std::string device : {"cpu", "gpu"}) {
        const ProgramResult result = limn("render " + path("nan.obj") + " --size 80x60 --view front --device " + device + " -o " + path("nan-" + device + ".png"));
        if (result.errors.find("no GPU driver") != std::string::npos)
            continue;
        ASSERT_EQ(result.exit_code, 0) << result.errors;
        EXPECT_NE(result.errors.find("NaN"), std::string::npos) << result.errors;
        const Image image = picture("nan-" + device + ".png");
        std::size_t shown = 0;
        for (const float sample : image.samples)
            shown += sample < 0.95f;
        EXPECT_GT(shown, 300u) << device;
    }
}

TEST_F(Render, MakesAPictureForEachCameraOfAList)
{
    const std::string report = render("--json --view front --device cpu").output;
    EXPECT_EQ(Json::parse(report)["device"], "processor");
    Json camera = Json::parse(report)["views"][0]["camera"], list = Json::array();
    for (int i = 0; i < 3; ++i) {
        camera["size"] = {40 + i, 30};
        list.push_back(camera);
    }
    write_text(path("cameras.json"), list.dump());
    render("--cameras " + path("cameras.json") + " -o " + path("v.png") + " --pass depth");
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(picture("v-00" + std::to_string(i) + ".png").width, 40 + i);
        EXPECT_TRUE(std::filesystem::exists(path("v-00" + std::to_string(i) + "-depth.png")));
    }
    camera.erase("eye");
    list.push_back(camera);
    write_text(path("cameras.json"), list.dump());
    const ProgramResult bad = limn("render " + torus() + " --cameras " + path("cameras.json") + " -o " + path("w.png"));
    EXPECT_NE(bad.exit_code, 0);
    EXPECT_NE(bad.errors.find("cameras.json: entry 3: camera: 'eye' is missing"), std::string::npos) << bad.errors;
    EXPECT_FALSE(std::filesystem::exists(path("w-000.png")));
}

TEST_F(Render, IsTheSameTwiceAndForAnyNumberOfThreads)
{
    const std::string options = " --lines illustration --shading toon --light 1,2,3 --pass kr,normal -o ";
    render("--threads 1" + options + path("one.png"));
    render("--threads 2" + options + path("two.png"));
    for (const char* part : {"", "-kr", "-normal"})
        EXPECT_EQ(read_text(path(std::string("one") + part + ".png")), read_text(path(std::string("two") + part + ".png"))) << part;
}

TEST_F(Render, RefusesWhatContradictsItself)
{
    const auto refused = [&](const std::string& arguments, const std::string& word) {
        const ProgramResult result = limn("render " + torus() + " " + arguments);
        EXPECT_EQ(result.exit_code, 2) << arguments;
        EXPECT_NE(result.errors.find(word), std::string::npos) << result.errors;
        EXPECT_EQ(line_count(result.errors), 1) << result.errors;
    };
    refused("-o " + path("a.png") + " --light 1,2,3 --lamp 4,5,6", "light");
    refused("-o " + path("a.png") + " --pass cheese", "cheese");
    refused("-o - --to png --pass kr", "--pass");
    refused("-o " + path("a.png") + " --pass kr,lines", "--lines");
    refused("-o " + path("a.png") + " --page A4", "--page");
    refused("-o " + path("a.svg"), "svg");
    refused("-o " + path("a.png") + " --view front --view top --pass kr", "--view");
    refused("-o " + path("a.png") + " --light 0,0,0", "direction");
    refused("-o " + path("a.png") + " --turntable 3 --cameras x.json", "--cameras");
    EXPECT_FALSE(std::filesystem::exists(path("a.png")));
}

TEST_F(Render, FindsLinesPerPixelOnBothDevicesAlike)
{
    render("-o " + path("bare.png"));
    const Image bare = picture("bare.png");
    for (const std::string method : {"--ground --lamp 3,4,5", "--image-lines threshold", "--image-lines depth-raw", "--image-lines depth", "--image-lines valley-printed",
                                     "--image-lines valley", "--shader-lines width", "--shader-lines texture"}) {
        render("-o " + path("cpu.png") + " " + method);
        const Image cpu = picture("cpu.png");
        std::size_t darker = 0;
        for (std::size_t i = 0; i < cpu.samples.size(); ++i)
            darker += cpu.samples[i] < bare.samples[i] - 0.1f;
        EXPECT_GT(darker, 200u) << method;
        const ProgramResult gpu = limn("render " + torus() + " --size 160x120 --device gpu -o " + path("gpu.png") + " " + method);
        if (gpu.exit_code == 1 && gpu.errors.find("no GPU driver") != std::string::npos)
            continue;
        ASSERT_EQ(gpu.exit_code, 0) << gpu.errors;
        const Image other = picture("gpu.png");
        std::size_t differ = 0;
        for (std::size_t i = 0; i < cpu.samples.size(); ++i)
            differ += std::abs(cpu.samples[i] - other.samples[i]) > 2.0f / 255;
        EXPECT_LE(differ, cpu.samples.size() / 200) << method; // the shader's edges fall on other samples
    }
}

TEST_F(Render, TakesTheProcessorWhereThereIsNoDriver)
{
    const std::string command = "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent '" LIMN_COMMAND "' render '" + torus() + "' --size 160x120 -o ";
    EXPECT_EQ(run_shell(command + path("auto.png")).exit_code, 0);
    render("-o " + path("cpu.png") + " --device cpu");
    EXPECT_EQ(read_text(path("auto.png")), read_text(path("cpu.png")));
}

TEST_F(Render, SaysThatThereIsNoDriver)
{
    const ProgramResult result = run_shell("__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent '" LIMN_COMMAND "' render '" + torus() + "' --device gpu --image-lines depth -o " + path("x.png"));
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(line_count(result.errors), 1) << result.errors;
    EXPECT_NE(result.errors.find("OpenGL 4.5"), std::string::npos) << result.errors;
    EXPECT_FALSE(std::filesystem::exists(path("x.png")));
}

TEST_F(Render, PutsSeveralViewsOnOneSheet)
{
    render("-o " + path("sheet.png") + " --view front --view top --view right --view iso");
    const Image sheet = picture("sheet.png");
    EXPECT_EQ(sheet.size(), ivec2(160, 120));
    std::size_t shown = 0;
    for (std::size_t i = 0; i < sheet.samples.size(); i += 3)
        shown += sheet.samples[i] < 0.8f;
    EXPECT_GT(shown, 1000u);
}

} // namespace
} // namespace limn::test
