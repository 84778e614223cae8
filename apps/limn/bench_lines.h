#pragma once

#include <string>
#include <vector>

#include "bench_table.h"
#include "console.h"

/// What `limn bench lines` measures.
struct LineBench {
    std::vector<std::size_t> sizes; ///< triangles, ascending
    std::vector<std::string> models = {"torus", "blob"};
    int views = 21;
};

/// What was measured of one model.
struct LineMeasures {
    std::string model;
    MarkdownTable extraction, views, runs;
    std::string exponents; ///< a sentence, or ""
};

/// Times surfaces, extraction in all variants, whole views and whole runs. All variants of one table take turns in one run.
/// @throws limn::Error::Input for an unknown model.
std::vector<LineMeasures> bench_lines(const LineBench& bench, Console& console);

/// The measures as a section of markdown.
std::string bench_text(const LineBench& bench, const std::vector<LineMeasures>& measures);
/// The same as JSON: per model each table as a list of rows, a member for each column; numbers as they stand in the text.
std::string bench_json(const LineBench& bench, const std::vector<LineMeasures>& measures);
