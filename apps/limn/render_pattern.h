#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "limn/pattern/options.h"
#include "pictures.h"

/// What `limn render` is told of bricks, thread and layers.
struct PatternCommand {
    limn::PatternOptions options;
    std::string heights; ///< the file with a print's layer heights, or ""
    std::string note;    ///< what was found, once a picture is made
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

/// Explains a picture: the colours of cusp heights in it, and layers and sizes for the last line of the run.
void explain_pattern(PatternCommand& command, const limn::PatternPlace& place, const limn::SeenScene& scene, limn::Drawing& drawing);
