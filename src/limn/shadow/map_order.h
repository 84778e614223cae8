#pragma once

#include <cstdint>

#include "limn/base/vec.h"
#include "limn/formulas/formulas.h"

namespace limn {

/// In which order the maps of a grid follow each other. Consecutive maps see the object from directions that are near to each other, so that
/// what a texel sees changes little; least along theta (the coherent shadow map specification, 2.6). The numbers stand in files and shaders.
enum class MapOrder : int {
    theta_zigzag = formulas::THETA_ZIGZAG, ///< along theta at each phi, to and fro
    theta_linear = formulas::THETA_LINEAR, ///< along theta at each phi, always from the upper pole
    phi_zigzag = formulas::PHI_ZIGZAG,
    phi_linear = formulas::PHI_LINEAR,
    hilbert = formulas::HILBERT_CURVE, ///< square grids of 2^k cells along a side only
};

/// @throws Error::Input for a grid that the order does not fit
void check_order(MapOrder order, const ivec2& cells);
/// Where in the order a cell is, from 0. @param cells  of the grid
std::uint32_t rank_of(MapOrder order, const ivec2& cells, const ivec2& cell);
ivec2 cell_of_rank(MapOrder order, const ivec2& cells, std::uint32_t rank);

} // namespace limn
