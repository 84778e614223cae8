#include "limn/shadow/map_quality.h"

#include <algorithm>

namespace limn {

MapQuality smallest_of_plateau(std::span<const MapQuality> all)
{
    const double least = std::min_element(all.begin(), all.end(), [](const MapQuality& a, const MapQuality& b) { return a.error < b.error; })->error;
    const MapQuality* best = nullptr;
    for (const MapQuality& one : all)
        if (one.error <= plateau_height * least && (!best || one.bytes < best->bytes))
            best = &one;
    return *best;
}

} // namespace limn
