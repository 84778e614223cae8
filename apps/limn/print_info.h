#pragma once

#include <string>

#include "limn/pattern/read_gcode.h"

/// True where `limn info` and `limn render` take a file as G-code: `from`, or the file's ending where that says nothing.
bool is_gcode(const std::string& file, const std::string& from);

/// What a print's beads are. Both end with a line end.
std::string print_text(const limn::PrintPath& path);
std::string print_json(const limn::PrintPath& path, const std::string& file, double seconds);

/// "1 h 2 min", "3 min 20 s".
std::string duration_text(double seconds);
