#include "render_print.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "console.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/drawing/sheet.h"
#include "limn/pattern/filament.h"
#include "limn/scene/print_legend.h"
#include "limn/scene/print_picture.h"
#include "models.h"
#include "print_info.h"
#include "table_options.h"

using namespace limn;

namespace {

constexpr const char* group = "G-code";

bool is_among(std::string_view name, std::initializer_list<std::string_view> names)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

template <class Options> void refuse(const CLI::App& app, const OptionTable<Options>& table, std::initializer_list<std::string_view> but)
{
    for (const OptionRow<Options>& row : table)
        if (!is_among(row.name, but) && app.count("--" + row.name) > 0)
            throw Error::Input(fmt::format("--{}: G-code is drawn bead by bead; that option is for meshes", row.name));
}

/// What says nothing of beads.
void refuse_mesh_options(const CLI::App& app, const PatternOptions& pattern)
{
    refuse(app, line_option_table(), {});
    refuse(app, estimate_option_table(), {});
    refuse(app, subdivision_option_table(), {});
    refuse(app, image_line_option_table(), {});
    refuse(app, shader_line_option_table(), {});
    refuse(app, render_option_table(),
           {"light", "lamp", "shadow", "shadow-samples", "background", "ground", "ground-colour", "samples", "bits"});
    refuse(app, pattern_option_table(),
           {"material", "filament", "print-colour", "reflection", "specular", "exponent", "variety", "pattern-filter", "filter-width",
            "filter-box"});
    for (const char* option : {"--pass", "--overlay", "--shadow-maps", "--layer-heights", "--cache", "--up-axis"})
        if (app.count(option) > 0)
            throw Error::Input(fmt::format("{}: G-code is drawn bead by bead; that option is for meshes", option));
    if (pattern.kind != PatternKind::plain && pattern.kind != PatternKind::layers)
        throw Error::Input("--material: G-code is drawn as the beads it makes; leave --material out");
    if (pattern.filter != PatternFilter::gauss && pattern.filter != PatternFilter::box)
        throw Error::Input("--pattern-filter: beads are filtered with gauss or box");
}

/// The ends of all beads, which cameras have to show.
LineModel ends_of(const PrintPath& path, const SeenPrint& print)
{
    LineModel model;
    model.centre = print.centre;
    model.scale = print.scale;
    vec3 from = path.start;
    for (const PrintMove& move : path.moves) {
        if (move.extrudes()) {
            model.positions.push_back(model.from_world(dvec3(from)));
            model.positions.push_back(model.from_world(dvec3(move.to) - dvec3(0, 0, double(move.height))));
        }
        from = move.to;
    }
    model.positions.emplace_back(0); // the spare one
    return model;
}

ShadeOptions shading_of(const CLI::App& app, RenderOptions& render, const SeenPrint& print)
{
    if (render.shadow == ShadowMethod::maps)
        throw Error::Input("--shadow csm: maps are of meshes; --shadow ray does without");
    const bool shadows = render.shadow == ShadowMethod::rays || (render.shadow == ShadowMethod::automatic && render.wide);
    const bool ground = render.ground || app.count("--ground") == 0;
    render.shadow = ShadowMethod::nothing;
    render.ground = false; // those of a print are its own
    ShadeOptions shade = shade_options(render, {nullptr, {}, print.centre, print.scale, {}}, {0, 0, 1});
    if (shadows)
        shade.occlusion = bead_occlusion(print);
    if (ground) {
        shade.ground = plate_under(print);
        shade.ground->material = {render.ground_colour, render.shade};
    }
    return shade;
}

struct PrintTimes {
    double read = 0, tree = 0, paint = 0, write = 0;
};

std::string report(const std::string& file, const PrintPath& path, const SeenPrint& print, const std::vector<Sheet>& sheets,
                   const std::vector<std::string>& written, const PrintTimes& times)
{
    nlohmann::ordered_json views = nlohmann::ordered_json::array();
    for (const Sheet& sheet : sheets)
        for (const Camera& camera : sheet.cameras)
            views.push_back({{"camera", nlohmann::ordered_json::parse(camera_to_json(camera))}});
    const nlohmann::ordered_json json = {
        {"limn", LIMN_VERSION},
        {"command", "render"},
        {"device", "processor"},
        {"file", file},
        {"print", {{"layers", path.layers.size()}, {"moves", path.moves.size()}, {"shown", print.moves.size()}}},
        {"views", views},
        {"warnings", path.notes},
        {"outputs", written},
        {"seconds", {{"read", times.read}, {"tree", times.tree}, {"paint", times.paint}, {"write", times.write}}}};
    return json.dump(2) + "\n";
}

std::string note_of(const PrintPath& path, const SeenPrint& print, const PrintOptions& options)
{
    const int last = std::min(options.last_layer, int(path.layers.size()));
    const std::string layers = options.first_layer == 1 && last == int(path.layers.size())
                                   ? counted(path.layers.size(), "layer")
                                   : fmt::format("layers {} to {} of {}", options.first_layer, last, path.layers.size());
    const dvec3 size = print.bounds.size();
    return fmt::format("{}, {:.4g} x {:.4g} x {:.4g} mm", layers, size.x, size.y, size.z);
}

} // namespace

