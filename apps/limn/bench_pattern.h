#pragma once

#include "benchmark.h"

/// Patterns: the analytic filter beside samples, their errors, times and moiré.
BenchResult bench_pattern(const BenchRequest& request, Console& console);
