#pragma once

#include <span>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// Ink is drawn in this many steps: step k has opacity k / ink_steps; step 0 is not drawn.
inline constexpr int ink_steps = 8;

/// A run of a line with the same step of ink.
struct InkPiece {
    int step;                  ///< 1 to ink_steps
    std::uint32_t first, last; ///< indices into InkLine::points; a closed line has last = number of points
};

/// A line with points added where its ink changes to another step.
struct InkLine {
    std::vector<dvec2> points;
    std::vector<std::uint32_t> breaks; ///< the points where the step changes, ascending
    std::vector<InkPiece> pieces;      ///< in order along the line; neighbours share their end point
    bool closed = false;               ///< whole and of one step; an opened line starts where its ink changes
};

/// Splits a line by its ink, which runs linearly between points. The step follows the ink with a hysteresis of half a
/// step, so that noise does not shred a line, and where the ink changes fast, neighbours become one piece of their mean
/// step of about `shortest`, at least half of it. Empty `ink` is full ink everywhere.
/// @param shortest  unit of the points; only a run between two places without ink may be shorter than half of it
InkLine split_by_ink(std::span<const dvec2> points, std::span<const float> ink, bool closed, double shortest = 0);

} // namespace limn
