#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "limn/base/options.h"
#include "limn/geometry/mesh.h"
#include "limn/surface/surface.h"
#include "limn/surface/surface_point.h"

namespace limn {

/// A generated model near the origin, most of them about 2 units wide.
///
/// | name        | surface |
/// |-------------|---------|
/// | sphere      | radius 1 |
/// | ellipsoid   | half-axes 1, 0.7, 0.5 along x, y, z |
/// | torus       | ((R + r cos v) cos u, (R + r cos v) sin u, r sin v), R = 1, r = `tube_radius` (0.4) |
/// | bumpy-torus | the same with r = 0.4 + 0.03 sin 9u sin 4v |
/// | sine-sheet  | z = 0.1 sin(2 pi x), x and y in [-1,1] |
/// | bump        | z = 0.5 exp(-(x^2 + y^2) / 0.18), x and y in [-1,1] (a Gaussian with standard deviation 0.3) |
/// | plane       | z = 0, x and y in [-1,1] |
/// | bent-sheet  | (q sin u, v, q cos u), q = 1 + 0.3 v^2, u in [-100,100] degrees, v in [-1,1]: an open waisted gutter |
/// | rings       | a chain of three tori, R = 0.7, r = 0.18: axes z, y, z, centres x = -0.95, 0, 0.95 |
/// | knot        | path (q cos 2t, q sin 2t, sin 3t), q = 2 + cos 3t, with a tube of radius 0.35 + 0.08 sin 40t |
/// | blob        | radius 1 + 0.25 sin(5x+1) sin 4y + 0.12 sin 11x sin(9z+2) cos 10y + 0.05 sin 23z sin 21y in direction (x,y,z) |
/// | discs       | two flat ellipsoids 1, 1, 0.03 at z = -0.035 and 0.035 (a gap of 0.01 between them) |
/// | spheres     | two spheres of radius 0.8 at x = -0.5 and 0.5 that run through each other, as separate shells |
/// | cube        | [-1,1]^3, welded, sharp edges |
/// | cylinder    | radius 0.5, axis z, |z| <= 0.75, with caps, welded |
///
/// Knot and blob are the anchors of the coherent shadow map specification, section 8.3, without its scaling.
struct ShapeOptions {
    std::string name = "sphere";
    std::size_t triangles = 20000; ///< wanted number; met within 10 % from 5,000 triangles on, else the nearest possible
    double jitter = 0;             ///< vertices move by up to this many cells to each side, on the surface; to 0.2 no triangle folds
    double noise = 0;              ///< standard deviation of a displacement along the normal, units of length
    std::uint64_t seed = 1;        ///< of jitter and noise
    bool float_positions = true;   ///< round positions to float32
    double tube_radius = 0.4;      ///< of the torus, below 1; other shapes ignore it
};

/// A model with the exact differential quantities of its surface at the vertices. With noise they are those of the surface
/// below the noise. `exact` is empty for cube and cylinder, whose edges have no normal.
struct Shape {
    Mesh mesh;
    Surface exact;
    bool closed = true; ///< the surface has no border
};

/// Generates a shape; same options, same bytes for any number of threads.
/// @throws Error::Input for an unknown name, or a number out of range (triangles: from the shape's smallest to 100,000,000).
Shape make_shape(const ShapeOptions& options);

/// Every name that make_shape knows, in the order of the table above.
const std::vector<std::string>& shape_names();

/// The options as data, without the name, which is an argument of its own on the command line.
const OptionTable<ShapeOptions>& shape_option_table();

/// A smooth shape's exact quantities in double, at a parameter of one of its parts: any direction for sphere, ellipsoid,
/// blob, discs and spheres; (u, v, 0) of the table above for the others (knot: t and the angle around the tube).
/// @throws Error::Input when the shape has no such part (cube and cylinder have none).
SurfacePoint shape_point(std::string_view name, const dvec3& parameter, std::size_t part = 0);

} // namespace limn
