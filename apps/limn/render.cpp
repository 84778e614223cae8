#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/parallel.h"
#include "limn/drawing/exr.h"
#include "limn/drawing/png.h"
#include "limn/drawing/raster.h"
#include "limn/lines/feature_size.h"
#include "limn/scene/map_shadows.h"
#include "limn/scene/overlay.h"
#include "limn/scene/passes.h"
#include "limn/scene/pixel_painter.h"
#include "limn/scene/render_options.h"
#include "pictures.h"
#include "print_info.h"
#include "render_pattern.h"
#include "render_print.h"
#include "scene_file.h"
#include "subcommand.h"
#include "table_options.h"

using namespace limn;

namespace {

constexpr const char* examples = R"(Examples:
  limn render bunny.ply -o bunny.png
  limn render bunny.ply -o bunny.png --lines contour,suggestive --shading toon --light 1,2,3
  limn render part.stl -o part.png --background '#ffffff' --view 30,20 --size 1280x720 --bits 16
  limn render vase.glb -o turn.png --turntable 24
  limn render scene.json -o scene.png --view 30,20
  limn render bunny.ply -o soft.png --ground --light sphere:3,5,2,1 --shadow-samples 64
  limn render bunny.ply -o fast.png --ground --light sphere:3,5,2,1 --shadow-maps bunny.csm
  limn render part.stl -o open.png --ao
  limn render part.stl -o print.png --material layers --layer-height 0.2mm --filament petg-black
  limn render part.stl -o cusps.png --material layers --show cusp --print-direction x
  limn render print.gcode -o print.png --color feature --layers 1..50
  limn render creature.obj -o creature.png --subdivision loop
  limn render creature.obj -o how.png --subdivision loop --overlay DE
  limn render bunny.ply -o data.exr --pass kr,depth,normal,id --cameras cameras.json)";

struct RenderCommand {
    PictureCommand pictures;
    std::vector<Material> materials; ///< of a scene's objects; empty: all have the usual one
    RenderOptions render;
    ImageLineOptions image_lines;
    ShaderLineOptions shader_lines;
    std::string passes;
    std::string overlay; ///< letters of draw_overlay
    std::vector<std::string> shadow_maps; ///< files
    PatternCommand pattern;
    PrintOptions print; ///< of G-code
};

/// What hides light beside rays.
struct Casters {
    ObjectMaps maps;
    std::vector<dmat4> transforms;
};

/// "data-kr.exr" beside "data.exr".
std::string beside(const std::string& path, std::string_view word, std::string_view ending)
{
    const std::filesystem::path file(path);
    return (file.parent_path() / fmt::format("{}-{}.{}", file.stem().string(), word, ending)).string();
}

void write_image(const Image& image, const Output& output, int bits)
{
    if (output.format == "exr")
        write_file(output.path, encode_exr(image));
    else
        write_file(output.path, encode_png(image, {.bits = bits}));
}

/// Writes each pass to a file of its own, and what their numbers mean to one more.
std::vector<std::string> write_passes(const std::vector<Pass>& passes, const Drawing& drawing, const Style& style, const SeenModel& model, const Output& output)
{
    if (passes.empty())
        return {};
    std::vector<std::string> written;
    const Camera& camera = drawing.camera;
    nlohmann::ordered_json scales = {{"camera", nlohmann::ordered_json::parse(camera_to_json(camera))}, {"passes", nlohmann::ordered_json::object()}};
    const GBuffer seen = trace_gbuffer(model.scene, camera);
    for (const Pass pass : passes) {
        const PassImage image = pass == Pass::lines ? lines_pass(drawing, style) : make_pass(model.lines, seen, camera, pass);
        const bool whole = output.format == "png";
        written.push_back(beside(output.path, pass_name(pass), output.format));
        write_image(whole ? pass_for_whole_numbers(image) : image.values, {written.back(), output.format}, 16);
        nlohmann::ordered_json& scale = scales["passes"][std::string(pass_name(pass))];
        scale = {{"file", std::filesystem::path(written.back()).filename().string()}, {"unit", pass_unit(pass)}, {"low", image.low}, {"high", image.high}};
        if (whole && pass != Pass::id)
            scale["value"] = "low + (sample - 1) / 65534 * (high - low); sample 0 is background";
    }
    written.push_back(beside(output.path, "passes", "json"));
    write_file(written.back(), scales.dump(2) + "\n");
    return written;
}

