#pragma once

#include <string>
#include <vector>

#include "console.h"

/// What `limn bench lines` measures.
struct LineBench {
    std::vector<std::size_t> sizes; ///< triangles, ascending
    std::vector<std::string> models = {"torus", "blob"};
    int views = 21;
};

/// Times surfaces, extraction in all variants, whole views and whole runs, and returns the tables as markdown.
/// All variants of one table take turns in one run.
/// @throws limn::Error::Input for an unknown model.
std::string bench_lines(const LineBench& bench, Console& console);
