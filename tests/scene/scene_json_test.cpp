#include <gtest/gtest.h>

#include "limn/scene/scene_json.h"

#include <algorithm>
#include <random>
#include <regex>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "limn/base/error.h"
#include "support/support.h"

namespace limn {
namespace {

using Json = nlohmann::ordered_json;

/// A folder with a file that scenes can name; its content is not looked at here.
class SceneJson : public testing::Test {
protected:
    SceneJson() { test::write_text(folder_ / "a.ply", ""); }

    Scene scene(const std::string& text) const { return scene_from_json(text, folder_ / "scene.json"); }
    /// What reading a text is refused with, after the name of the file; "" where it is not.
    std::string refusal(const std::string& text) const
    {
        const std::string file = (folder_ / "scene.json").string() + ": ";
        try {
            scene(text);
            return "";
        } catch (const Error::Read& error) {
            const std::string message = error.what();
            EXPECT_EQ(message.rfind(file, 0), 0u) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            return message.substr(std::min(file.size(), message.size()));
        }
    }
    /// The same for a scene of one object to which `more` is added: `"lights": []`.
    std::string refusal_with(const std::string& more) const { return refusal(R"({"limn": 1, "objects": [{"file": "a.ply"}], )" + more + "}"); }
    std::string refusal_of_object(const std::string& more) const { return refusal(R"({"limn": 1, "objects": [{"file": "a.ply", )" + more + "}]}"); }

    test::TemporaryFolder folder_;
};

/// Says something about everything.
constexpr const char* whole_scene = R"({
  "limn": 1,
  "materials": {"clay": {"colour": "#c87f5a"}, "slate": {"colour": "#334455", "unlit": 0.5}},
  "objects": [
    {"name": "left", "file": "a.ply", "translate": [1, 2, 3], "rotate": {"axis": [0, 0, 2], "degrees": 90}, "scale": 2, "material": "clay"},
    {"file": "a.ply", "from": "ply", "matrix": [1, 0, 0, 5, 0, 0, -1, 6, 0, 1, 0, 7, 0, 0, 0, 1], "material": {"colour": "#00ff00"}},
    {"file": "a.ply", "rotate": [90, 0, 90]}
  ],
  "lights": [{"kind": "lamp", "place": [1, 2, 3]}],
  "camera": {"view": "30,20", "size": [640, 480], "up_axis": "z", "fov_degrees": 20, "orthographic": true},
  "surface": {"curvature-radius": 3, "smooth": 2},
  "lines": {"lines": ["contour", "suggestive"], "crease-angle": 30, "feature-size": 0.5, "hidden": "dash"},
  "style": {"colour": {"contour": "#112233"}, "style": "coloured", "width": 0.7, "curves": false, "page": "A4"},
  "render": {"shading": "toon", "toon-levels": 3, "bits": 16, "background": "#102030"},
  "image-lines": {"image-lines": "depth", "step-limit": 0.02}
})";

vec3 bytes(int r, int g, int b) { return vec3(float(r), float(g), float(b)) / 255.0f; }

