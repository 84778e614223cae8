#pragma once

#include <span>
#include <string>
#include <vector>

#include "limn/drawing/drawing.h"

namespace limn {

struct SheetOptions {
    int columns = 0;                   ///< 0: as many as bring the sheet nearest to 4 : 3
    double gap = 0.03;                 ///< free space between the pictures, as a part of the larger side of a cell
    std::vector<std::string> captions; ///< one for each drawing, under it; empty: none
};

/// Lays drawings out in rows, each in the middle of a cell as large as the largest of them, as one drawing. Its camera
/// is the first one's with the size of the sheet: points in the picture count, other views' cameras are lost.
/// @throws Error::Input for no drawing, another number of captions, or drawings of different true scale.
Drawing make_sheet(std::span<const Drawing> drawings, const SheetOptions& options = {});

} // namespace limn
