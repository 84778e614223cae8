#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "limn/scene/scene.h"
#include "pictures.h"
#include "table_options.h"

/// Fills the objects of a command from the files of its command line: one for each model, or those of the one scene file. What a scene says of
/// view, surface, style and lines goes into the command too, except where the command line says it itself.
/// @return the scene, or nothing where models were given
/// @throws limn::Error::Read naming the scene file and the place in it, limn::Error::Input for a scene among other files.
std::optional<limn::Scene> take_files(const CLI::App& app, PictureCommand& command);

/// Puts `from` in place of the options, but for those that the command line gave.
template <class Options>
void take_options(const CLI::App& app, const limn::OptionTable<Options>& table, const Options& from, Options& options)
{
    options = from;
    for (const limn::OptionRow<Options>& row : table)
        for (const std::string& text : app.get_option("--" + row.name)->results())
            row.set(options, text);
}
