#pragma once

#include <algorithm>

#include "limn/terrain/height_map.h"
#include "limn/terrain/lattice.h"

namespace limn {

/// Whether a hypotenuse is longer than allowed. It depends on the level alone, so both sides of an edge agree, and a longer one is never below.
class LengthTest {
public:
    /// @param max_edge  metres; 0: any length
    LengthTest(const HeightMap& map, double max_edge)
        : longer_(std::max(map.spacing.x, map.spacing.y)), diagonal_(glm::length(map.spacing)), most_(max_edge)
    {
    }
    bool operator()(const BisectionTriangle& t) const
    {
        const ivec2 along = glm::abs(t.a - t.b);
        return most_ > 0 && (along.x == along.y ? along.x * diagonal_ : std::max(along.x, along.y) * longer_) > most_;
    }

private:
    double longer_, diagonal_, most_;
};

} // namespace limn
