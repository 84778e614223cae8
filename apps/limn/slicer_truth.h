#pragma once

#include <string>

#include "bench_table.h"
#include "console.h"

/// Models of layers beside what rays meet of the beads that a slicer laid for the same part.
struct SlicerTable {
    std::string slicer; ///< "PrusaSlicer 2.5.0"; "" where none is installed
    MarkdownTable errors =
        MarkdownTable({"part", "px a layer", "pieces", "FLIP: seed", "FLIP: slope", "FLIP: beads", "FLIP: G-code", "highlight: truth",
                       "highlight: seed", "highlight: slope", "highlight: beads", "highlight: G-code"});
};

inline constexpr double sliced_layer = 0.2; ///< mm

/// A ball and a cone, 20 mm wide, sliced by prusa-slicer with settings of our own and drawn by rays, by the models, and as `limn render` draws G-code. Without a
/// prusa-slicer the table is empty. @param width  of a picture, pixels
/// @throws limn::Error::Device where the slicer fails
SlicerTable compare_with_slicer(int width, Console& console);
