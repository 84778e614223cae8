#pragma once

#include <cmath>

namespace limn {

/// Light of an encoded (sRGB, IEC 61966-2-1) sample in [0,1], and back. Light is linear: it can be added up.
inline float linear_from_srgb(float encoded) { return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f); }
inline float srgb_from_linear(float light) { return light <= 0.0031308f ? 12.92f * light : 1.055f * std::pow(light, 1 / 2.4f) - 0.055f; }

} // namespace limn
