#include <map>
#include <memory>

#include "areas.h"
#include "limn/base/parallel.h"
#include "limn/drawing/write_drawing.h"
#include "pictures.h"
#include "scene_file.h"
#include "subcommand.h"

using namespace limn;

namespace {

constexpr const char* examples = R"(Examples:
  limn draw bunny.ply -o bunny.svg
  limn draw bunny.ply -o bunny.svg -o bunny.png --view 30,20 --lines contour,suggestive
  limn draw part.stl -o sheet.pdf --lines technical --ortho --hidden dash --page A4 \
      --view front --view right --view top --view iso
  limn draw base.obj lid.obj -o both.pdf --scale 1:2 --page A3
  limn draw vase.glb -o turn.svg --turntable 24
  limn draw scene.json -o scene.svg --lines technical
  limn draw creature.obj -o creature.svg --subdivision loop --lines contour,suggestive
  cat bunny.ply | limn draw - --from ply -o - --to svg > bunny.svg)";

struct DrawCommand {
    PictureCommand pictures;
    AreaOptions areas;
};

/// Takes what a scene file says. @return whether it or the command line says which lines to draw
bool take_scene(const CLI::App& app, DrawCommand& command)
{
    const std::optional<Scene> scene = take_files(app, command.pictures);
    if (scene) {
        const RenderOptions lit = lit_by(scene->lights, scene->render);
        command.areas.to_light = lit.light;
        command.areas.lamp = lit.wide ? middle_of(*lit.wide) : lit.lamp;
        command.areas.materials = object_materials(*scene, shape_material(command.pictures.style));
    }
    return app.count("--lines") > 0 || (scene && !scene->lines.lines.empty());
}

void run(const CLI::App& app, DrawCommand& command)
{
    PictureCommand& pictures = command.pictures;
    const bool lines_given = take_scene(app, command);
    if (!lines_given && (pictures.style.look == Look::dark || pictures.style.look == Look::toon))
        pictures.lines.lines.push_back(LineType::highlight);
    PictureHooks hooks;
    hooks.underlay = [&](Drawing& drawing, const SeenModel& model) { add_areas(drawing, model.scene, command.areas, pictures.style); };
    hooks.write = [&](const Drawing& drawing, const SeenModel&, const Output& output) -> std::vector<std::string> {
        write_drawing(drawing, pictures.style, output.path, output.format);
        return {output.path};
    };
    make_pictures(pictures, hooks);
}

} // namespace

Subcommand add_draw(CLI::App& limn)
{
    auto command = std::make_shared<DrawCommand>();
    command->pictures.name = "draw";
    command->pictures.formats = {drawing_formats().begin(), drawing_formats().end()};
    CLI::App* app = limn.add_subcommand("draw", "Draw the lines of models, hidden lines removed");
    app->footer(examples);
    app->add_flag("--fill", command->areas.fill, "fill the shape's silhouette under the lines (always so with --style dark)")
        ->group("Look and page");
    app->add_option("--shade", command->areas.shade, "none|smooth|flat: a shaded picture under the lines (default none)")
        ->type_name("X")
        ->transform(CLI::Transformer(std::map<std::string, Shade>{{"none", Shade::none}, {"smooth", Shade::smooth}, {"flat", Shade::flat}}))
        ->group("Look and page");
    add_picture_options(*app, command->pictures, "file to write; may be given several times: svg, pdf, png, dxf, json, ply; '-' is standard output");
    return {app, [command, app] {
                with_threads(command->pictures.common.threads, [&] { run(*app, *command); });
            }};
}
