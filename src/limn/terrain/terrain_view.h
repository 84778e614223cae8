#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "limn/camera/camera.h"
#include "limn/terrain/height_map.h"
#include "limn/terrain/nested_errors.h"

namespace limn {

struct ViewTolerance {
    double pixels = 1;        ///< 0 or more: how far from its true place the terrain may be drawn
    double nearest = 0.01;    ///< metres of depth: what is nearer to the eye is as fine as the map
    bool cull = true;         ///< what no part of the picture shows stays coarse

    bool operator==(const ViewTolerance&) const = default;
};

/// Which triangles a view splits. The error of a lattice point in the picture is bounded by that of a box around everything that needs the
/// point, so that it is never less than theirs: each triangle decides alone, and the mesh has no cracks (after Lindstrom & Pascucci 2002, with
/// the projection itself for their distance; the terrain specification, 7.1). The distance is between where the picture shows a point of the
/// terrain and where it would show the mesh above or below it; where the eye looks down, also as if heights were seen from the side.
class ViewTest {
public:
    /// @param map, errors  have to outlive the test; `errors` with ranges
    /// @throws Error::Input for a tolerance that is below 0 or no number, or errors without ranges
    ViewTest(const HeightMap& map, const NestedErrors& errors, const Camera& camera, const ViewTolerance& tolerance);
    /// For bounds that are known otherwise. @param frame  the map without its heights; has to outlive the test
    ViewTest(const HeightMap& frame, const Camera& camera, const ViewTolerance& tolerance);
    /// Of a triangle that can be split.
    bool operator()(const BisectionTriangle& t) const { return pixels(t) > tolerance_.pixels; }
    /// The bound, in pixels, of a triangle that can be split; 0 where it cannot be seen, as good as infinite where there is no bound.
    double pixels(const BisectionTriangle& t) const { return pixels(t, errors_->bounds(t.middle())); }
    /// @param bounds  of its middle
    double pixels(const BisectionTriangle& t, const PointBounds& bounds) const;
    bool splits(const BisectionTriangle& t, const PointBounds& bounds) const { return pixels(t, bounds) > tolerance_.pixels; }
    /// At least the bound of every point in an area.
    /// @param first, last       its corners, lattice points
    /// @param bounds            around all its points
    /// @param half_hypotenuse   of the largest hypotenuses that they split, in cells along a row or column
    double pixels_of_area(const ivec2& first, const ivec2& last, const PointBounds& bounds, int half_hypotenuse) const;
    double tolerance() const { return tolerance_.pixels; }

private:
    /// @param place, reach  its middle and half of its size, in columns and rows
    /// @param level         of its points, above the finest
    double pixels_of_box(const dvec2& place, const dvec2& reach, const PointBounds& bounds, int level) const;

    const HeightMap& map_;
    const NestedErrors* errors_ = nullptr;
    Camera camera_;
    ViewTolerance tolerance_;
    dvec3 right_, above_, forward_;
    dvec2 across_;
    double scale_, slack_length_;
    std::array<double, 64> reaches_; ///< by levels above the finest points: how far boxes reach, in cells
};

/// The triangles of the coarsest mesh of the hierarchy that the view's bound allows.
std::vector<BisectionTriangle> triangles_in_view(const HeightMap& map, const NestedErrors& errors, const Camera& camera, const ViewTolerance& tolerance = {});

/// The mesh of a view that moves: what changes from view to view is split and merged, the rest is kept.
class TerrainView {
public:
    /// @param map, errors  have to outlive the view
    TerrainView(const HeightMap& map, const NestedErrors& errors);
    /// Makes the mesh that of a camera: the same as triangles_in_view() gives, in time that grows with its triangles and those that change.
    /// @return how many triangles came or went
    std::size_t update(const Camera& camera, const ViewTolerance& tolerance = {});
    /// In the order of the hierarchy; some of them may be outside the map.
    std::vector<BisectionTriangle> triangles() const;

    /// A triangle that is not split, with what its tests read, so that they need not look it up.
    struct Leaf {
        BisectionTriangle triangle;
        std::uint64_t path;         ///< its root's number, then a bit for each bisection
        PointBounds below, above;   ///< of the point that would split it, and of the one that made it
    };

private:
    const HeightMap& map_;
    const NestedErrors& errors_;
    std::vector<Leaf> leaves_;
};

} // namespace limn
