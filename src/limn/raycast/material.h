#pragma once

#include "limn/base/vec.h"

namespace limn {

/// What one object of a picture looks like, wherever its light comes from. Colours are encoded (sRGB) RGB in [0,1].
struct Material {
    vec3 colour = vec3(0.85f, 0.83f, 0.8f); ///< of fully lit places
    float unlit = 0.25f;                    ///< tone of unlit places, as a part of the colour, in [0,1]

    vec3 dark() const { return unlit * colour; }
    bool operator==(const Material&) const = default;
};

} // namespace limn
