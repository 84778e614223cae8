#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "limn/subdivision/contour_polynomial.h"
#include "limn/subdivision/limit_shape.h"

namespace limn {

/// A triangle in the parameters (v, w) of a control face.
using ParameterTriangle = std::array<dvec2, 3>;

/// Its four children, numbered and turned as in Loop subdivision (refine).
std::array<ParameterTriangle, 4> quarters(const ParameterTriangle& triangle);

/// The contour's polynomial over a part of a control face, and the surface's.
struct ContourPiece {
    ParameterTriangle corners;
    ContourPolynomial g;
    ParameterTriangle of_patch; ///< where the patch is, of which the piece may be a part
    dvec3 anchor;               ///< positions are this plus the patch
    QuarticPatch patch;
};

/// Whose contour it is.
struct ContourOf {
    const LimitShape* shape = nullptr;
    const Eye* eye = nullptr;
    std::uint32_t face = 0;
};

/// A triangle at an extraordinary vertex, or beside a semi-sharp edge, that is still many polynomials.
struct ContourRest {
    ParameterTriangle corners;
    std::uint32_t refined_face;
    const PatchClass::Node* node;
};

/// A part of a control face, and what is known of the contour in it.
struct ContourCell {
    ContourOf of;
    ParameterTriangle corners;
    std::vector<std::shared_ptr<const ContourPiece>> pieces; ///< with the rests they fill the cell; parts of it have the same
    std::vector<ContourRest> rests;   ///< cut into polynomials when the cell is cut
};

/// Whether the polynomials over a control face have one sign each, which leaves no room for a contour that does not cross its edges. Nothing is
/// known of the nearest surroundings of extraordinary vertices.
bool is_clear_of_contours(const LimitShape& shape, const Eye& eye, std::uint32_t face);

/// A whole control face. @param shape, eye  must live as long as the cells that it is cut into
ContourCell contour_cell(const LimitShape& shape, const Eye& eye, std::uint32_t face);

/// g at a place of the cell; only its sign counts.
double contour_value(const ContourCell& cell, const dvec2& at);
/// The surface at a place of the cell.
SurfaceSample sample(const ContourCell& cell, const dvec2& at);

/// A point where the contour enters or leaves a cell.
struct BoundaryCrossing {
    int side;  ///< from corner `side` to the next
    double t;  ///< along it
    dvec2 at;
};

/// A quarter of a cell, and all crossings of its boundary.
struct SplitCell {
    ContourCell cell;
    std::vector<BoundaryCrossing> crossings;
};
/// The crossings of the sides between quarters are those of both.
std::array<SplitCell, 4> split_with_crossings(const ContourCell& cell, const std::vector<BoundaryCrossing>& crossings);

/// A part of the contour within a cell: places on it, one after the other; closed where the first is repeated as the last.
using ContourArc = std::vector<dvec2>;

/// Whether a point of the contour between two others is to be added, told by their places and by how often an arc was halved to get there.
using NeedsPoint = std::function<bool(const dvec2& a, const dvec2& middle, const dvec2& b, int halvings)>;

/// The contour within a cell, from one crossing to another, and closed curves. The cell is cut into smaller ones until in each the polynomial
/// grows in one direction, which leaves no room for more than one arc or for closed curves; at most to `deepest` levels.
/// @param crossings  all of the cell's boundary
/// @param needs      asked for the middle of two neighbouring points, and again on both sides of those that it asks for
std::vector<ContourArc> trace_contour(const ContourCell& cell, const std::vector<BoundaryCrossing>& crossings, const NeedsPoint& needs, int deepest = 6);

} // namespace limn