TEST_F(SceneJson, ReadsEveryPartOfAScene)
{
    const Scene s = scene(whole_scene);
    ASSERT_EQ(s.objects.size(), 3u);
    EXPECT_EQ(s.objects[0].name, "left");
    EXPECT_EQ(s.objects[0].file, folder_ / "a.ply");
    EXPECT_EQ(s.objects[1].format, "ply");
    const std::vector<Material> materials = object_materials(s, {vec3(1), 1});
    EXPECT_EQ(materials[0].colour, bytes(0xc8, 0x7f, 0x5a));
    EXPECT_EQ(materials[0].unlit, Material().unlit);
    EXPECT_EQ(materials[1].colour, bytes(0, 255, 0));
    EXPECT_EQ(materials[2], (Material{vec3(1), 1}));
    EXPECT_EQ(s.materials.at("slate").unlit, 0.5f);
    ASSERT_EQ(s.lights.size(), 1u);
    EXPECT_EQ(std::get<Lamp>(s.lights[0]).place, dvec3(1, 2, 3));
    EXPECT_EQ(s.view.view, "30,20");
    EXPECT_EQ(s.view.size, ivec2(640, 480));
    EXPECT_EQ(s.view.up_axis, 'z');
    EXPECT_EQ(s.view.fov_degrees, 20);
    EXPECT_TRUE(s.view.orthographic);
    EXPECT_EQ(s.surface.radius, 3);
    EXPECT_EQ(s.surface.smooth, 2);
    EXPECT_EQ(s.lines.lines, (std::vector{LineType::suggestive, LineType::contour}));
    EXPECT_EQ(s.lines.crease_angle, 30);
    EXPECT_EQ(s.lines.feature_size.length, 0.5);
    EXPECT_EQ(s.lines.hidden, Hidden::dash);
    EXPECT_EQ(s.style.look, Look::coloured);
    EXPECT_EQ(s.style.line(LineType::contour).colour, bytes(0x11, 0x22, 0x33)) << "the look is set first, wherever it stands";
    EXPECT_EQ(s.style.line(LineType::border).width_mm, 0.7);
    EXPECT_FALSE(s.style.curves);
    EXPECT_EQ(s.style.page.width_mm, 210);
    EXPECT_EQ(s.render.shading, Shading::toon);
    EXPECT_EQ(s.render.toon_levels, 3);
    EXPECT_EQ(s.render.bits, 16);
    EXPECT_EQ(s.render.background, bytes(0x10, 0x20, 0x30));
    EXPECT_EQ(s.image_lines.method, ImageMethod::depth);
    EXPECT_EQ(s.image_lines.step, 0.02f);
}

void expect_maps(const dmat4& transform, const dvec3& from, const dvec3& to)
{
    const dvec3 found = dvec3(transform * dvec4(from, 1));
    EXPECT_LT(glm::distance(found, to), 1e-12) << found.x << " " << found.y << " " << found.z;
}

TEST_F(SceneJson, ScalesThenTurnsThenMoves)
{
    const Scene s = scene(whole_scene);
    expect_maps(s.objects[0].transform, {1, 0, 0}, {1, 4, 3});
    expect_maps(s.objects[0].transform, {0, 1, 5}, {-1, 2, 13});
    expect_maps(s.objects[1].transform, {1, 2, 3}, {6, 3, 9}); // rows of the matrix
    expect_maps(s.objects[2].transform, {0, 1, 0}, {0, 0, 1}); // around x, then around z
    expect_maps(s.objects[2].transform, {0, 0, 1}, {1, 0, 0});
}

TEST_F(SceneJson, ASceneSurvivesBeingWrittenAndRead)
{
    const Scene first = scene(whole_scene);
    const std::string text = scene_to_json(first, folder_.path());
    const Scene second = scene(text);
    EXPECT_EQ(scene_to_json(second, folder_.path()), text);
    for (std::size_t i = 0; i < first.objects.size(); ++i) {
        EXPECT_EQ(second.objects[i].transform, first.objects[i].transform) << i;
        EXPECT_EQ(second.objects[i].file, first.objects[i].file) << i;
        EXPECT_EQ(second.objects[i].material, first.objects[i].material) << i;
        EXPECT_EQ(second.objects[i].name, first.objects[i].name) << i;
    }
    EXPECT_EQ(second.materials, first.materials);
    EXPECT_EQ(std::get<Lamp>(second.lights.at(0)).place, dvec3(1, 2, 3));
    EXPECT_EQ(second.view.size, first.view.size);
    const auto same = [](const auto& table, const auto& a, const auto& b) {
        for (const auto& row : table)
            EXPECT_EQ(row.get(a), row.get(b)) << row.name;
    };
    same(line_option_table(), first.lines, second.lines);
    same(style_option_table(), first.style, second.style);
    same(render_option_table(), first.render, second.render);
    same(estimate_option_table(), first.surface, second.surface);
    same(image_line_option_table(), first.image_lines, second.image_lines);
    EXPECT_EQ(Json::parse(text)["objects"][0]["file"], "a.ply") << "from the scene's folder";
}

