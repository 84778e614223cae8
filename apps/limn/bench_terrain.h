#pragma once

#include "benchmark.h"

/// Terrain: triangles within a bound and the time for them beside delatin, martini and a conservative RTIN by brute force; preparation of large
/// maps; and frames of a flight.
BenchResult bench_terrain(const BenchRequest& request, Console& console);
