#pragma once

#include "benchmark.h"

/// How well lines found per pixel (M6 to M10) agree with those of the objects' space (contour-lines specification, checklist item 26):
/// precision, recall, F1 and chamfer distance of every method on several models, which are shapes of `limn sample` or files.
BenchResult bench_agreement(const BenchRequest& request, Console& console);