/// Values that are allowed and not the usual ones.
std::string another_value(OptionKind kind, const std::string& name, const std::string& range, const std::string& usual)
{
    static const std::map<std::string, std::string> of_text = {{"lines", "outline,contour"}, {"feature-size", "2.5"}, {"curvature-radius", "4"},
                                                               {"page", "A3"}, {"width", "0.6mm"}, {"colour", "#010203"}};
    switch (kind) {
    case OptionKind::number: return range.ends_with("..1") || range.ends_with("..0.999") ? "0.625" : "3.5";
    case OptionKind::whole: return std::to_string(std::stoi(range) + (std::to_string(std::stoi(range) + 3) == usual ? 4 : 3));
    case OptionKind::yes_no: return usual == "yes" ? "no" : "yes";
    case OptionKind::yes_no_number: return "0.125";
    case OptionKind::colour: return "#123456";
    case OptionKind::vector: return "1,2,3";
    case OptionKind::choice: {
        const std::string last = range.substr(range.rfind('|') + 1);
        return last == usual ? range.substr(0, range.find('|')) : last;
    }
    default: return of_text.at(name);
    }
}

/// Sets each row of a table through the scene file and expects the value in the scene.
template <class Options> void every_row_is_a_key(const char* section, const OptionTable<Options>& table, Options Scene::*member,
                                                 const std::filesystem::path& folder)
{
    for (const OptionRow<Options>& row : table) {
        if (row.name == "light" || row.name == "lamp")
            continue;
        Scene scene;
        scene.objects.emplace_back().file = folder / "a.ply";
        row.set(scene.*member, another_value(row.kind, row.name, row.range, row.get(Options())));
        const std::string text = scene_to_json(scene, folder);
        ASSERT_TRUE(Json::parse(text)[section].contains(row.name)) << text;
        EXPECT_EQ(row.get(scene_from_json(text, folder / "scene.json").*member), row.get(scene.*member)) << row.name;
    }
}

TEST_F(SceneJson, EveryRowOfEveryTableIsAKey)
{
    every_row_is_a_key("lines", line_option_table(), &Scene::lines, folder_.path());
    every_row_is_a_key("style", style_option_table(), &Scene::style, folder_.path());
    every_row_is_a_key("render", render_option_table(), &Scene::render, folder_.path());
    every_row_is_a_key("surface", estimate_option_table(), &Scene::surface, folder_.path());
    every_row_is_a_key("shader-lines", shader_line_option_table(), &Scene::shader_lines, folder_.path());
    every_row_is_a_key("image-lines", image_line_option_table(), &Scene::image_lines, folder_.path());
    every_row_is_a_key("subdivision", subdivision_option_table(), &Scene::subdivision, folder_.path());
}

TEST_F(SceneJson, LightsOfTheRenderOptionsAreWrittenAsLights)
{
    Scene s = scene(R"({"limn": 1, "objects": [{"file": "a.ply"}]})");
    s.render.light = dvec3(1, 2, 3);
    EXPECT_EQ(std::get<DistantLight>(scene(scene_to_json(s)).lights.at(0)).direction, dvec3(1, 2, 3));
    s.render.light.reset();
    s.render.lamp = dvec3(4, 5, 6);
    EXPECT_EQ(std::get<Lamp>(scene(scene_to_json(s)).lights.at(0)).place, dvec3(4, 5, 6));
    s.render.wide = SphereLight{{1, 2, 3}, 4};
    EXPECT_EQ(std::get<SphereLight>(scene(scene_to_json(s)).lights.at(0)).radius, 4);
    s.render.wide = RectangleLight{{1, 2, 3}, {4, 5}, dvec3(6, 7, 8)};
    EXPECT_EQ(std::get<RectangleLight>(scene(scene_to_json(s)).lights.at(0)).towards, dvec3(6, 7, 8));
    s.lights = {Headlight()};
    EXPECT_FALSE(lit_by(s.lights, s.render).wide) << "the list counts";
    EXPECT_TRUE(std::holds_alternative<Headlight>(scene(scene_to_json(s)).lights.at(0)));
    EXPECT_FALSE(lit_by(s.lights, s.render).lamp) << "the list counts";
}

