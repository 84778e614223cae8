#pragma once

#include <filesystem>

#include "console.h"

/// Writes figures 5.1 to 5.28 of the study behind patterns ("Procedural modelling of regular structures", 2017) into a folder, one PNG each, as far as they can be
/// computed: its scans are not at hand, so generated shapes stand for its bunny (a faceted blob), toad (a knot) and angel (rings), and rays that meet real
/// steps for its photographs. The same bytes each time.
/// @throws limn::Error::Input where the folder cannot be made
void write_pattern_figures(const std::filesystem::path& folder, Console& console);
