#pragma once

#include <functional>

#include "limn/pattern/print_options.h"
#include "limn/scene/render_options.h"
#include "pictures.h"

void add_print_options(CLI::App& app, limn::PrintOptions& options);

/// Whether the files are G-code, which `limn render` draws bead by bead. @throws limn::Error::Input for G-code among other files
bool is_print(const PictureCommand& pictures);

/// @throws limn::Error::Input where an option of G-code was given, and there is none
void refuse_print_options(const CLI::App& app);

/// Draws a print from its G-code, and writes every picture.
/// @param write  a picture with its legend to one of the files
/// @throws limn::Error::Input for options that are of meshes, limn::Error::Read as read_gcode
void render_print(const CLI::App& app, PictureCommand& pictures, limn::RenderOptions& render, const limn::PatternOptions& pattern,
                  const limn::PrintOptions& print, const std::function<void(const limn::Drawing&, const Output&)>& write);
