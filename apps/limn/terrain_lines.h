#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "common.h"
#include "limn/drawing/style.h"
#include "limn/scene/terrain_drawing.h"
#include "limn/terrain/terrain_build.h"

/// What `limn terrain` draws in lines, and on what.
struct TerrainLines {
    /// What pictures show.
    enum class Show {
        usual,  ///< lines in formats of lines, else the shaded terrain
        shaded,
        lines,
        both, ///< lines over the shaded terrain
    } show = Show::usual;
    limn::TerrainLineOptions options;
    bool lines_given = false; ///< --lines
    limn::Style style;
};

/// --show, --iso and the other options of terrain drawings, and those of paper and pens.
void add_terrain_line_options(CLI::App& app, TerrainLines& lines);

/// Formats that `limn terrain` writes lines in: svg, pdf, dxf, and where --show says so, png.
bool is_line_format(const std::string& format);

/// Whether an output is a drawing of lines, on a shaded picture or not.
bool has_lines(const TerrainLines& lines, const Output& output);
/// Whether an output shows the shaded terrain, under lines or not.
bool has_shading(const TerrainLines& lines, const Output& output);

/// What is drawn for a camera: plans with iso lines have no other lines but the map's border, unless --lines asks for them.
limn::TerrainLineOptions lines_for(const TerrainLines& lines, const limn::Camera& camera, double exaggerate);

/// The bound of a drawing's mesh where none is asked for: a tenth of a pixel, or where the camera looks straight down and no error of height shows, none.
std::optional<limn::TerrainBound> usual_bound(const limn::Camera& camera);

nlohmann::ordered_json terrain_lines_json(const TerrainLines& lines);

/// "128 strokes".
std::string what_was_drawn(const limn::DrawReport& report);
