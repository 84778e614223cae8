#pragma once

#include <array>
#include <cstdint>

#include "limn/subdivision/silhouette_view.h"

namespace limn {

/// A triangle of a control face as it is drawn: all corners lie on the limit surface.
struct DrawnTriangle {
    std::uint32_t face = 0;
    std::array<dvec2, 3> at;         ///< parameters of its corners
    std::array<dvec3, 3> positions;
    std::array<bool, 3> on_contour = {false, false, false}; ///< per side, from corner k to the next: whether it is a part of the contour's polyline
};

/// Whether a triangle shows the side that it should. @param front  whether that is the front
bool shows_side(const SilhouetteView& view, const std::array<dvec3, 3>& positions, bool front);

/// By how many pixels a triangle that does not show the side that it should may stick out beyond the surface; 0 where it shows the right one.
/// Outlines of a mesh run where triangles that show its front meet others that show its back: along the contour's polyline, and along sides of
/// turned triangles. The ends of such a side lie on the surface, and so do not stick out, but the side between them may, and by no more than
/// the surface is away from it. However many turned triangles lie beside each other, none of them leads further than that.
/// @param front  whether the triangle should face the eye
double turned_beyond(const SilhouetteView& view, const DrawnTriangle& triangle, bool front);

/// How far the sides of a triangle may be off.
double pixels_around(const SilhouetteView& view, const DrawnTriangle& triangle);

} // namespace limn