void add_print_options(CLI::App& app, PrintOptions& options)
{
    add_table_options(app, print_option_table(), options, group);
    add_table_options(app, gcode_option_table(), options.gcode, group);
}

bool is_print(const PictureCommand& pictures)
{
    const auto prints =
        std::count_if(pictures.files.begin(), pictures.files.end(), [&](const std::string& file) { return is_gcode(file, pictures.from); });
    if (prints > 0 && pictures.files.size() > 1)
        throw Error::Input("a print from G-code is drawn alone; give one file");
    return prints > 0;
}

void refuse_print_options(const CLI::App& app)
{
    const auto refuse_row = [&](const std::string& name) {
        if (app.count("--" + name) > 0)
            throw Error::Input(fmt::format("--{} is of G-code, and no file is; --from gcode says that one is", name));
    };
    for (const auto& row : print_option_table())
        refuse_row(row.name);
    for (const auto& row : gcode_option_table())
        refuse_row(row.name);
}

void render_print(const CLI::App& app, PictureCommand& pictures, RenderOptions& render, const PatternOptions& pattern,
                  const PrintOptions& options, const std::function<void(const Drawing&, const Output&)>& write)
{
    const Stopwatch total;
    refuse_mesh_options(app, pattern);
    if (pictures.common.device == "gpu")
        throw Error::Input("--device gpu: beads are drawn on the CPU so far; leave --device out, or say cpu");
    const std::vector<Output> outputs = checked_outputs(pictures.common, pictures.formats);
    if (outputs.empty() && !pictures.common.json)
        throw Error::Input(fmt::format("nothing to do: give -o FILE ({}) or --json", join(pictures.formats, ", ")));
    check_numbered(pictures, outputs);
    check_view_options(pictures.view);
    Console console(pictures.common.quiet);
    PrintTimes times;
    Stopwatch watch;
    const std::string& file = pictures.files.front();
    console.progress("reading " + file, 0);
    const PrintPath path = read_gcode(file, options.gcode);
    times.read = watch.lap();
    console.progress("building the ray tracer's tree", 0.1);
    const SeenPrint print = see_print(path, options);
    const ShadeOptions shade = shading_of(app, render, print);
    times.tree = watch.lap();
    Warnings warnings;
    warnings.add(file, path.notes);
    if (pictures.common.strict && !warnings.empty())
        throw Error::Read(warnings.line() + " (--strict)");
    if (!warnings.empty())
        console.warn(warnings.line());
    const std::vector<Sheet> sheets = all_sheets(pictures, {ends_of(path, print), print.bounds}, 'z');
    const PrintLegend legend = BeadColours(path, options, find_filament(pattern.filament).colour).legend();
    std::vector<std::string> written;
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        const Sheet& sheet = sheets[i];
        std::vector<Drawing> drawings;
        for (const Camera& camera : sheet.cameras) {
            console.progress("drawing beads", 0.2 + 0.8 * double(i) / double(sheets.size()));
            Drawing& drawing = drawings.emplace_back();
            drawing.camera = camera;
            drawing.mm_per_pixel = sheet.mm_per_pixel;
            drawing.background = paint_print(print, path, camera, options, pattern, shade);
        }
        Drawing drawing = drawings.size() == 1 ? std::move(drawings.front())
                                               : lay_on_sheet(std::move(drawings), sheet.corners, sheet.size, pictures.view.views);
        add_print_legend(drawing, legend);
        times.paint += watch.lap();
        for (const Output& output : outputs) {
            const std::string name = sheets_are_numbered(pictures) ? numbered(output.path, int(i)) : output.path;
            write(drawing, {name, output.format});
            written.push_back(name);
        }
        times.write += watch.lap();
    }
    if (pictures.common.json)
        write_file("-", report(file, path, print, sheets, written, times));
    console.finish(fmt::format("{}: {}, {}; {}", what_was_written(written), counted(print.moves.size(), "bead"),
                               seconds_text(total.total()), note_of(path, print, options)));
}
