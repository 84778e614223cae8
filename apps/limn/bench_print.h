#pragma once

#include "benchmark.h"

/// Reading and drawing G-code: the vase of `limn sample` with half a million moves (or `sizes`).
BenchResult bench_print(const BenchRequest& request, Console& console);
