#pragma once

#include <cstddef>
#include <span>

namespace limn {

/// How good and how large maps of an object are.
struct MapQuality {
    int maps = 0, resolution = 0;
    std::size_t bytes = 0;
    double error = 0; ///< of whatever protocol, not below 0
};

inline constexpr double plateau_height = 1.5; ///< errors up to so many times the least one are on the plateau

/// The fewest bytes on the plateau of errors: more maps or texels would make little better (the coherent shadow map specification, 7.7, whose choice for
/// its dragon this is). At least one has to be given.
MapQuality smallest_of_plateau(std::span<const MapQuality> all);

} // namespace limn
