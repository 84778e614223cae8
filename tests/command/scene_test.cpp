#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "command/command.h"
#include "limn/drawing/png.h"

namespace limn::test {
namespace {

using Json = nlohmann::ordered_json;

/// A folder with a torus, a sphere and a scene of both: the torus on the left, the sphere on the right, in colours of their own.
class SceneFile : public WithTorus {
protected:
    SceneFile()
    {
        write_text(folder_ / "ball.obj", shape_obj("sphere", 2000));
        scene_ = {{"limn", 1},
                  {"objects",
                   {{{"file", "torus.obj"}, {"name", "ring"}, {"translate", {-1.5, 0, 0}}, {"material", {{"colour", "#ff0000"}}}},
                    {{"file", "ball.obj"}, {"translate", {1.5, 0, 0}}, {"scale", 0.8}, {"material", {{"colour", "#0000ff"}}}}}},
                  {"camera", {{"view", "front"}, {"size", {160, 120}}}}};
        save();
    }
    void save() const { write_text(folder_ / "scene.json", scene_.dump()); }
    std::string scene() const { return path("scene.json"); }

    ProgramResult run(const std::string& arguments) const
    {
        ProgramResult result = limn(arguments);
        EXPECT_EQ(result.exit_code, 0) << arguments << "\n" << result.errors;
        return result;
    }
    void render(const std::string& name, const std::string& options = "") const { run("render " + scene() + " --quiet -o " + path(name) + " " + options); }
    bool same_files(const std::string& a, const std::string& b) const { return read_text(folder_ / a) == read_text(folder_ / b); }
    /// Expects `limn COMMAND scene.json OPTIONS` to fail in one line that holds `part`, and to write nothing.
    void expect_refused(const std::string& command, const std::string& options, int code, const std::string& part) const
    {
        const ProgramResult result = limn(command + " " + scene() + " " + options + " -o " + path("refused.png"));
        EXPECT_EQ(result.exit_code, code) << result.errors;
        EXPECT_EQ(line_count(result.errors), 1) << result.errors;
        EXPECT_NE(result.errors.find(part), std::string::npos) << result.errors;
        EXPECT_FALSE(exists("refused.png"));
    }

