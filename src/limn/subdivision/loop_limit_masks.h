#pragma once

#include <map>
#include <vector>

#include "limn/subdivision/loop_masks.h"

namespace limn {

/// Weights of a vertex and of its neighbours; those of a tangent add up to 0.
struct RingMask {
    double self = 0;
    std::vector<double> points;
};

struct LimitMasks {
    RingMask position, u, v;
};

/// At a vertex without sharp edges, or a dart under the rule of Hoppe et al. u points to the first neighbour.
LimitMasks smooth_limit_masks(std::size_t valence);

/// At a dart whose first edge is the sharp one; u points along it, seen from above. From the local subdivision matrix.
/// @throws Error::Input for a valence below 2.
LimitMasks dart_limit_masks(std::size_t valence, CreaseRule rule);

/// Of a crease: the weight of the vertex; its two neighbours along the crease have half of the rest each.
double crease_limit_weight(bool regular, CreaseRule rule);

/// The tangent across a crease, inwards: weights of the points of a sector with both of its creases.
/// @param points   2 or more; one more than triangles
/// @param regular  EdgeEnd::regular of the vertex
RingMask across_mask(std::size_t points, bool regular, CreaseRule rule);

} // namespace limn
