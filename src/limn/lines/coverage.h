#pragma once

#include "limn/base/image.h"
#include "limn/lines/line_model.h"
#include "limn/lines/projector.h"

namespace limn {

/// A grid of samples over a part of a picture: sample (i, j) stands at pixel low + ((i, j) + 0.5) * spacing.
struct SampleGrid {
    dvec2 low = dvec2(0);
    double spacing = 1;     ///< px
    ivec2 size = ivec2(0);
};

/// Which samples any face covers, front or back: 1, else 0. A sample exactly on the common edge of two faces is covered.
/// What lies behind the eye, or nearer than a thousandth of the model's radius, covers nothing (perspective views).
Image rasterise_coverage(const LineModel& model, const Projector& projector, const SampleGrid& grid);

} // namespace limn
