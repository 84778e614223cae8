#pragma once

#include <string>

#include "bench_table.h"
#include "console.h"

/// Milliseconds for a frame of each pattern: on the processor, and on a device as a window draws it.
struct FrameTimes {
    MarkdownTable table = MarkdownTable(
        {"pattern", "shape, triangles", "picture", "processor", "device", "outlines of 4 samples", "50 samples", "frames a second"});
    std::string device; ///< its name; "none" where there is none
};

/// @param runs  to take medians over, at least 1
FrameTimes time_pattern_frames(int runs, Console& console);
