#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "limn/pattern/cusp.h"
#include "limn/pattern/options.h"
#include "pictures.h"

/// What `limn render` is told of bricks, thread and layers.
struct PatternCommand {
    limn::PatternOptions options;
    std::string heights;                      ///< the file with a print's layer heights, or ""
    std::string note;                         ///< what was found, once a picture is made
    std::optional<limn::CuspHistogram> cusps; ///< of a print whose cusp heights a picture shows
    bool is_wanted() const { return options.kind != limn::PatternKind::plain; }
    /// A print stands on its build plate, where layers go up.
    bool stands_on_plate() const { return options.kind == limn::PatternKind::layers && !options.direction; }
};

void add_pattern_options(CLI::App& app, PatternCommand& command);

/// Takes what a scene says, except what the command line says itself, and reads the table of heights.
/// @param scene  or null  @throws limn::Error::Read, limn::Error::Input
void take_pattern(const CLI::App& app, const limn::Scene* scene, PatternCommand& command);

/// How patterns lie on the objects of a run.
limn::PatternPlace pattern_place(const PatternCommand& command, const PictureCommand& pictures, const limn::dvec3& up);

/// What the report holds of them: the histogram of cusp heights where they are shown, else nothing. An object.
nlohmann::ordered_json report_of(const PatternCommand& command);

/// Explains a picture: the colours of cusp heights in it, and layers and sizes for the last line of the run.
void explain_pattern(PatternCommand& command, const limn::PatternPlace& place, const limn::SeenScene& scene, limn::Drawing& drawing);
