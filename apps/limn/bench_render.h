#pragma once

#include "benchmark.h"

/// Frames of every method that finds or draws lines, by the protocol of the study behind the contour-lines specification (section 4): the
/// object turns about each of its axes before a camera that a face of its box fills; over five sizes of mesh and over sizes of picture; and
/// whole processes beside f3d where that is installed.
BenchResult bench_render(const BenchRequest& request, Console& console);
