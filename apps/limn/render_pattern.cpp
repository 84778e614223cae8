#include "render_pattern.h"

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/pattern/layer_stack.h"
#include "limn/scene/cusp_legend.h"
#include "scene_file.h"
#include "table_options.h"

using namespace limn;

void add_pattern_options(CLI::App& app, PatternCommand& command)
{
    add_table_options(app, pattern_option_table(), command.options, "Material");
    app.add_option("--layer-heights", command.heights,
                   "heights of a print's layers, mm: one a line from the lowest, or Z and the height from there on")
        ->type_name("FILE")
        ->group("Material");
}

void take_pattern(const CLI::App& app, const Scene* scene, PatternCommand& command)
{
    if (scene) {
        take_options(app, pattern_option_table(), scene->pattern, command.options);
        command.options.layer_heights = scene->pattern.layer_heights;
    }
    if (command.options.kind != PatternKind::layers) {
        for (const char* option : {"--layer-heights", "--layer-height", "--first-layer", "--print-direction", "--show", "--overhang"})
            if (app.count(option) > 0)
                throw Error::Input(fmt::format("{} is of prints; give --material layers too", option));
        return;
    }
    if (command.heights.empty())
        return;
    if (app.count("--layer-height") + app.count("--first-layer") > 0)
        throw Error::Input("--layer-heights and --layer-height both say how high layers are; give one");
    command.options.layer_heights = layer_heights_from_text(read_file(command.heights), command.heights);
}

PatternPlace pattern_place(const PatternCommand& command, const PictureCommand& pictures, const dvec3& up)
{
    PatternPlace place;
    place.up = up;
    const SceneObject& first = pictures.model.objects.front();
    place.mm_per_unit = mm_per_unit(command.options.units, input_format(first.file.string(), first.format)).value_or(0);
    for (const SceneObject& object : pictures.model.objects)
        place.transforms.push_back(object.transform);
    return place;
}

void explain_pattern(PatternCommand& command, const PatternPlace& place, const SeenScene& scene, Drawing& drawing)
{
    command.note.clear();
    command.cusps.reset();
    if (command.options.kind != PatternKind::layers)
        return;
    const PatternOptions& options = command.options;
    command.note = options.layer_heights.empty() ? fmt::format("layers of {} mm", options.layer_height)
                                                 : fmt::format("{} layers from the table", options.layer_heights.size());
    if (place.mm_per_unit == 0)
        command.note += ", the longest side taken as 100 mm (--units tells otherwise)";
    else
        command.note += fmt::format(", the longest side is {:.4g} mm", longest_side(scene) * place.mm_per_unit);
    if (options.show != PrintShow::cusp)
        return;
    command.cusps = print_cusps(scene, options, place);
    command.note += ", " + command.cusps->line();
    add_cusp_legend(drawing, *command.cusps);
}

nlohmann::ordered_json report_of(const PatternCommand& command)
{
    nlohmann::ordered_json report = nlohmann::ordered_json::object();
    if (command.cusps)
        report["cusps"] = {{"unit", "mm"},
                           {"most", command.cusps->most},
                           {"mean", command.cusps->mean},
                           {"median", command.cusps->middle},
                           {"shares", command.cusps->shares}};
    return report;
}