TEST_F(SceneJson, LightsWithASizeAreRead)
{
    const auto light = [&](const std::string& text) { return scene(R"({"limn": 1, "objects": [{"file": "a.ply"}], "lights": [)" + text + "]}"); };
    const Scene ball = light(R"({"kind": "sphere", "place": [1, 2, 3], "radius": 0.5})");
    EXPECT_EQ(std::get<SphereLight>(*lit_by(ball.lights, ball.render).wide).centre, dvec3(1, 2, 3));
    const Scene rectangle = light(R"({"kind": "rectangle", "place": [1, 2, 3], "size": [2, 1]})");
    EXPECT_EQ(std::get<RectangleLight>(*lit_by(rectangle.lights, rectangle.render).wide).size, dvec2(2, 1));
    EXPECT_FALSE(std::get<RectangleLight>(rectangle.lights.at(0)).towards);
    const Scene picture = light(R"({"kind": "environment", "file": "a.ply"})");
    EXPECT_EQ(Json::parse(scene_to_json(picture, folder_.path()))["lights"][0]["file"], "a.ply");
    const Scene open = scene(R"({"limn": 1, "objects": [{"file": "a.ply"}], "render": {"ao": true, "shadow": "ray", "shadow-samples": 16}})");
    EXPECT_EQ(open.render.openness, usual_openness);
    EXPECT_EQ(open.render.shadow, ShadowMethod::rays);
    EXPECT_EQ(scene(R"({"limn": 1, "objects": [{"file": "a.ply"}], "render": {"ao": 0.25}})").render.openness, 0.25);
    EXPECT_EQ(refusal_with(R"("render": {"ao": "much"})"), "render.ao: expected true, false or a number in 0.001..1000 radii, found \"much\"");
    EXPECT_EQ(refusal_with(R"("lights": [{"kind": "sphere", "place": [1, 2, 3], "radius": 0}])"), "lights[0].radius: expected a number above 0, found 0");
    EXPECT_EQ(refusal_with(R"("lights": [{"kind": "rectangle", "place": [1, 2, 3], "size": [1, -1]}])"), "lights[0].size: expected [width, height], both above 0, found a list of 2");
    EXPECT_EQ(refusal_with(R"("lights": [{"kind": "environment", "file": "sky.hdr"}])"), "lights[0].file: there is no file \"sky.hdr\"");
}

TEST_F(SceneJson, AWholeCameraIsReadAndWritten)
{
    const Scene s = scene(R"({"limn": 1, "objects": [{"file": "a.ply"}], "camera": {"eye": [1, 2, 9], "look": [0, 0, 1], "fov_degrees": 40, "size": [320, 200]}})");
    ASSERT_TRUE(s.view.camera);
    EXPECT_EQ(s.view.camera->eye, dvec3(1, 2, 9));
    EXPECT_EQ(s.view.camera->size, ivec2(320, 200));
    const Scene again = scene(scene_to_json(s));
    EXPECT_EQ(camera_to_json(*again.view.camera), camera_to_json(*s.view.camera));
}

TEST_F(SceneJson, RefusesWhatIsNoScene)
{
    EXPECT_EQ(refusal(""), "line 1: no valid JSON at byte 0");
    EXPECT_EQ(refusal("{\n\"limn\": 1,\n\"objects\" 3}"), "line 3: no valid JSON at byte 23");
    EXPECT_EQ(refusal("[1, 2]"), "expected an object, found a list of 2");
    EXPECT_EQ(refusal("{}"), "the key 'limn' is missing; it holds the version of the scene file, 1");
    EXPECT_EQ(refusal(R"({"limn": 2})"), "limn: expected 1, the version of scene files that this Limn reads, found 2");
    EXPECT_EQ(refusal(R"({"limn": "0.1.0"})"), "limn: expected 1, the version of scene files that this Limn reads, found \"0.1.0\"");
    EXPECT_EQ(refusal(R"({"limn": 1})"), "the key 'objects' is missing");
    EXPECT_EQ(refusal(R"({"limn": 1, "objects": []})"), "objects: expected at least one object, found a list of 0");
    EXPECT_EQ(refusal(R"({"limn": 1, "objects": {}})"), "objects: expected a list, found an object");
    EXPECT_EQ(refusal(R"({"limn": 1, "limn": 1})"), "the key \"limn\" stands twice in one object");
    EXPECT_EQ(refusal(R"({"limn": 1e999})"), "a number is too large to be read");
    EXPECT_EQ(refusal(std::string(100000, '[')), "more than 64 levels of brackets");
}

