#pragma once

#include <cstdint>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

struct MountainOptions {
    double extent = 5000; ///< metres of the longer side of what will be looked at
    double spacing = 10;  ///< metres between samples
    std::uint64_t seed = 1;
};

/// Mountains without an end, as a function of the place: every sample can be had by itself.
///
/// Ranges are octaves of gradient noise (Perlin 2002), the widest one folded into ridges, finer ones weaker in valleys than high up. Gullies
/// run down their slopes: waves along the contour lines, each cell of a grid with one about a point of its own, mixed where cells meet; finer
/// ones follow the slopes that coarser ones leave, and so branch off them (after the "eroded terrain noise" of Johansen and John). Ranges
/// are as wide as a half of the extent, up to 10 km; nothing is narrower than 5 samples.
class Mountains {
public:
    explicit Mountains(const MountainOptions& options);

    /// Height in metres. Relief is 0.1 to 0.15 times the extent, up to about 3 km.
    /// @param place  metres
    double height(const dvec2& place) const;

private:
    struct Octave {
        double frequency;    ///< per range
        double cosine, sine; ///< of its turn, which hides the grids' directions
        double amplitude;
        std::uint64_t seed;
    };
    std::vector<Octave> ranges_, gullies_;
    dvec2 offset_;
    double range_, relief_;
};

} // namespace limn
