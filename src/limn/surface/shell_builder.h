#pragma once

#include <functional>
#include <span>

#include "limn/geometry/mesh.h"

namespace limn {

/// A point of a tube's middle line and the tube's radius there.
struct TubeStation {
    dvec3 at;
    double radius;
};

/// Adds closed shells to a mesh, their triangles counter-clockwise seen from outside.
class ShellBuilder {
public:
    /// A tube around a line that does not turn back, closed by a point at each end. @param stations  2 or more @param sides  3 or more
    void add_tube(std::span<const TubeStation> stations, int sides);
    /// An ellipsoid. @param axes  half-axes, at right angles and right-handed
    void add_ellipsoid(const dvec3& centre, const dvec3 (&axes)[3], int sides, int rings);
    /// A thin plate along an outline, thickest in its middle line: a leaf or a wing. From `root` to `tip`, bent towards `normal` in between.
    /// @param half_width  at parts of the way from 0 to 1; positive between them @param thickness  in the middle
    void add_blade(const dvec3& root, const dvec3& tip, const dvec3& normal, const std::function<double(double)>& half_width, double bend, double thickness,
                   int segments);
    Mesh take() { return std::move(mesh_); }

private:
    std::uint32_t add_vertex(const dvec3& p);
    /// Rings of as many vertices each, closed by a vertex before the first and one after the last.
    void close_rings(std::uint32_t first, int rings, int sides, std::uint32_t start, std::uint32_t end);

    Mesh mesh_;
};

} // namespace limn
