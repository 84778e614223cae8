#pragma once

#include <span>

#include "limn/camera/camera.h"
#include "limn/subdivision/local_tolerance.h"
#include "limn/subdivision/silhouette_mesh.h"
#include "limn/subdivision/silhouette_pose.h"

namespace limn {

/// A camera, prepared for many points: where they fall in the picture, in pixels.
class PicturePlane {
public:
    explicit PicturePlane(const Camera& camera)
        : right_(camera.right()), above_(camera.above()), forward_(camera.forward()), eye_(camera.eye), scale_(camera.pixels_per_unit(1)),
          middle_(dvec2(camera.size) * 0.5), size_(camera.size), parallel_(camera.orthographic)
    {
    }
    /// Points behind the eye are taken to be just in front of it.
    dvec2 pixel(const dvec3& p) const
    {
        const dvec3 d = p - eye_;
        const double depth = parallel_ ? 1 : std::max(glm::dot(d, forward_), nearest), s = scale_ / depth;
        return {middle_.x + s * glm::dot(d, right_), middle_.y - s * glm::dot(d, above_)};
    }
    /// The direction in the picture across an outline, of no particular length, from the surface's normal there.
    dvec2 across(const dvec3& normal) const { return {glm::dot(normal, right_), -glm::dot(normal, above_)}; }
    /// Whether the box around some points touches the picture.
    bool is_in_picture(std::span<const dvec2> pixels) const
    {
        dvec2 low = pixels[0], high = pixels[0];
        for (const dvec2& p : pixels)
            low = glm::min(low, p), high = glm::max(high, p);
        return high.x >= 0 && high.y >= 0 && low.x <= size_.x && low.y <= size_.y;
    }

private:
    static constexpr double nearest = 1e-9;
    dvec3 right_, above_, forward_, eye_;
    double scale_;
    dvec2 middle_, size_;
    bool parallel_;
};

/// The eye that contours are searched for: the camera's, moved by a 10^-8th of its distance (or turned by as much), so that contours of
/// symmetrical shapes do not run along edges and through vertices.
Eye searched_eye(const Camera& camera, const dvec3& centre);

/// How a place on the surface is turned to the eye.
struct Facing {
    dvec3 normal;  ///< unit length
    double height; ///< sine of the angle between the surface and the line of sight; negative where it faces away
};

/// Whether a contour may run between some places: they are not all turned to the eye in the same way, or one of them comes as near to being
/// seen edge-on as they are turned against each other, times `share`. (Half as near would do if normals turned evenly between them. That nothing
/// is missed with these shares is not proven; ExactSilhouette.MissesNoCrossings compares with a search of every edge.)
/// @param places  up to six
bool may_be_crossed(std::span<const Facing> places, double share);
/// The same. @param heights  Facing::height of the places @param turned  the greatest distance between two of their normals, or more
bool may_be_crossed(std::span<const double> heights, double turned, double share);
inline constexpr double share_of_edges = 1, share_of_faces = 0.5;

/// All that the parts of an exact silhouette read.
struct SilhouetteView {
    const SilhouettePose& pose;
    PicturePlane plane;
    Eye eye;
    double pixels;    ///< how far from the true outline a polyline may be
    int curve_points; ///< parts of each arc; 0: as many as `pixels` asks for
    double surface_pixels; ///< how far the sides of triangles that face the eye may be from the surface; 0: any distance
    LocalTolerance tight = {}; ///< where outlines must be nearer than `pixels`

    /// How far an outline may be from the line between two places.
    double pixels_along(const dvec3& a, const dvec3& b) const { return tight.empty() ? pixels : tight.along(plane.pixel(a), plane.pixel(b), pixels); }
    const LoopTopology& topology() const { return pose.shape.table().control(); }
    Facing facing(const dvec3& position, const dvec3& normal) const { return {normal, glm::dot(glm::normalize(eye.from(position)), normal)}; }
    /// At the start of a half-edge, on the side of its face.
    Facing at_start(std::uint32_t h) const { return facing(pose.corners.positions[topology().start(h)], pose.corners.normals[h]); }
    /// At the middle of its edge, on the side of its face.
    Facing at_middle(std::uint32_t h) const
    {
        const std::uint32_t e = topology().edge[h];
        return facing(pose.middles[e], pose.middle_normals[e][side_of(h)]);
    }
    /// Whether the surface faces the eye at the start of a half-edge, on the side of its face.
    bool faces_eye(std::uint32_t h) const { return glm::dot(eye.from(pose.corners.positions[topology().start(h)]), pose.corners.normals[h]) >= 0; }
    /// Which side of its edge a half-edge is on: 0 where it is LoopTopology::half_edge, else 1.
    std::size_t side_of(std::uint32_t h) const { return topology().half_edge[topology().edge[h]] == h ? 0 : 1; }
};

/// How far a surface is in the picture from the middle of a chord, in pixels; 0 where nothing of it is in the picture.
double middle_error(const PicturePlane& plane, const dvec3& a, const dvec3& middle, const dvec3& b);

/// How far a curve in the picture is from the chord between two of its points, in pixels, judged by a point between and the directions across
/// it at both ends. 0 where nothing of it is in the picture.
double chord_error(const PicturePlane& plane, const SurfaceSample& a, const SurfaceSample& middle, const SurfaceSample& b);

} // namespace limn
