#pragma once

#include "benchmark.h"

/// Outlines of control meshes, and what they take beside uniform subdivision. Draws where there is a device, and measures OpenSubdiv where its
/// program is built.
BenchResult bench_silhouette(const BenchRequest& request, Console& console);