TEST_F(SceneJson, AnUnknownKeyIsAnsweredWithTheNearestRealOne)
{
    EXPECT_EQ(refusal_with(R"("objectz": [])"), "objectz: unknown key; did you mean 'objects'?");
    EXPECT_EQ(refusal_with(R"("materials": {"clay": {"color": "#000000"}})"), "materials.clay.color: unknown key; did you mean 'colour'?");
    EXPECT_EQ(refusal_with(R"("lines": {"crease_angle": 3})"), "lines.crease_angle: unknown key; did you mean 'crease-angle'?");
    EXPECT_EQ(refusal_with(R"("render": {"lamp": [1, 2, 3]})").rfind("render.lamp: unknown key", 0), 0u);
    EXPECT_EQ(refusal_with(R"("camera": {"eyes": [1, 2, 3], "look": [0, 0, 0]})"), "camera.eyes: unknown key; did you mean 'eye'?");
    EXPECT_EQ(refusal_with(R"("materials": {"c": {"zzzzzzzzz\n": 1}})"), "materials.c.\"zzzzzzzzz\\n\": unknown key; known: colour, unlit");
    EXPECT_EQ(refusal_with(R"("lights": [{"kind": "lamp", "direction": [1, 2, 3]}])"), "lights[0].direction: unknown key; known: kind, place");
    EXPECT_EQ(refusal_of_object(R"("trnaslate": [1, 2, 3])"), "objects[0].trnaslate: unknown key; did you mean 'translate'?");
}

TEST_F(SceneJson, AValueOfTheWrongTypeOrOutOfRangeIsNamedByTheWayToIt)
{
    EXPECT_EQ(refusal_of_object(R"("material": {"colour": 3})"), "objects[0].material.colour: expected \"#rrggbb\", found 3");
    EXPECT_EQ(refusal_of_object(R"("material": {"colour": "red"})"), "objects[0].material.colour: expected \"#rrggbb\", found \"red\"");
    EXPECT_EQ(refusal_of_object(R"("material": {"unlit": 2})"), "objects[0].material.unlit: expected a number in 0..1, found 2");
    EXPECT_EQ(refusal_of_object(R"("material": {"unlit": "0.5"})"), "objects[0].material.unlit: expected a number in 0..1, found \"0.5\"");
    EXPECT_EQ(refusal_of_object(R"("material": 3)"), "objects[0].material: expected the name of a material, or an object with its options, found 3");
    EXPECT_EQ(refusal_with(R"("style": {"curves": "yes"})"), "style.curves: expected true or false, found \"yes\"");
    EXPECT_EQ(refusal_with(R"("style": {"width": true})"), "style.width: expected 0.01..50 mm, found true");
    EXPECT_EQ(refusal_with(R"("render": {"shading": "tune"})"), "render.shading: expected one of smooth|flat|toon|gouraud|normals, found \"tune\"");
    EXPECT_EQ(refusal_with(R"("render": {"toon-levels": 2.5})"), "render.toon-levels: expected a whole number in 2..16, found 2.5");
    EXPECT_EQ(refusal_with(R"("lines": {"crease-angle": 200})"), "lines.crease-angle: expected a number in 0..180 degrees, found 200");
    EXPECT_EQ(refusal_with(R"("lines": {"lines": ["contour", [1]]})").find("lines.lines: expected one of illustration|technical|all|"), 0u);
    EXPECT_EQ(refusal_with(R"("lines": 3)"), "lines: expected an object, found 3");
    EXPECT_EQ(refusal_with(R"("camera": {"size": [0, 3]})"), "camera.size[0]: expected a whole number in 1..32768, found 0");
    EXPECT_EQ(refusal_with(R"("camera": {"view": "under"})"), "camera.view: expected one of front|back|left|right|top|bottom|iso or \"AZ,EL\" in degrees, found \"under\"");
    EXPECT_EQ(refusal_with(R"("camera": {"up_axis": "x"})"), "camera.up_axis: expected \"y\" or \"z\", found \"x\"");
    EXPECT_EQ(refusal_with(R"("camera": {"fov_degrees": 180})"), "camera.fov_degrees: expected a number in 0.1..170, found 180");
    EXPECT_EQ(refusal_with(R"("camera": {"eye": [1, 2], "look": [0, 0, 0]})"), "camera: 'eye' is [1,2]; expected [x, y, z]");
    EXPECT_EQ(refusal_with(R"("camera": {"eye": [1, 2, 3]})"), "camera: 'look' is missing");
}

TEST_F(SceneJson, RefusesBadTransforms)
{
    EXPECT_EQ(refusal_of_object(R"("translate": [1, 2])"), "objects[0].translate: expected [x, y, z], found a list of 2");
    EXPECT_EQ(refusal_of_object(R"("translate": [1e200, 0, 0])"), "objects[0].translate: is farther than 1e+15 from the origin");
    EXPECT_EQ(refusal_of_object(R"("scale": 0)"), "objects[0].scale: expected a number in 1e-09..1000000000, found 0");
    EXPECT_EQ(refusal_of_object(R"("scale": [1, 2, 1])"), "objects[0].scale: expected a number in 1e-09..1000000000, found a list of 3");
    EXPECT_EQ(refusal_of_object(R"("rotate": 30)"), "objects[0].rotate: expected [x, y, z] in degrees or {\"axis\": [x, y, z], \"degrees\": d}, found 30");
    EXPECT_EQ(refusal_of_object(R"("rotate": {"axis": [0, 0, 0], "degrees": 3})"), "objects[0].rotate.axis: expected a direction, found a list of 3");
    EXPECT_EQ(refusal_of_object(R"("rotate": {"axis": [0, 0, 1]})"), "objects[0].rotate: the key 'degrees' is missing");
    EXPECT_EQ(refusal_of_object(R"("matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], "scale": 2)"),
              "objects[0]: 'matrix' holds the whole transform; leave 'scale' out");
    const std::string matrix = "objects[0].matrix: expected a rotation, a uniform scale and a translation; the matrix ";
    EXPECT_EQ(refusal_of_object(R"("matrix": [1, 0, 0])"), "objects[0].matrix: expected a list of 16 numbers, found a list of 3");
    EXPECT_EQ(refusal_of_object(R"("matrix": [2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])"), matrix + "shears or scales unevenly");
    EXPECT_EQ(refusal_of_object(R"("matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1])"), matrix + "mirrors");
    EXPECT_EQ(refusal_of_object(R"("matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1])"), matrix + "does not end with the row 0, 0, 0, 1");
    EXPECT_EQ(refusal_of_object(R"("matrix": [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1])"), matrix + "scales by 0, outside 1e-09..1000000000");
}

TEST_F(SceneJson, RefusesWhatIsNotThere)
{
    EXPECT_EQ(refusal(R"({"limn": 1, "objects": [{"file": "a.ply"}, {"file": "b.ply"}]})"), "objects[1].file: there is no file \"b.ply\"");
    EXPECT_EQ(refusal(R"({"limn": 1, "objects": [{"file": ""}]})"), "objects[0].file: expected the name of a file, found \"\"");
    EXPECT_EQ(refusal(R"({"limn": 1, "objects": [{"file": "a.ply\u0000b"}]})"), "objects[0].file: a file's name holds no zero byte");
    EXPECT_EQ(refusal(R"({"limn": 1, "objects": [{"name": "x"}]})"), "objects[0]: the key 'file' is missing");
    EXPECT_EQ(refusal(R"({"limn": 1, "materials": {"clay": {}}, "objects": [{"file": "a.ply", "material": "cley"}]})"),
              "objects[0].material: no material is called \"cley\"; did you mean 'clay'?");
    EXPECT_EQ(refusal_with(R"("lights": [{"kind": "sun"}])"), "lights[0].kind: expected one of headlight|distant|lamp|sphere|rectangle|environment, found \"sun\"");
    EXPECT_EQ(refusal_with(R"("lights": [{"kind": "headlight"}, {"kind": "headlight"}])"),
              "lights: expected one light, which is all a picture is lit by so far, found a list of 2");
}

TEST_F(SceneJson, TheManualsExampleIsItsFileAndCanBeRead)
{
    const std::string file = test::read_text(LIMN_DOCS "/scene.json"), manual = test::read_text(LIMN_DOCS "/scene.md");
    EXPECT_NE(manual.find("```json\n" + file + "```"), std::string::npos);
    for (const char* model : {"knot.ply", "torus.ply", "cylinder.ply"})
        test::write_text(folder_ / model, "");
    EXPECT_EQ(refusal(file), "");
}

TEST_F(SceneJson, TheManualNamesEveryKeyOfItsOwn)
{
    const std::string manual = test::read_text(LIMN_DOCS "/scene.md");
    for (const char* key : {"limn", "objects", "materials", "lights", "camera", "surface", "lines", "style", "render", "image-lines", "shader-lines", "file", "from", "name",
                            "scale", "rotate", "translate", "matrix", "material", "colour", "unlit", "view", "up_axis", "fov_degrees", "orthographic", "size", "eye", "look",
                            "up", "ortho_height"})
        EXPECT_NE(manual.find("`" + std::string(key) + "`"), std::string::npos) << key;
}

TEST_F(SceneJson, AMeshInMemoryIsNotWritten)
{
    Scene s;
    s.objects.emplace_back().mesh = std::make_shared<const Mesh>();
    EXPECT_THROW(scene_to_json(s), Error::Input);
}

TEST_F(SceneJson, CutAndMutatedScenesAreRefusedInOneLineOrRead)
{
    const std::string whole = whole_scene;
    std::mt19937 random(3);
    int refused = 0;
    for (int i = 0; i < 3000; ++i) {
        SCOPED_TRACE(i);
        std::string text = i < 500 ? whole.substr(0, random() % whole.size()) : whole;
        if (i >= 500)
            for (int changes = 1 + int(random() % 4); changes > 0; --changes)
                switch (random() % 3) {
                case 0: text[random() % text.size()] ^= char(1 << random() % 8); break;
                case 1: text.erase(random() % text.size(), 1 + random() % 6); break;
                default: text.insert(random() % text.size(), whole.substr(random() % whole.size(), 1 + random() % 8));
                }
        refused += !refusal(text).empty();
    }
    EXPECT_GT(refused, 2000);
    EXPECT_LT(refused, 3000);
}

/// Each value of the scene put in place of each other one.
TEST_F(SceneJson, AnyValueInAnyPlaceIsRefusedInOneLineOrRead)
{
    const Json whole = Json::parse(whole_scene), flat = whole.flatten();
    const std::vector<Json> strange = {nullptr, true, -1, 0, 1e300, -1e-300, "", "\n", "#000000", "nan", Json::array(), Json::object(), Json::array({1, 2, 3}),
                                       Json::array({Json::array()}), Json{{"kind", "lamp"}}};
    int refused = 0, tried = 0;
    for (const auto& [pointer, old] : flat.items())
        for (const Json& value : strange) {
            SCOPED_TRACE(pointer + " = " + value.dump());
            Json changed = whole;
            changed[Json::json_pointer(pointer)] = value;
            refused += !refusal(changed.dump()).empty();
            ++tried;
        }
    EXPECT_GT(refused, tried * 3 / 5);
    EXPECT_LT(refused, tried);
}

} // namespace
} // namespace limn
