#include "pattern_figures.h"

#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/drawing/png.h"
#include "limn/lines/regions.h"
#include "limn/pattern/filament.h"
#include "limn/pattern/pixel_samples.h"
#include "limn/scene/pattern_picture.h"
#include "limn/scene/render.h"
#include "limn/surface/shapes.h"
#include "pattern_panels.h"
#include "print_truth.h"

using namespace limn;
using namespace limn::formulas;

namespace {

constexpr int edge = 280; ///< of a panel, pixels
const dvec3 light_of_study = {-1, -1.2, 1.4};

Scene scene_of(const std::string& shape, std::size_t triangles, const dmat4& turn)
{
    Scene scene;
    SceneObject object;
    object.mesh = std::make_shared<const Mesh>(make_shape({.name = shape, .triangles = triangles}).mesh);
    object.transform = turn;
    scene.objects = {object};
    return scene;
}

/// A generated shape, turned in the world.
struct Stage {
    Scene scene;
    SceneModel model;
    Stage(const std::string& shape, std::size_t triangles, const dmat4& turn)
        : scene(scene_of(shape, triangles, turn)), model(prepare_scene(scene))
    {
    }
};

/// What one panel shows.
struct Panel {
    std::string shape = "blob";
    PatternOptions pattern = {};
    std::string view = "20,35"; ///< from which the light is mirrored
    bool faceted = false, point_light = false;
    dmat4 turn = dmat4(1);
    vec3 background = vec3(1);
    std::size_t triangles = 30000;
    ivec2 size = {edge, edge};
};

Image paint(const Panel& panel)
{
    const Stage stage(panel.shape, panel.triangles, panel.turn);
    const SeenScene seen = seen_scene(stage.model.lines, stage.model.rays);
    const Camera camera = filling_camera(stage.model, panel.view, panel.size);
    ShadeOptions shade;
    shade.background = panel.background;
    shade.shading = panel.faceted ? Shading::flat : Shading::smooth;
    if (panel.point_light)
        shade.lamp = seen.centre + 3 * seen.scale * glm::normalize(light_of_study);
    else
        shade.to_light = light_of_study;
    return paint_pattern(seen, camera, panel.pattern, {1, {panel.turn}, dvec3(0, 0, 1)}, shade);
}

/// The study's layers: Phong, m = 100, its 50 samples over 2 x 2 pixels.
PatternOptions layers(double height, LayerModel model = LayerModel::seed, PatternReflection reflection = PatternReflection::phong)
{
    PatternOptions o;
    o.kind = PatternKind::layers;
    o.layer_model = model;
    o.layer_height = height;
    o.reflection = reflection;
    o.specular = reflection == PatternReflection::phong ? 0.05 : 0.1;
    o.filter = PatternFilter::seed;
    o.variety = 0;
    return o;
}

PatternOptions bricks(PatternFilter filter = PatternFilter::seed)
{
    PatternOptions o;
    o.kind = PatternKind::bricks;
    o.filter = filter;
    o.brick_width = 0.25, o.brick_height = 0.08, o.brick_depth = 0.095, o.mortar = 0.01, o.brick_relief = 0.004; // half of the study's
    o.variety = 0;
    o.brick_bond = false;
    return o;
}

PatternOptions thread(PatternFilter filter = PatternFilter::seed, double scale = 3)
{
    PatternOptions o;
    o.kind = PatternKind::thread;
    o.filter = filter;
    o.hole = 0.003 * scale, o.thread = 0.002 * scale;
    o.woven = false;
    o.mirror_cone = false;
    return o;
}

template <class F> PatternOptions with(PatternOptions options, F&& change)
{
    change(options);
    return options;
}

Panel with_size(Panel panel, const ivec2& size)
{
    panel.size = size;
    return panel;
}

Image row(const std::vector<Panel>& panels)
{
    std::vector<Image> images;
    for (const Panel& panel : panels)
        images.push_back(paint(panel));
    return in_rows({images}, 6);
}

/// A wall's bump by differences over 2 delta of smooth or hard heights, lit from the upper left.
Image bumped_wall(float delta, bool hard)
{
    const BrickPattern b = {vec3(0.52f, 0.18f, 0.21f), 0.02f, 2, vec3(1), vec3(0.6f, 0.3f, 0.22f), vec3(0.55f, 0.53f, 0.5f), 0, 0};
    const vec3 m = mortar_part(b), light = glm::normalize(vec3(-1, 1, 1.5f));
    const auto height = [&](float part, float x) { return hard ? pulse(part, x - std::floor(x)) : bevel(part, x - std::floor(x)); };
    const std::vector<vec2> samples = even_samples(64, KERNEL_BOX, 1, vec2(0.5f));
    Image image({edge, edge}, 3);
    for (int y = 0; y < edge; ++y)
        for (int x = 0; x < edge; ++x) {
            vec3 sum(0);
            for (const vec2& s : samples) {
                const vec3 p = {(float(x) + 0.5f + s.x) / edge, 1 - (float(y) + 0.5f + s.y) / edge, 0}, at = brick_place(b, p);
                const float u = at.x, v = at.y, hu = height(m.x, u), hv = height(m.y, v);
                const float du = (height(m.x, u + delta) - height(m.x, u - delta)) / (2 * delta) * hv,
                            dv = (height(m.y, v + delta) - height(m.y, v - delta)) / (2 * delta) * hu;
                const vec3 colour = brick_mask(b, p) > 0.5f ? b.brick : b.mortar;
                sum += colour * (0.25f + 0.9f * facing(bumped({0, 0, 1}, vec3(du, dv, 0)), light));
            }
            const vec3 c = encoded_colour(glm::min(sum / float(samples.size()), vec3(1)));
            for (int k = 0; k < 3; ++k)
                image.at(x, y)[k] = c[k];
        }
    return image;
}

const vec3 page = vec3(0.3f); ///< linear, behind thread: dark enough for highlights to stand out

/// What a point of a thread sphere looks like: its kind (thread_mask), the normal and the direction to the eye; linear, or nothing in a hole.
using ThreadLook = std::function<std::optional<vec3>(int kind, const vec3& n, const vec3& to_eye)>;

/// The front of the thread sphere, `zoom` times as large.
Image thread_sphere(double zoom, float cell, const ThreadLook& look)
{
    Camera camera;
    camera.eye = {0.6, 1.2, 4};
    camera.fov_degrees = 30.5 / zoom; // a ball of radius 1 fills it but for a twentieth
    camera.size = {edge, edge};
    const PatternCamera seen(camera, dvec3(0), 1, {});
    const ThreadPattern c = {0.6f * cell, 0.4f * cell, vec3(0), 0, 1, 1, 0, 0};
    const std::vector<vec2> samples = even_samples(64, KERNEL_BOX, 1, vec2(0.5f));
    Image image({edge, edge}, 3);
    for (int y = 0; y < edge; ++y)
        for (int x = 0; x < edge; ++x) {
            vec3 sum(0), place;
            for (const vec2& s : samples) {
                std::optional<vec3> colour;
                if (seen.on_sphere(vec3(0), 1, false, vec2(float(x), float(y)) + 0.5f + s, place))
                    colour = look(thread_mask(c, sphere_place(place) / cell), place, seen.to_eye(place));
                sum += colour ? shown_light(*colour) : page;
            }
            const vec3 shown = encoded_colour(glm::clamp(sum / float(samples.size()), vec3(0), vec3(1)));
            for (int k = 0; k < 3; ++k)
                image.at(x, y)[k] = shown[k];
        }
    return image;
}

Illumination thread_light() { return {glm::normalize(vec3(-0.5f, 0.7f, 1)), vec3(2.4f), 0, {0, 1, 0}, vec3(0.25f), vec3(0.1f)}; }

/// Hair's reflection with tangents of a choice: as they are (0), all level (1), all upright (2), all normals (3).
ThreadLook hair(int tangents)
{
    return [tangents](int kind, const vec3& n, const vec3& to_eye) -> std::optional<vec3> {
        if (kind == 0)
            return std::nullopt;
        const int which = tangents == 0 ? kind : tangents;
        const ThreadPattern c = {0, 0, vec3(0.1f, 0.18f, 0.4f), 0.35f, 20, 1, 0, 0};
        return thread_lit(c, which == 1 ? level_tangent(n) : which == 2 ? upright_tangent(n) : n, n, to_eye, thread_light());
    };
}

std::optional<vec3> plastic_net(int kind, const vec3& n, const vec3& to_eye)
{
    if (kind == 0)
        return std::nullopt;
    return reflected({FINISH_PHONG, vec3(0.1f, 0.18f, 0.4f), 0.05f, 40, 1, 1, 0}, n, level_tangent(n), to_eye, 0, thread_light());
}

/// Tangents as colours.
std::optional<vec3> tangent_colours(int kind, const vec3& n, const vec3&)
{
    if (kind == 0)
        return std::nullopt;
    return 0.5f + 0.5f * (kind == 1 ? level_tangent(n) : upright_tangent(n));
}

/// Real steps, met by rays: in place of a photograph.
Image photographed(const Panel& panel, double height)
{
    const Stage stage(panel.shape, panel.triangles, panel.turn);
    const SeenScene seen = seen_scene(stage.model.lines, stage.model.rays);
    const Camera camera = filling_camera(stage.model, panel.view, panel.size);
    ShadeOptions shade;
    shade.to_light = light_of_study;
    const PatternLight light = pattern_lights(seen, camera, shade, {1, {}, dvec3(0, 0, 1)}).front();
    return trace_print(body_of(stepped_print(*stage.scene.objects.front().mesh, {height, 1})), camera,
                       {finish_of(find_filament("pla-grey")), light, vec3(1), 0.5f, 8})
        .picture;
}

dmat4 tilted(double degrees) { return glm::rotate(dmat4(1), glm::radians(degrees), dvec3(0.3, 1, 0)); }

struct Figure {
    const char* name;
    std::function<Image()> image;
};

std::vector<Figure> brick_and_thread_figures()
{
    const auto samples = [](PatternOptions o, int count, int box = 2) {
        return with(o, [&](PatternOptions& p) { p.pattern_samples = count, p.filter_box = box; });
    };
    return {
        {"5.01",
         [=] {
             return row({{"cube", bricks(PatternFilter::off)}, {"sphere", thread(PatternFilter::off)}, {"blob", layers(0.02)}});
         }},
        {"5.02",
         [=] {
             return row({{"cube", samples(bricks(), 10)}, {"cube", samples(bricks(), 32)}, {"cube", samples(bricks(), 50)}});
         }},
        {"5.03",
         [=] {
             return row({{"sphere", samples(thread(), 50, 1)},
                         {"sphere", samples(thread(), 50, 2)},
                         {"blob", samples(layers(0.02), 50, 1)},
                         {"blob", samples(layers(0.02), 50, 2)}});
         }},
        {"5.04",
         [] {
             const PatternOptions flat = with(bricks(), [](PatternOptions& o) { o.brick_relief = 0; });
             return row({{"plane", with(flat, [](PatternOptions& o) { o.brick_solid = false; }), "0,89"}, {"cube", flat, "35,25"}});
         }},
        {"5.05",
         [] {
             return in_rows({{bumped_wall(1 / 50.0f, false), bumped_wall(1 / 500.0f, false), bumped_wall(1 / 5000.0f, false)}}, 6);
         }},
        {"5.06",
         [] {
             return in_rows({{bumped_wall(1 / 500.0f, false), bumped_wall(1 / 500.0f, true)}}, 6);
         }},
        {"5.07",
         [] {
             return row({{"cube", bricks(), "35,25"}, {"cube", bricks(), "-30,20"}});
         }},
        {"5.08",
         [] {
             Panel correct = {"sphere", thread(PatternFilter::seed, 8)};
             correct.background = vec3(0.9f, 0.85f, 0.6f);
             return in_rows({{thread_sphere(1, 0.04f, hair(0)), paint(correct)}}, 6);
         }},
        {"5.09",
         [] {
             return in_rows({{thread_sphere(1, 0.02f, hair(0)), thread_sphere(1, 0.02f, plastic_net)}}, 6);
         }},
        {"5.10",
         [] {
             std::vector<Panel> panels;
             for (const double p : {5.0, 20.0, 80.0})
                 panels.push_back({"sphere", with(thread(PatternFilter::gauss), [&](PatternOptions& o) { o.thread_exponent = p; })});
             return row(panels);
         }},
        {"5.11",
         [] {
             return in_rows({{thread_sphere(8, 0.02f, hair(0)), thread_sphere(8, 0.02f, tangent_colours)}}, 6);
         }},
        {"5.12",
         [] {
             return in_rows({{thread_sphere(1, 0.02f, hair(1)), thread_sphere(1, 0.02f, hair(2)), thread_sphere(1, 0.02f, hair(3)),
                              thread_sphere(1, 0.02f, hair(0))}},
                            6);
         }},
    };
}

std::vector<Figure> layer_figures()
{
    constexpr LayerModel seed = LayerModel::seed, soft = LayerModel::soft;
    constexpr PatternReflection phong = PatternReflection::phong, blinn = PatternReflection::blinn_phong;
    // The study's bunny is of few, flat faces.
    const auto bunny = [](const PatternOptions& o, const std::string& view = "20,35", const dmat4& turn = dmat4(1)) {
        return Panel{"blob", o, view, true, false, turn, vec3(1), 400};
    };
    const auto angel = [](const PatternOptions& o) { return with_size({"rings", o, "20,25"}, {edge, edge * 2 / 3}); };
    const auto series = [=](std::initializer_list<double> values, auto&& change) {
        std::vector<Panel> panels;
        for (const double v : values)
            panels.push_back(bunny(with(layers(0.02), [&](PatternOptions& o) { change(o, v); })));
        return row(panels);
    };
    const auto axis_x = [](PatternOptions o) {
        o.direction = dvec3(1, 0, 0);
        return o;
    };
    return {
        {"5.13",
         [=] {
             Panel lamp = bunny(layers(0.02));
             lamp.point_light = true;
             return in_rows({{photographed(bunny(layers(0.02)), 0.02), paint(bunny(layers(0.02))), paint(lamp)}}, 6);
         }},
        {"5.14",
         [=] {
             return series({0.008, 0.02, 0.064}, [](PatternOptions& o, double v) { o.layer_height = v; });
         }},
        {"5.15",
         [=] {
             return series({10, 100, 1000}, [](PatternOptions& o, double v) { o.exponent = v; });
         }},
        {"5.16",
         [=] {
             return series({0.02, 0.05, 0.1, 0.3}, [](PatternOptions& o, double v) { o.specular = v; });
         }},
        {"5.17", [=] { return row({bunny(layers(0.02))}); }},
        {"5.18",
         [=] {
             return row({bunny(layers(0.02, seed, blinn), "-20,35"), bunny(layers(0.02, seed, blinn), "20,35"),
                         bunny(layers(0.02, seed, blinn), "60,35")});
         }},
        {"5.19",
         [=] {
             return row({bunny(layers(0.008)), bunny(layers(0.004)),
                         bunny(with(layers(0.004), [](PatternOptions& o) { o.filter = PatternFilter::gauss; }))});
         }},
        {"5.20",
         [=] {
             return row({bunny(layers(0.032, soft, blinn)), bunny(layers(0.048, soft, blinn))});
         }},
        {"5.21",
         [=] {
             return in_rows({{photographed({"sphere"}, 0.048), paint({"sphere", layers(0.048, soft, phong)}),
                              paint({"sphere", layers(0.048, soft, blinn)})}},
                            6);
         }},
        {"5.22",
         [=] {
             return row({{"sphere", layers(0.02), "20,40"},
                         {"sphere", layers(0.064), "20,40"},
                         {"sphere", layers(0.064, LayerModel::slope), "20,40"}});
         }},
        {"5.23",
         [=] {
             const auto toad = [](const PatternOptions& o) { return with_size({"knot", o, "20,25"}, {edge, edge * 3 / 4}); };
             return in_rows({{photographed(toad({}), 0.06), paint(toad(layers(0.06))), paint(toad(layers(0.06, seed, blinn)))}}, 6);
         }},
        {"5.24",
         [=] {
             return row({angel(layers(0.04)), angel(layers(0.04, seed, blinn))});
         }},
        {"5.25",
         [=] {
             // Layers so soft that none is left.
             const auto none = [](PatternOptions& o) { o.layer_model = LayerModel::soft, o.soft_low = 900, o.soft_high = 1000; };
             return row({angel(with(layers(0.04), none))});
         }},
        {"5.26",
         [=] {
             return row({bunny(layers(0.064), "20,0"), bunny(layers(0.064), "20,25"), bunny(layers(0.064), "20,55")});
         }},
        {"5.27",
         [=] {
             const PatternOptions slanted = with(layers(0.064), [](PatternOptions& o) { o.with_object = true; });
             return row({bunny(layers(0.064), "20,35", tilted(35)), bunny(slanted, "20,35", tilted(35)),
                         bunny(layers(0.02), "20,35", tilted(35))});
         }},
        {"5.28",
         [=] {
             return row({bunny(layers(0.048, soft, blinn), "20,35", tilted(35)), bunny(axis_x(layers(0.048, soft, blinn)))});
         }},
    };
}

} // namespace

void write_pattern_figures(const std::filesystem::path& folder, Console& console)
{
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure)
        throw Error::Input(fmt::format("--figures: cannot make the folder {}: {}", folder.string(), failure.message()));
    std::vector<Figure> figures = brick_and_thread_figures();
    for (Figure& figure : layer_figures())
        figures.push_back(std::move(figure));
    for (std::size_t i = 0; i < figures.size(); ++i) {
        console.progress(fmt::format("figure {}", figures[i].name), double(i) / double(figures.size()));
        write_file((folder / fmt::format("figure-{}.png", figures[i].name)).string(), encode_png(figures[i].image(), {}));
    }
}