/// The passes asked for; that of lines only where lines are drawn.
/// @throws Error::Input for a pass that there is none of, and for lines that nobody draws.
std::vector<Pass> passes_of(const RenderCommand& command)
{
    std::vector<Pass> passes = passes_from_text(command.passes);
    if (!command.pictures.lines.lines.empty())
        return passes;
    if (std::erase(passes, Pass::lines) > 0 && command.passes != "all")
        throw Error::Input("--pass lines: no lines are drawn; say which with --lines");
    return passes;
}

void check_passes(const RenderCommand& command, const std::vector<Pass>& passes)
{
    if (passes.empty())
        return;
    if (command.pictures.view.views.size() > 1)
        throw Error::Input("--pass makes images of one view; give --view once, or --cameras");
    for (const std::string& output : command.pictures.common.outputs)
        if (output == "-")
            throw Error::Input("--pass writes several files; -o - cannot hold them");
}

/// The files of maps that the command line and the scene's objects name.
std::vector<std::filesystem::path> map_files(const RenderCommand& command)
{
    std::vector<std::filesystem::path> files(command.shadow_maps.begin(), command.shadow_maps.end());
    for (const SceneObject& object : command.pictures.model.objects)
        if (!object.shadow_maps.empty() && std::find(files.begin(), files.end(), object.shadow_maps) == files.end())
            files.push_back(object.shadow_maps);
    return files;
}

Casters casters_of(const Models& models, const std::vector<std::filesystem::path>& files)
{
    std::vector<std::uint64_t> shapes;
    Casters casters;
    for (const Input& input : models.inputs) {
        shapes.push_back(input.shape);
        casters.transforms.push_back(input.transform);
    }
    casters.maps = match_maps(files, shapes);
    return casters;
}

PixelOptions pixel_options(const RenderCommand& command, const Casters& casters, const SeenModel& model)
{
    PixelOptions options = {shade_options(command.render, model.scene, model.up), command.image_lines, command.shader_lines,
                            command.pictures.style.line(LineType::contour).colour};
    options.shade.materials = command.materials;
    hide_by_maps(options.shade, command.render.shadow, casters.maps, casters.transforms, model.scene);
    if (options.shader_lines.method != ShaderMethod::off) {
        options.shader_lines.suggestive_limit = float(command.pictures.lines.suggestive_limit);
        options.shader_lines.feature_size = model_feature_size(model.lines, command.pictures.lines.feature_size);
    }
    options.pattern = command.pattern.options;
    options.place = pattern_place(command.pattern, command.pictures, model.up);
    return options;
}

/// Takes what a scene file says, except what the command line says itself.
void take_scene(const CLI::App& app, RenderCommand& command)
{
    const std::optional<Scene> scene = take_files(app, command.pictures);
    take_pattern(app, scene ? &*scene : nullptr, command.pattern);
    if (!scene) {
        if (app.count("--ground") == 0)
            command.render.ground = command.pattern.stands_on_plate();
        return;
    }
    RenderOptions lit = lit_by(scene->lights, scene->render);
    if (app.count("--light") + app.count("--lamp") > 0) {
        lit.light.reset();
        lit.lamp.reset();
        lit.wide.reset();
    }
    take_options(app, render_option_table(), lit, command.render);
    take_options(app, image_line_option_table(), scene->image_lines, command.image_lines);
    take_options(app, shader_line_option_table(), scene->shader_lines, command.shader_lines);
    if (app.count("--page") == 0)
        command.pictures.style.page = {}; // that of the scene is for `limn draw`
    command.materials = object_materials(*scene, default_material(command.render));
}

void say_on_standard_error(const std::string& line) { fmt::print(stderr, "limn: {}\n", line); }

