#pragma once

#include <vector>

#include "limn/lines/segment.h"

namespace limn {

/// Leaves out the segments of chains whose length times ink is below `min_length` (units of the segments); the others keep
/// their order. Lines found from derivatives of curvature need this: noise makes short pieces of them everywhere.
void drop_short_chains(std::vector<Segment>& segments, double min_length);

/// The same without a jump, for drawings that move: a chain fades in between `min_length` and twice that.
void fade_short_chains(std::vector<Segment>& segments, double min_length);

} // namespace limn
