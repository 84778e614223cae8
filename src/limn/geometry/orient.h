#pragma once

#include "limn/geometry/mesh.h"

namespace limn {

/// Turns faces round so that neighbours agree on which side is outside (line-visibility specification, section 5). Neighbours
/// share an edge with no third face. In each shell of neighbours that do not all agree, and could, the fewer faces turn; where that
/// leaves a closed shell inside out, the others turn instead. Shells that agree stay as they are, inside out or not, and so do those
/// that cannot agree, such as a Möbius strip. A face that is turned keeps its first corner; what lies at its corners goes with them.
/// A mesh that is closed and agrees costs one pass over its faces.
/// @return how many faces were turned
std::size_t orient_faces(Mesh& mesh);

} // namespace limn
