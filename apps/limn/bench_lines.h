#pragma once

#include "benchmark.h"

/// Times surfaces, extraction in all variants, whole views and whole runs. All variants of one table take turns in one run.
BenchResult bench_lines(const BenchRequest& request, Console& console);
