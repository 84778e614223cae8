#include <algorithm>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "areas.h"
#include "common.h"
#include "console.h"
#include "draw_report.h"
#include "eyes.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/parallel.h"
#include "limn/drawing/sheet.h"
#include "limn/drawing/style.h"
#include "limn/drawing/write_drawing.h"
#include "limn/lines/draw.h"
#include "models.h"
#include "subcommand.h"
#include "table_options.h"
#include "views.h"

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
    CommonOptions common;
    ViewOptions view;
    ModelOptions model;
    LineOptions lines;
    Style style;
    AreaOptions areas;
    int turntable = 0;
    bool lines_given = false;
};

std::vector<std::string> known_formats() { return {drawing_formats().begin(), drawing_formats().end()}; }

/// Models with what every view of them needs.
struct Stage {
    const DrawCommand& command;
    const Models& models;
    const RayScene& rays;
    LineFeatures features;
    SeenScene seen;
};

/// What is kept from view to view.
struct Progress {
    std::vector<DrawnView> views; ///< one for each camera of the run; the first `drawn` are filled
    std::size_t drawn = 0;
    ClusterHistory history;
    Times times;
    DrawnView& next() { return views[drawn++]; }
};

/// Faces by their numbers in the files.
void number_faces_as_in_files(Drawing& drawing, const std::vector<Input>& inputs)
{
    for (Stroke& stroke : drawing.strokes)
        if (const std::vector<std::uint32_t>& numbers = inputs[stroke.object].face_numbers; !numbers.empty())
            for (std::uint32_t& face : stroke.faces)
                if (face != none)
                    face = numbers[face];
}

/// Part of a run's time that goes by before its first view; for the progress.
double preparing(const DrawCommand& command) { return command.turntable > 10 ? 0.3 : 0.9; }

Drawing draw_view(const Stage& stage, Progress& progress)
{
    DrawnView& view = progress.next();
    Drawing drawing = draw_lines(stage.models.lines, stage.rays, stage.features, view.camera, stage.command.lines, &view.report, &progress.history);
    if (stage.features.clusters)
        view.clusters = {progress.history.survivors, progress.history.since_bounded == 0};
    number_faces_as_in_files(drawing, stage.models.inputs);
    Stopwatch watch;
    add_areas(drawing, stage.seen, stage.command.areas, stage.command.style);
    progress.times.shade += watch.lap();
    return drawing;
}

Drawing draw_sheet(const Stage& stage, const Sheet& sheet, Progress& progress, Console& console)
{
    std::vector<Drawing> pictures;
    for (std::size_t i = 0; i < sheet.cameras.size(); ++i) {
        const double views = double(progress.views.size()), prepared = preparing(stage.command);
        console.progress(fmt::format("drawing view {} of {}", progress.drawn + 1, views), prepared + (1 - prepared) * double(progress.drawn) / views);
        pictures.push_back(draw_view(stage, progress));
        pictures.back().mm_per_pixel = sheet.mm_per_pixel;
    }
    if (pictures.size() == 1)
        return std::move(pictures.front());
    return lay_on_sheet(std::move(pictures), sheet.corners, sheet.size, stage.command.view.views);
}

/// "turn-007.svg".
std::string numbered(const std::string& path, int number)
{
    const std::filesystem::path file(path);
    return (file.parent_path() / fmt::format("{}-{:03}{}", file.stem().string(), number, file.extension().string())).string();
}

void write_outputs(const Drawing& drawing, const std::vector<Output>& outputs, const Style& style, Times& times)
{
    Stopwatch watch;
    for (const Output& output : outputs)
        write_drawing(drawing, style, output.path, output.format);
    times.write += watch.lap();
}

std::size_t stroke_count(const std::vector<DrawnView>& views)
{
    std::size_t count = 0;
    for (const DrawnView& view : views)
        for (const DrawReport::PerType& type : view.report.types)
            count += type.strokes;
    return count;
}

/// Says all warnings as one line, or throws them when the command is strict.
void settle(const Warnings& warnings, const CommonOptions& options, Console& console)
{
    if (warnings.empty())
        return;
    if (options.strict)
        throw Error::Read(warnings.line() + " (--strict)");
    console.warn(warnings.line());
}

Warnings warnings_of(const Models& models, const std::vector<DrawnView>& views)
{
    Warnings warnings;
    for (const Input& input : models.inputs)
        warnings.add(input.file, input.notes);
    std::vector<EyePlace> eyes;
    for (const DrawnView& view : views)
        eyes.push_back(view.eye);
    warnings.add("camera", eye_notes(eyes));
    return warnings;
}

void check_turntable(const DrawCommand& command, const std::vector<Output>& outputs)
{
    if (command.turntable == 0)
        return;
    if (command.view.views.size() > 1)
        throw Error::Input("--turntable turns one view; give --view once");
    for (const Output& output : outputs)
        if (output.path == "-")
            throw Error::Input("--turntable writes numbered files; -o - cannot hold them");
}

/// The pictures of a run: the frames of a turntable, or one sheet.
std::vector<Sheet> all_sheets(const DrawCommand& command, const Models& models)
{
    const char up_axis = up_axis_of(command.view, models.inputs.front().format);
    const Scene scene = {models.lines, models.bounds()};
    if (command.turntable > 0)
        return turntable(command.view, scene, up_axis, command.turntable);
    return {place_cameras(command.view, scene, up_axis)};
}

