#pragma once

#include <optional>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// The middle of an arc of a radius between two places of the plane.
/// @param radius  below 0: the longer of the two arcs
/// @return nothing where the places coincide or are farther apart than twice the radius (a hundredth of it is forgiven)
std::optional<dvec2> arc_centre(const dvec2& from, const dvec2& to, double radius, bool clockwise);

/// Places along an arc around a middle, seen from above, without its start; the last one is `to`. The height changes evenly, and so does the
/// radius, where the ends have not the same one. An arc that ends where it starts is a whole circle.
/// @param more_turns  whole circles besides
/// @param error  how far chords may be from the arc, mm
void append_arc(const dvec3& from, const dvec3& to, const dvec2& centre, bool clockwise, int more_turns, double error,
                std::vector<dvec3>& out);

} // namespace limn
