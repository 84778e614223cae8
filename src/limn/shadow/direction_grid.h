#pragma once

#include <cstdint>

#include "limn/base/vec.h"
#include "limn/formulas/formulas.h"

namespace limn {

using formulas::MapFrame;

/// How the cells of a grid of directions lie on the sphere; the numbers stand in files and shaders.
enum class DirectionSpread : int {
    even = formulas::EVEN_GRID,             ///< of equal area
    polar = formulas::POLAR_GRID,           ///< denser at the poles
    octahedral = formulas::OCTAHEDRAL_GRID, ///< of about equal area, without poles
};

/// A grid of directions: one map from the middle of each cell (formulas/direction_grid.glsl). On spheres with poles x is the cell along theta, from
/// the upper pole, and y along phi.
struct DirectionGrid {
    DirectionSpread spread = DirectionSpread::even;
    ivec2 cells = {64, 64};

    std::uint32_t count() const { return std::uint32_t(cells.x) * std::uint32_t(cells.y); }
    vec2 middle(const ivec2& cell) const { return (vec2(cell) + 0.5f) / vec2(cells); }
    MapFrame frame(const ivec2& cell) const { return formulas::frame_of_place(int(spread), middle(cell)); }
    /// The cell that a direction is in. @param d  unit
    ivec2 cell_of(const vec3& d) const { return glm::min(ivec2(formulas::place_of_direction(int(spread), d) * vec2(cells)), cells - 1); }
};

} // namespace limn
