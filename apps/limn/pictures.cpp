#include "pictures.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "console.h"
#include "draw_report.h"
#include "eyes.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/drawing/sheet.h"
#include "limn/lines/draw.h"
#include "limn/lines/regions.h"
#include "table_options.h"

using namespace limn;

namespace {

/// Models with what every view of them needs.
struct Stage {
    const PictureCommand& command;
    const PictureHooks& hooks;
    const Models& models;
    const RayScene& rays;
    LineFeatures features;
    SeenScene seen;
    /// @param view  of control meshes for one camera, or null: the same for all
    SeenModel model(const LoopView* view) const
    {
        return {view ? view->lines : models.lines, view ? view->seen : seen, up_vector(up_axis_of(command.view, models.inputs.front().format)), view};
    }
};

/// What is kept from view to view.
struct Progress {
    std::vector<DrawnView> views; ///< one for each camera of the run; the first `drawn` are filled
    std::size_t drawn = 0;
    ClusterHistory history;
    Times times;
    std::unique_ptr<const LoopView> loop_view; ///< of the last camera
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
double preparing(const PictureCommand& command) { return command.turntable > 10 ? 0.3 : 0.9; }

Drawing draw_view(const Stage& stage, Progress& progress)
{
    DrawnView& view = progress.next();
    Drawing drawing = draw_lines(stage.models.lines, stage.rays, stage.features, view.camera, stage.command.lines, &view.report, &progress.history);
    if (stage.features.clusters)
        view.clusters = {progress.history.survivors, progress.history.since_bounded == 0};
    number_faces_as_in_files(drawing, stage.models.inputs);
    Stopwatch watch;
    if (stage.command.shades_cut_meshes && !stage.models.loops.empty())
        progress.loop_view = make_loop_view(stage.models.loops, view.camera);
    stage.hooks.underlay(drawing, stage.model(progress.loop_view.get()));
    if (stage.hooks.overlay && progress.loop_view)
        stage.hooks.overlay(drawing, *progress.loop_view, stage.models);
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

/// One picture for each camera of a list.
std::vector<Sheet> listed_cameras(const std::string& file)
{
    std::vector<Sheet> sheets;
    for (const Camera& camera : cameras_from_json(read_file(file), file)) {
        Sheet& sheet = sheets.emplace_back();
        sheet.cameras = {camera};
        sheet.corners = {ivec2(0)};
        sheet.size = camera.size;
    }
    return sheets;
}

std::vector<Camera> cameras_of(const std::vector<Sheet>& sheets)
{
    std::vector<Camera> cameras;
    for (const Sheet& sheet : sheets)
        cameras.insert(cameras.end(), sheet.cameras.begin(), sheet.cameras.end());
    return cameras;
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
    const PictureCommand& command = stage.command;
    std::vector<std::string> written;
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        const Drawing drawing = draw_sheet(stage, sheets[i], progress, console);
        for (Output file : outputs) {
            if (sheets_are_numbered(command))
                file.path = numbered(file.path, int(i));
            Stopwatch watch;
            for (std::string& name : stage.hooks.write(drawing, stage.model(progress.loop_view.get()), file))
                written.push_back(std::move(name));
            progress.times.write += watch.lap();
        }
    }
    return written;
}

} // namespace

std::string numbered(const std::string& path, int number)
{
    const std::filesystem::path file(path);
    return (file.parent_path() / fmt::format("{}-{:03}{}", file.stem().string(), number, file.extension().string())).string();
}

bool sheets_are_numbered(const PictureCommand& command) { return command.turntable > 0 || !command.cameras.empty(); }

void check_numbered(const PictureCommand& command, const std::vector<Output>& outputs)
{
    if (!sheets_are_numbered(command))
        return;
    const std::string option = command.turntable > 0 ? "--turntable" : "--cameras";
    if (command.turntable > 0 && !command.cameras.empty())
        throw Error::Input("--turntable and --cameras both say where the cameras stand; give one");
    if (command.turntable > 0 && command.view.views.size() > 1)
        throw Error::Input("--turntable turns one view; give --view once");
    for (const Output& output : outputs)
        if (output.path == "-")
            throw Error::Input(option + " writes numbered files; -o - cannot hold them");
}

std::vector<Sheet> all_sheets(const PictureCommand& command, const Subject& subject, char up_axis)
{
    if (!command.cameras.empty())
        return listed_cameras(command.cameras);
    if (command.turntable > 0)
        return turntable(command.view, subject, up_axis, command.turntable);
    return {place_cameras(command.view, subject, up_axis)};
}

void add_picture_options(CLI::App& app, PictureCommand& command, const std::string& output_help)
{
    app.add_option("MODEL", command.files, "files to show together, in any mesh format, or one scene (.json); '-' is standard input");
    add_table_options(app, line_option_table(), command.lines, "Lines");
    add_table_options(app, style_option_table(), command.style, "Look and page");
    add_table_options(app, estimate_option_table(), command.model.prepare.estimate, "Surface");
    add_table_options(app, subdivision_option_table(), command.model.subdivision, "Subdivision");
    app.add_option("--from", command.from, "format of the models, whatever their names end in")->type_name("FORMAT")->group("Input");
    app.add_option("--cache", command.model.prepare.cache, "keep estimated surfaces in this folder, and use them again")
        ->type_name("FOLDER")
        ->group("Input");
    add_view_options(app, command.view);
    app.add_option("--turntable", command.turntable, "make N pictures around the model, FILE-000, FILE-001, ...")
        ->type_name("N")
        ->check(CLI::Range(1, 100000))
        ->group("Camera");
    app.add_option("--cameras", command.cameras, "make a picture for each camera of a JSON list, FILE-000, FILE-001, ...")
        ->type_name("FILE")
        ->group("Camera");
    add_common_options(app, command.common, output_help);
}

void make_pictures(PictureCommand& command, const PictureHooks& hooks)
{
    Stopwatch total;
    if (command.model.objects.empty())
        throw Error::Input(fmt::format("no model given; see 'limn {} --help'", command.name));
    const std::vector<Output> outputs = checked_outputs(command.common, command.formats);
    if (outputs.empty() && !command.common.json)
        throw Error::Input(fmt::format("nothing to do: give -o FILE ({}) or --json", join(command.formats, ", ")));
    check_numbered(command, outputs);
    if (!command.uses_gpu)
        check_cpu_only(command.common, command.name);
    check_view_options(command.view);
    Console console(command.common.quiet);

    command.model.prepare.estimate.need = std::max(command.need, surface_need(command.lines));
    command.model.prepare.crease.angle = command.lines.crease_angle;
    Models models = prepare_models(command.model, console, 0.8 * preparing(command));
    if (hooks.prepared)
        hooks.prepared(models);
    const std::vector<Sheet> sheets = all_sheets(command, {models.lines, models.bounds()}, up_axis_of(command.view, models.inputs.front().format));
    if (!models.loops.empty() && !command.lines.lines.empty())
        refine_for(models, cameras_of(sheets), command.model);
    Progress progress;
    Stopwatch watch;
    console.progress("building the ray tracer's tree", 0.8 * preparing(command));
    const RayScene rays = build_ray_scene(models.lines);
    progress.times.rays = watch.lap();
    console.progress("finding creases and borders", 0.95 * preparing(command));
    const Stage stage = {command, hooks, models, rays, find_line_features(models.lines, command.lines, std::max(command.turntable, 1)), seen_scene(models.lines, rays)};
    progress.times.features = watch.lap();
    progress.views = views_of(stage, sheets);
    const Warnings warnings = warnings_of(models, progress.views);
    settle(warnings, command.common, console); // before the first file, so that --strict leaves none
    const std::vector<std::string> written = draw_all(stage, sheets, outputs, progress, console);
    progress.times.total = total.total();
    if (command.common.json)
        write_file("-", draw_report(command.name, hooks.device ? hooks.device() : "processor", models, progress.views, written, warnings, progress.times,
                                    hooks.report ? hooks.report() : nlohmann::ordered_json::object()));
    const std::string note = hooks.note ? hooks.note() : "";
    console.finish(fmt::format("{}: {}, {}, {}{}", what_was_written(written), counted(progress.loop_view ? progress.loop_view->lines.faces.size() : models.triangle_count(), "triangle"),
                               counted(stroke_count(progress.views), "stroke"), seconds_text(progress.times.total), note.empty() ? "" : "; " + note));
}
