#pragma once

#include "benchmark.h"

/// Times uniform Loop subdivision: from an index buffer, of other poses, and of the limit, over levels and over sizes of the control mesh;
/// beside CGAL and OpenSubdiv where their programs are found (find_peer), and with the errors of OpenSubdiv's limits beside ours.
BenchResult bench_subdivision(const BenchRequest& request, Console& console);
