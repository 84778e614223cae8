#pragma once

#include <span>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// Rings around a line that swells and thins: fill them with the non-zero rule. Open lines give one ring with round
/// ends, closed ones an outer and an inner ring. `half_widths`: one for each point, same unit as the points.
std::vector<std::vector<dvec2>> outline_rings(std::span<const dvec2> points, std::span<const double> half_widths, bool closed);

} // namespace limn
