#pragma once

#include <vector>

#include "limn/raycast/outline_error.h"
#include "limn/subdivision/local_tolerance.h"

namespace limn {

/// A piece of an outline in the picture, in pixels.
struct PictureLine {
    dvec2 a, b;
    double error = 0; ///< how far it may be off
    dvec2 outside = dvec2(0); ///< across it, away from the surface; 0 where that is not known
};

/// Where lines must be nearer than elsewhere for the corner of a gap between them.
struct AcuteCorner {
    TightPlace place;
    double opening = 0; ///< pixels from there to where the gap is wide enough to be seen
};

/// Where pieces of outlines cross at acute angles, or may when they are as far off as they may be, or run beside each other as near as that.
/// The corner of the gap between two lines that cross at an angle moves by their error over the sine of half the angle, so lines have to be
/// nearer there for the corner to be as near as is wanted.
/// Of lines whose surfaces lie on the same side of both there is no gap between, as beside cusps; these do not count. Parallel.
/// @param lines   those that have an end in common are taken to be parts of one curve
/// @param corner  pixels: how far corners may be off
/// @param least   pixels: lines need not be nearer than that
std::vector<AcuteCorner> acute_corners(std::vector<PictureLine> lines, double corner, double least);

/// The places of those corners that are near a pixel that nothing covers: what surfaces hide is no outline.
/// @param covered  by front faces, one sample in each pixel
std::vector<TightPlace> beside_background(const std::vector<AcuteCorner>& corners, const OutlineMask& covered);

} // namespace limn