/// The views of a run before they are drawn: where their eyes are is known before a file is written.
std::vector<DrawnView> views_of(const Stage& stage, const std::vector<Sheet>& sheets)
{
    std::vector<DrawnView> views;
    for (const Sheet& sheet : sheets)
        for (const Camera& camera : sheet.cameras) {
            views.emplace_back().camera = camera;
            views.back().eye = place_of_eye(stage.models.lines, stage.rays, camera);
        }
    return views;
}

/// Draws and writes every picture. @return the names of the written files.
std::vector<std::string> draw_all(const Stage& stage, const std::vector<Sheet>& sheets, const std::vector<Output>& outputs, Progress& progress,
                                  Console& console)
{
    const DrawCommand& command = stage.command;
    std::vector<std::string> written;
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        const Drawing drawing = draw_sheet(stage, sheets[i], progress, console);
        std::vector<Output> files = outputs;
        for (Output& file : files) {
            if (command.turntable > 0)
                file.path = numbered(file.path, int(i));
            written.push_back(file.path);
        }
        write_outputs(drawing, files, command.style, progress.times);
    }
    return written;
}

void run(DrawCommand& command)
{
    Stopwatch total;
    if (command.model.files.empty())
        throw Error::Input("no model given; see 'limn draw --help'");
    const std::vector<Output> outputs = checked_outputs(command.common, known_formats());
    if (outputs.empty() && !command.common.json)
        throw Error::Input("nothing to do: give -o FILE (svg, pdf, png, dxf, json, ply) or --json");
    check_turntable(command, outputs);
    check_cpu_only(command.common, "draw");
    check_view_options(command.view);
    Console console(command.common.quiet);

    if (!command.lines_given && (command.style.look == Look::dark || command.style.look == Look::toon))
        command.lines.lines.push_back(LineType::highlight);
    command.model.prepare.estimate.need = surface_need(command.lines);
    command.model.prepare.crease.angle = command.lines.crease_angle;
    const Models models = prepare_models(command.model, console, 0.8 * preparing(command));
    Progress progress;
    Stopwatch watch;
    console.progress("building the ray tracer's tree", 0.8 * preparing(command));
    const RayScene rays = build_ray_scene(models.lines);
    progress.times.rays = watch.lap();
    console.progress("finding creases and borders", 0.95 * preparing(command));
    const Stage stage = {command, models, rays, find_line_features(models.lines, command.lines, std::max(command.turntable, 1)), seen_scene(models.lines, rays)};
    progress.times.features = watch.lap();
    const std::vector<Sheet> sheets = all_sheets(command, models);
    progress.views = views_of(stage, sheets);
    const Warnings warnings = warnings_of(models, progress.views);
    settle(warnings, command.common, console); // before the first file, so that --strict leaves none
    const std::vector<std::string> written = draw_all(stage, sheets, outputs, progress, console);
    progress.times.total = total.total();
    if (command.common.json)
        write_file("-", draw_report(models, progress.views, written, warnings, progress.times));
    console.finish(fmt::format("{}: {}, {}, {}", what_was_written(written), counted(models.triangle_count(), "triangle"),
                               counted(stroke_count(progress.views), "stroke"), seconds_text(progress.times.total)));
}

} // namespace

Subcommand add_draw(CLI::App& limn)
{
    auto command = std::make_shared<DrawCommand>();
    CLI::App* app = limn.add_subcommand("draw", "Draw the lines of models, hidden lines removed");
    app->footer(examples);
    app->add_option("MODEL", command->model.files, "files to draw together, in any mesh format; '-' is standard input");
    add_table_options(*app, line_option_table(), command->lines, "Lines");
    add_table_options(*app, style_option_table(), command->style, "Look and page");
    add_table_options(*app, estimate_option_table(), command->model.prepare.estimate, "Surface");
    app->add_flag("--fill", command->areas.fill, "fill the shape's silhouette under the lines (always so with --style dark)")
        ->group("Look and page");
    app->add_option("--shade", command->areas.shade, "none|smooth|flat: a shaded picture under the lines (default none)")
        ->type_name("X")
        ->transform(CLI::Transformer(std::map<std::string, Shade>{{"none", Shade::none}, {"smooth", Shade::smooth}, {"flat", Shade::flat}}))
        ->group("Look and page");
    app->add_option("--from", command->model.from, "format of the models, whatever their names end in")
        ->type_name("FORMAT")
        ->group("Input");
    app->add_option("--cache", command->model.prepare.cache, "keep estimated surfaces in this folder, and use them again")
        ->type_name("FOLDER")
        ->group("Input");
    add_view_options(*app, command->view);
    app->add_option("--turntable", command->turntable, "draw N views around the model into FILE-000, FILE-001, ...")
        ->type_name("N")
        ->check(CLI::Range(1, 100000))
        ->group("Camera");
    add_common_options(*app, command->common,
                       "file to write; may be given several times: svg, pdf, png, dxf, json, ply; '-' is standard output");
    return {app, [command, app] {
                command->lines_given = app->count("--lines") > 0;
                with_threads(command->common.threads, [&] { run(*command); });
            }};
}
