#pragma once

#include <string_view>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// A line of text in single-stroke capitals, as pens write it: polylines with x right and y down, the base line at
/// y = 0, capitals 1 high, the text centred on x = 0. Small letters become capitals; a sign that the lettering lacks
/// becomes a box. (Latin letters, digits, space, and . , - + / : ( ) = _ ' and the degree sign.)
std::vector<std::vector<dvec2>> letter(std::string_view text);

} // namespace limn
