#pragma once

#include <array>
#include <span>
#include <vector>

#include "limn/subdivision/contour_cells.h"
#include "limn/subdivision/silhouette_edges.h"
#include "limn/subdivision/silhouette_view.h"

namespace limn {

/// A triangle of a control face that is drawn as one, but for points on its sides and the arcs that cut it.
struct FaceLeaf {
    ContourCell cell; ///< without pieces where no contour is
    std::vector<BoundaryCrossing> crossings;
    std::vector<ContourArc> arcs;
    bool front = false; ///< where no contour is: whether it faces the eye
    int level = 0;
};

/// A control face that is not drawn as a single triangle.
struct CutFace {
    std::uint32_t face = 0;
    std::vector<FaceLeaf> leaves;
};

/// Whether a contour may be in a face: one crosses its edges, or may run between its corners and the middles of its sides.
bool may_hold_contour(const SilhouetteView& view, std::uint32_t face, const EdgePoints& edges);

/// A control face with the contours in it. It is cut in four until closed curves are cut open.
/// @param may_hold  may_hold_contour of it
CutFace cut_face(const SilhouetteView& view, std::uint32_t face, const EdgePoints& edges, bool may_hold);

/// Cuts some leaves in four.
/// @param which  one flag per leaf
CutFace split_leaves(const SilhouetteView& view, const CutFace& face, const std::vector<bool>& which);

/// Follows the arcs in a face again, with more points where SilhouetteView::tight asks for them. @return whether there are new ones
bool refine_arcs(const SilhouetteView& view, CutFace& face);

/// Where the leaves' corners lie on the sides of the face, between its corners: side and parameter along it.
struct SidePoint {
    int side;
    double t;
};
std::vector<SidePoint> side_points(const CutFace& face);

/// A point of a face: one of its corners, of its edges' points, or its own.
struct FacePoint {
    enum class Of : std::uint8_t { corner, edge, face };
    Of of = Of::face;
    std::uint32_t side = 0;  ///< corner or edge of the face
    std::uint32_t index = 0; ///< among EdgePoints of the edge, or the face's own points
    dvec2 at;                ///< parameters
};

struct FaceTriangles {
    std::vector<FacePoint> points;
    std::vector<SurfaceSample> own;
    std::vector<uvec3> triangles;     ///< of points
    std::vector<std::vector<std::uint32_t>> curves;
    /// Per leaf: whether a triangle shows another side than the contour says and may stick out by more than SilhouetteView::pixels, or is further
    /// from the surface than SilhouetteView::surface_pixels.
    std::vector<bool> to_split;
    double most_turned = 0; ///< pixels: as far as triangles that show the wrong side may stick out (turned_beyond)
};
FaceTriangles triangulate_face(const SilhouetteView& view, const CutFace& face, const EdgePoints& edges);

/// The points of a face's edges, as they are at the moment.
using FaceEdges = std::array<std::span<const CutPoint>, 3>;
FaceEdges face_edges(const LoopTopology& topology, std::uint32_t face, const EdgePoints& edges);

/// Where one of a face's points is. @param own  the face's own points
const dvec3& position_of(const SilhouetteView& view, std::uint32_t face, const FacePoint& point, const FaceEdges& on_sides, const std::vector<SurfaceSample>& own);
/// The surface's normal there, on the side of the face.
const dvec3& normal_of(const SilhouetteView& view, std::uint32_t face, const FacePoint& point, const FaceEdges& on_sides, const std::vector<SurfaceSample>& own);

} // namespace limn
