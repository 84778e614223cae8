#pragma once

#include <memory>
#include <optional>
#include <variant>

#include "limn/base/vec.h"

namespace limn {

class EnvironmentMap;

/// A ball that shines, in the world.
struct SphereLight {
    dvec3 centre = {0, 0, 0};
    double radius = 1; ///< above 0
};

/// A rectangle that shines on both sides, in the world.
struct RectangleLight {
    dvec3 centre = {0, 0, 0};
    dvec2 size = {1, 1};          ///< its level side, and the other; above 0
    std::optional<dvec3> towards; ///< the place it faces; absent: the middle of what is shown
};

/// The light of all directions, as a picture has it.
struct EnvironmentLight {
    std::shared_ptr<const EnvironmentMap> map; ///< not null
};

/// Lights with a size.
using WideLight = std::variant<SphereLight, RectangleLight, EnvironmentLight>;

} // namespace limn
