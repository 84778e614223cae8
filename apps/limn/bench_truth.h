#pragma once

#include <string>

#include "bench_table.h"
#include "console.h"
#include "limn/base/image.h"
#include "truth_stage.h"

/// Prints of models of layers beside prints that rays met as real steps.
struct TruthTables {
    MarkdownTable errors = MarkdownTable({"shape", "px a layer", "truth", "FLIP: seed", "FLIP: slope", "FLIP: beads", "highlight: truth",
                                          "highlight: seed", "highlight: slope", "highlight: beads"});
    limn::Image strip; ///< a row for each shape: flat steps (rays, seed, slope) and beads (rays, bead model)
};

/// @param width  of a picture, pixels
TruthTables compare_with_truth(int width, Console& console);
