#pragma once

#include <string_view>
#include <vector>

#include "limn/formulas/formulas.h"

namespace limn {

/// A printing material as data.
struct Filament {
    std::string_view name; ///< "pla-grey"
    vec3 colour;           ///< encoded (sRGB), of a thick wall in white light
    float along, across;   ///< GGX roughness (alpha) along and across the beads
    float index;           ///< of refraction
};

/// Every preset: PLA, PETG, silk and matte PLA in several colours.
const std::vector<Filament>& filaments();
/// @throws Error::Input naming the nearest one.
const Filament& find_filament(std::string_view name);

/// Linear colour from an encoded one, and back.
vec3 linear_colour(const vec3& encoded);
vec3 encoded_colour(const vec3& linear);

/// How it reflects. @param colour  encoded, instead of its own
formulas::Finish finish_of(const Filament& filament);
formulas::Finish finish_of(const Filament& filament, const vec3& colour);

} // namespace limn
