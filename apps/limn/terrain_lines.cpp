#include "terrain_lines.h"

#include <cmath>

#include "console.h"
#include "table_options.h"

using namespace limn;

namespace {

OptionRow<TerrainLines> show_row()
{
    using Show = TerrainLines::Show;
    return choice_row<TerrainLines, Show>("show", {{"usual", Show::usual}, {"shaded", Show::shaded}, {"lines", Show::lines}, {"both", Show::both}},
                                          "what pictures show; usual: png the shaded terrain, svg, pdf and dxf lines; both: lines over the shaded terrain",
                                          &TerrainLines::show);
}

const OptionTable<TerrainLines>& show_table()
{
    static const OptionTable<TerrainLines> table = {show_row()};
    return table;
}

} // namespace

void add_terrain_line_options(CLI::App& app, TerrainLines& lines)
{
    add_table_options(app, show_table(), lines, "Lines");
    add_table_options(app, terrain_line_option_table(), lines.options, "Lines");
    add_table_options(app, terrain_shape_line_table(), lines.options.lines, "Lines");
    app.get_option("--lines")->each([&lines](const std::string&) { lines.lines_given = true; });
    add_table_options(app, style_option_table(), lines.style, "Look and page");
}

bool is_line_format(const std::string& format) { return format == "svg" || format == "pdf" || format == "dxf"; }

bool has_lines(const TerrainLines& lines, const Output& output)
{
    if (!is_line_format(output.format) && output.format != "png")
        return false;
    return lines.show == TerrainLines::Show::usual ? output.format != "png" : lines.show != TerrainLines::Show::shaded;
}

bool has_shading(const TerrainLines& lines, const Output& output)
{
    if (!is_line_format(output.format) && output.format != "png")
        return false;
    return lines.show == TerrainLines::Show::usual ? output.format == "png" : lines.show != TerrainLines::Show::lines;
}

TerrainLineOptions lines_for(const TerrainLines& lines, const Camera& camera, double exaggerate)
{
    TerrainLineOptions options = lines.options;
    options.exaggerate = exaggerate;
    if (!lines.lines_given && options.iso.value > 0 && is_plan(camera))
        options.lines.lines = {LineType::border};
    return options;
}

std::optional<TerrainBound> usual_bound(const Camera& camera)
{
    return is_plan(camera) ? std::nullopt : std::optional(TerrainBound{0.1, true});
}

nlohmann::ordered_json terrain_lines_json(const TerrainLines& lines)
{
    nlohmann::ordered_json json;
    for (const OptionRow<TerrainLines>& row : show_table())
        json[row.name] = row.get(lines);
    for (const OptionRow<TerrainLineOptions>& row : terrain_line_option_table())
        json[row.name] = row.get(lines.options);
    for (const OptionRow<LineOptions>& row : terrain_shape_line_table())
        json[row.name] = row.get(lines.options.lines);
    return json;
}

std::string what_was_drawn(const DrawReport& report)
{
    std::size_t strokes = 0;
    for (const DrawReport::PerType& type : report.types)
        strokes += type.strokes;
    return counted(strokes, "stroke");
}
