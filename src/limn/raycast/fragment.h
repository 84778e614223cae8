#pragma once

#include <functional>
#include <span>
#include <vector>

#include "limn/base/vec.h"
#include "limn/camera/camera.h"
#include "limn/raycast/ray_scene.h"

namespace limn {

/// A surface's normal (unit) at a place of a triangle, whose corners 1 and 2 have the weights u and v. Called from many threads.
using NormalAt = std::function<vec3(std::uint32_t triangle, float u, float v)>;

/// One object of a RayScene with what pictures need of it.
struct SeenObject {
    RayTriangles triangles;
    std::span<const vec3> normals; ///< one per vertex, unit; empty: those of the triangles
    NormalAt normal_at = {};       ///< where it is given, fragments have these normals, not interpolated ones
};

/// What a camera looks at. `objects` are those that `rays` was built from, in the same order; their coordinates are
/// (world - centre) / scale. Everything that it points to must outlive it.
struct SeenScene {
    const RayScene* rays = nullptr;
    std::vector<SeenObject> objects;
    dvec3 centre = dvec3(0);
    double scale = 1;
    /// Where the one object of `rays` holds several parts one after the other, as a LineModel does its objects: the first face
    /// of each part, and the total. Empty: every object is a part of its own.
    std::span<const std::uint32_t> first_face;

    std::size_t part_count() const { return first_face.empty() ? objects.size() : first_face.size() - 1; }
    /// The part that a face of an object belongs to.
    std::uint32_t part_of(std::uint32_t object, std::uint32_t triangle) const;
};

/// What is seen at one place of a picture. Without a hit only `object` (none) has a meaning.
struct Fragment {
    std::uint32_t object = none, triangle = none;
    float u = 0, v = 0;             ///< weights of the triangle's corners 1 and 2
    float depth = 0;                ///< along the viewing direction, world units
    vec3 position = vec3(0);        ///< in the frame of the scene
    vec3 normal = vec3(0);          ///< interpolated from the vertices, or what normal_at has there; unit
    vec3 face_normal = vec3(0);     ///< of the triangle, unit
    vec3 to_eye = vec3(0);          ///< unit
    bool hit() const { return object != none; }
    bool front() const { return glm::dot(face_normal, to_eye) > 0; }
};

/// Finds what a camera sees at places of its picture, one ray each. Safe to use from many threads; the scene must outlive it.
class FragmentTracer {
public:
    FragmentTracer(const SeenScene& scene, const Camera& camera);
    /// @param pixel  x right, y down; pixel centres at .5
    Fragment at(const dvec2& pixel) const;
    /// What is seen there behind a fragment of the same place.
    Fragment behind(const dvec2& pixel, const Fragment& fragment) const;
    /// The line of sight there, in the frame of the scene; the direction is a unit vector.
    Camera::Ray sight(const dvec2& pixel) const;

private:
    Fragment beyond(const dvec2& pixel, const Fragment* before) const;

    const SeenScene& scene_;
    Camera camera_;
    dvec3 forward_, right_, above_;
    double world_per_pixel_; ///< at depth 1 (perspective) or at any depth
    double radius_;          ///< of a sphere around the frame's origin that holds every object
};

/// `count` places in the unit square, no two of which share a row or column of count x count cells: edges along pixels are
/// resolved in `count` steps.
std::vector<dvec2> sample_pattern(int count);

} // namespace limn
