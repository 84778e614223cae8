#pragma once

#include <string>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// Colour (encoded) for a share in [0,1] of the most: from blue over green and yellow to red, lighter all the way to yellow.
vec3 cusp_colour(float share);

/// How much of a surface has which cusp height.
struct CuspHistogram {
    double most = 0;             ///< height of the thickest layer, mm
    double mean = 0, middle = 0; ///< mm, over the area; half of the area is below the middle
    std::vector<double> shares;  ///< of the area, in even steps from 0 to most
    /// "cusps to 0.2 mm, mean 0.081, half of the surface below 0.074"
    std::string line() const;
};

/// @param heights  of cusps, mm, and areas, of the triangles
CuspHistogram cusp_histogram(const std::vector<float>& heights, const std::vector<float>& areas, double most, int bins);

} // namespace limn
