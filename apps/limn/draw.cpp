#include <map>
#include <memory>

#include "areas.h"
#include "limn/base/parallel.h"
#include "limn/drawing/write_drawing.h"
#include "pictures.h"
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
  cat bunny.ply | limn draw - --from ply -o - --to svg > bunny.svg)";

struct DrawCommand {
    PictureCommand pictures;
    AreaOptions areas;
    bool lines_given = false;
};

void run(DrawCommand& command)
{
    PictureCommand& pictures = command.pictures;
    if (!command.lines_given && (pictures.style.look == Look::dark || pictures.style.look == Look::toon))
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
                command->lines_given = app->count("--lines") > 0;
                with_threads(command->pictures.common.threads, [&] { run(*command); });
            }};
}