void run(const CLI::App& app, RenderCommand& command)
{
    if (is_print(command.pictures)) {
        render_print(app, command.pictures, command.render, command.pattern.options, command.print, [&](const Drawing& drawing, const Output& output) {
            write_image(drawing.captions.empty() ? drawing.background : lay_over(drawing.background, drawing, command.pictures.style), output, command.render.bits);
        });
        return;
    }
    refuse_print_options(app);
    take_scene(app, command);
    PictureCommand& pictures = command.pictures;
    if (!pictures.style.page.empty())
        throw Error::Input("--page: 'limn render' makes pictures, not pages; 'limn draw --shade smooth' writes pages");
    check_overlay(command.overlay);
    if (!command.overlay.empty() && pictures.model.subdivision.scheme != SubdivisionOptions::Scheme::loop)
        throw Error::Input("--overlay shows how control meshes are drawn; give --subdivision loop too");
    const std::vector<Pass> passes = passes_of(command);
    check_passes(command, passes);
    pictures.need = pass_need(passes);
    if (command.shader_lines.method != ShaderMethod::off)
        pictures.need = Need::derivative;
    if (command.render.wide)
        load(*command.render.wide); // once for all views
    const std::vector<std::filesystem::path> maps = map_files(command);
    pictures.model.hash_shapes = !maps.empty();
    if (!maps.empty() && pictures.model.subdivision.scheme == SubdivisionOptions::Scheme::loop)
        throw Error::Input("--shadow-maps: maps are of a mesh as it is, not of what --subdivision makes of it; --shadow ray does without");
    PictureHooks hooks;
    Casters casters;
    hooks.prepared = [&](const Models& models) { casters = casters_of(models, maps); };
    PixelPainter painter(pictures.common.device, say_on_standard_error);
    hooks.underlay = [&](Drawing& drawing, const SeenModel& model) { drawing.background = painter.paint(model, drawing.camera, pixel_options(command, casters, model)); };
    if (!command.overlay.empty())
        hooks.overlay = [&](Drawing& drawing, const LoopView& view, const Models& models) {
            drawing.background = draw_overlay(drawing.background, view, models.loops, drawing.camera, command.overlay);
        };
    if (command.pattern.is_wanted())
        hooks.underlay = [&command, &pictures, paint = hooks.underlay](Drawing& drawing, const SeenModel& model) {
            paint(drawing, model);
            explain_pattern(command.pattern, pattern_place(command.pattern, pictures, model.up), model.scene, drawing);
        };
    hooks.note = [&] { return command.pattern.note; };
    hooks.report = [&] { return report_of(command.pattern); };
    hooks.device = [&] { return painter.device(); };
    hooks.write = [&](const Drawing& drawing, const SeenModel& model, const Output& output) {
        const Image picture = drawing.strokes.empty() && drawing.captions.empty() ? drawing.background : lay_over(drawing.background, drawing, pictures.style);
        write_image(picture, output, command.render.bits);
        std::vector<std::string> written = {output.path};
        for (std::string& name : write_passes(passes, drawing, pictures.style, model, output))
            written.push_back(std::move(name));
        return written;
    };
    make_pictures(pictures, hooks);
}

} // namespace

Subcommand add_render(CLI::App& limn)
{
    auto command = std::make_shared<RenderCommand>();
    command->pictures.name = "render";
    command->pictures.uses_gpu = true;
    command->pictures.shades_cut_meshes = true;
    command->pictures.formats = {"png", "exr"};
    command->pictures.lines.lines.clear();
    CLI::App* app = limn.add_subcommand("render", "Render shaded pictures of models and of G-code, with or without lines, and their ingredient images");
    app->footer(examples);
    add_table_options(*app, render_option_table(), command->render, "Shading");
    add_pattern_options(*app, command->pattern);
    add_print_options(*app, command->print);
    add_table_options(*app, image_line_option_table(), command->image_lines, "Lines per pixel");
    add_table_options(*app, shader_line_option_table(), command->shader_lines, "Lines per pixel");
    app->add_option("--pass", command->passes, "also write ndotv,kr,dwkr,k1,k2,depth,normal,position,id,lines (or all) to FILE-PASS, and their scales to FILE-passes.json")
        ->type_name("PASS,...")
        ->group("Shading");
    app->add_option("--shadow-maps", command->shadow_maps, "maps of a model, made by 'limn shadow bake', that tell where light is hidden; may be given several times")
        ->type_name("FILE.csm")
        ->group("Shading");
    app->add_option("--overlay", command->overlay,
                    "with --subdivision loop, how the picture came about: A control mesh, B its edges with normals, C crossings, D contour, E triangles, F none")
        ->type_name("LETTERS")
        ->group("Subdivision");
    add_picture_options(*app, command->pictures, "file to write; may be given several times: png, exr; '-' is standard output");
    return {app, [command, app] { with_threads(command->pictures.common.threads, [&] { run(*app, *command); }); }};
}
