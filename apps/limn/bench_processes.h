#pragma once

#include "bench_table.h"

/// Whole processes from a PLY file to a PNG of 1280 x 720: `limn render` with and without lines, and f3d's plain shaded picture where `f3d`
/// (and `xvfb-run`, since it needs a display) are installed. Median seconds and the largest memory of several runs that take turns.
MarkdownTable bench_processes(const std::string& shape, std::size_t triangles, int runs);