    Json scene_;
};

/// How many pixels have more of one channel than of another, by half of the range.
std::size_t tinted(const Image& image, int more, int less)
{
    std::size_t count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            count += image.at(x, y)[more] > image.at(x, y)[less] + 0.5f;
    return count;
}

TEST_F(SceneFile, IsRenderedWithItsObjectsWhereTheyStandInTheirColours)
{
    render("a.png");
    const Image image = read_png(path("a.png"));
    ASSERT_EQ(image.size(), ivec2(160, 120));
    EXPECT_GT(tinted(image, 0, 2), 500u);
    EXPECT_GT(tinted(image, 2, 0), 500u);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (image.at(x, y)[0] > image.at(x, y)[2] + 0.5f) {
                EXPECT_LT(x, 90) << "the ring is on the left";
            }
}

TEST_F(SceneFile, IsDrawnAndReportedWithItsObjects)
{
    const Json report = Json::parse(run("draw " + scene() + " --json --quiet -o " + path("a.svg")).output);
    ASSERT_EQ(report["inputs"].size(), 2u);
    EXPECT_EQ(report["inputs"][0]["name"], "ring");
    EXPECT_EQ(report["inputs"][0]["matrix"], Json::parse("[1,0,0,-1.5, 0,1,0,0, 0,0,1,0, 0,0,0,1]"));
    EXPECT_NEAR(report["inputs"][1]["low"][0].get<double>(), 0.7, 0.01);
    EXPECT_NEAR(report["inputs"][1]["high"][1].get<double>(), 0.8, 0.01);
    EXPECT_GT(report["views"][0]["types"]["contour"]["strokes"], 2);
    run("draw " + scene() + " --quiet -o " + path("flat.png"));
    run("draw " + scene() + " --shade smooth --quiet -o " + path("shaded.png"));
    EXPECT_EQ(tinted(read_png(path("flat.png")), 0, 2), 0u);
    EXPECT_GT(tinted(read_png(path("shaded.png")), 0, 2), 500u) << "its materials count where surfaces are shaded";
}

TEST_F(SceneFile, WithoutAMaterialATransformOrAViewIsThePictureOfItsModels)
{
    scene_ = {{"limn", 1}, {"objects", {{{"file", "torus.obj"}}, {{"file", "ball.obj"}}}}};
    save();
    for (const std::string command : {"render", "draw"}) {
        run(command + " " + scene() + " --size 160x120 --quiet -o " + path("scene.png"));
        run(command + " " + torus() + " " + path("ball.obj") + " --size 160x120 --quiet -o " + path("models.png"));
        EXPECT_TRUE(same_files("scene.png", "models.png")) << command;
    }
}

TEST_F(SceneFile, WhatTheCommandLineSaysCounts)
{
    scene_["lines"] = {{"lines", "contour"}};
    scene_["style"] = {{"curves", false}, {"style", "coloured"}};
    scene_["render"] = {{"shading", "toon"}, {"background", "#00ff00"}, {"ground", true}};
    scene_["lights"] = {{{"kind", "lamp"}, {"place", {0, 9, 0}}}};
    scene_["image-lines"] = {{"image-lines", "depth"}};
    save();
    render("scene.png");
    // All of it said on the command line of a scene without it, or taken back on that of the scene.
    const Json whole = scene_;
    for (const char* key : {"lines", "style", "render", "lights", "image-lines", "camera"})
        scene_.erase(key);
    save();
    const std::string view = " --view front --size 160x120", shade = " --shading toon --background '#00ff00' --ground --lamp 0,9,0 --image-lines depth";
    render("said.png", view + shade + " --lines contour --curves=no --style coloured");
    EXPECT_TRUE(same_files("scene.png", "said.png"));
    render("plain.png", view + " --lines outline --light 1,2,3");
    scene_ = whole;
    save();
    render("back.png", "--shading smooth --background '#ffffff' --ground=no --light 1,2,3 --image-lines none --lines outline --curves --style plain");
    EXPECT_TRUE(same_files("plain.png", "back.png"));
    EXPECT_FALSE(same_files("plain.png", "said.png"));
}

TEST_F(SceneFile, HasAPageForDrawingsThatPicturesDoNotLookAt)
{
    scene_["lines"] = {{"lines", "contour"}};
    save();
    render("without.png");
    scene_["style"] = {{"page", "A5"}};
    save();
    render("with.png");
    EXPECT_TRUE(same_files("without.png", "with.png"));
    run("draw " + scene() + " --quiet -o " + path("page.svg"));
    EXPECT_NE(read_text(path("page.svg")).find("210mm"), std::string::npos);
}

TEST_F(SceneFile, ACameraOfTheCommandLineReplacesTheScenes)
{
    const auto camera_of = [&](const std::string& options) {
        return Json::parse(run("draw " + scene() + " --json --quiet " + options).output)["views"][0]["camera"];
    };
    scene_["camera"] = {{"eye", {0, 0, 9}}, {"look", {0, 0, 0}}, {"size", {80, 60}}};
    save();
    EXPECT_EQ(camera_of("")["eye"], Json::parse("[0.0, 0.0, 9.0]"));
    EXPECT_EQ(camera_of("")["size"], Json::parse("[80, 60]"));
    EXPECT_EQ(camera_of("--size 40x30")["size"], Json::parse("[40, 30]"));
    EXPECT_EQ(camera_of("--eye 5,0,0")["eye"], Json::parse("[5.0, 0.0, 0.0]"));
    EXPECT_EQ(camera_of("--eye 5,0,0")["size"], Json::parse("[80, 60]"));
    EXPECT_GT(camera_of("--view top")["eye"][1], 1);
    scene_["camera"] = {{"view", "right"}, {"fov_degrees", 12}};
    save();
    EXPECT_GT(camera_of("")["eye"][0], 1);
    EXPECT_EQ(camera_of("")["fov_degrees"], 12.0);
    EXPECT_EQ(camera_of("--view top --fov 20")["fov_degrees"], 20.0);
    EXPECT_EQ(camera_of("--view top")["fov_degrees"], 12.0);
}

TEST_F(SceneFile, RefusesWhatDoesNotGoTogether)
{
    expect_refused("render", torus(), 2, "scene.json is a scene and stands alone");
    expect_refused("render", "--up 1,0,0", 2, "--look and --up need --eye");
    scene_["camera"] = {{"eye", {0, 0, 9}}, {"look", {0, 0, 0}}};
    save();
    for (const std::string option : {"--fov 20", "--ortho", "--scale 1:2"})
        expect_refused("draw", option, 2, option.substr(0, option.find(' ')) + ": the scene holds the whole camera");
    expect_refused("render", "--page A4", 2, "--page");
}

TEST_F(SceneFile, ABadSceneIsOneLineAndExitCodeOne)
{
    scene_["objects"][1]["material"]["colour"] = 3;
    save();
    for (const std::string command : {"render", "draw"}) {
        expect_refused(command, "", 1, "limn: " + scene() + ": objects[1].material.colour: expected \"#rrggbb\", found 3\n");
    }
    scene_["objects"][1] = {{"file", "nothing.obj"}};
    save();
    expect_refused("render", "", 1, "limn: " + scene() + ": objects[1].file: there is no file \"nothing.obj\"\n");
    write_text(folder_ / "broken.obj", "v 0 0\n");
    scene_["objects"][1] = {{"file", "broken.obj"}};
    save();
    expect_refused("render", "", 1, "limn: " + path("broken.obj") + ": line 1");
    write_text(folder_ / "scene.json", R"({"limn": "0.1.0", "command": "draw"})");
    expect_refused("render", "", 1, "limn: expected 1, the version of scene files that this Limn reads, found \"0.1.0\"");
}

TEST_F(SceneFile, CutAndChangedScenesNeverCrashTheCommand)
{
    scene_["lights"] = {{{"kind", "distant"}, {"direction", {1, 2, 3}}}};
    scene_["render"] = {{"shading", "toon"}, {"samples", 2}};
    scene_["camera"]["size"] = {16, 12};
    const std::string whole = scene_.dump();
    std::mt19937 random(5);
    int refused = 0;
    for (int i = 0; i < 60; ++i) {
        std::string text = i % 2 ? whole : whole.substr(0, random() % whole.size());
        if (i % 2)
            text[random() % text.size()] ^= char(1 << random() % 7);
        write_text(folder_ / "scene.json", text);
        const ProgramResult result = limn("render " + scene() + " --quiet --size 16x12 -o " + path("fuzz.png"));
        ASSERT_TRUE(result.exit_code == 0 || result.exit_code == 1) << text << "\n" << result.errors;
        EXPECT_EQ(line_count(result.errors), result.exit_code) << text << "\n" << result.errors;
        refused += result.exit_code;
    }
    EXPECT_GT(refused, 40);
}

TEST_F(SceneFile, IsTheSameForAnyNumberOfThreads)
{
    scene_["lines"] = {{"lines", "illustration"}};
    save();
    render("one.png", "--threads 1");
    render("four.png", "--threads 4");
    EXPECT_TRUE(same_files("one.png", "four.png"));
}

TEST_F(SceneFile, OfStandardInputNamesFilesFromTheWorkingFolder)
{
    const ProgramResult result = run_shell("cd '" + folder_.path().string() + "' && '" LIMN_COMMAND "' render - --from json --quiet -o in.png < scene.json");
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    render("file.png");
    EXPECT_TRUE(same_files("in.png", "file.png"));
}

TEST_F(SceneFile, AFileShownTwiceIsReadOnceAndComplainedOfOnce)
{
    const Mesh sheet = make_shape({.name = "plane", .triangles = 200}).mesh;
    write_text(folder_ / "sheet.obj", obj_text(sheet));
    scene_["objects"] = {{{"file", "sheet.obj"}}, {{"file", "sheet.obj"}, {"translate", {0, 0, 1}}}};
    save();
    const ProgramResult once = limn("draw " + path("sheet.obj") + " --quiet -o " + path("a.svg")), twice = limn("draw " + scene() + " --quiet -o " + path("b.svg"));
    EXPECT_EQ(once.errors, twice.errors);
    EXPECT_EQ(twice.exit_code, 0);
}

} // namespace
} // namespace limn::test
