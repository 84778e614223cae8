#pragma once

#include <string>
#include <vector>

#include "limn/base/options.h"
#include "limn/geometry/mesh.h"
#include "limn/subdivision/loop_topology.h"

namespace limn {

/// How a control mesh becomes a fine mesh.
struct SubdivideOptions {
    int levels = 2;       ///< how often each triangle is cut into four, where max_error is 0
    double max_error = 0; ///< length: as many levels as bring the mesh this near to the limit surface; 0: `levels`
    bool limit = false;   ///< push the vertices to the limit surface, and give the corners its normals
    CreaseRule crease_rule = CreaseRule::opensubdiv;
    double crease_angle = 0; ///< degrees: ControlOptions
    bool crease_tags = true;
};

const OptionTable<SubdivideOptions>& subdivide_option_table();

struct Subdivided {
    /// Corner normals only with `limit`. Texture coordinates and colours are interpolated along edges, groups are inherited; edges that are
    /// still sharp stay tagged, but not with `limit`, since what was pushed must not be subdivided again.
    Mesh mesh;
    int levels = 0;
    /// With max_error: the greatest distance to the mesh that points of the limit surface were found to have, and how many points. They are
    /// the 15 per triangle that the next two levels have; what lies between them was not measured.
    double measured = 0;
    std::size_t measured_at = 0;
    std::vector<std::string> notes; ///< what was not as it should be
};

/// The most triangles that `subdivide` makes, also for measuring, which takes 16 times as many as the mesh has.
inline constexpr std::size_t most_subdivided_triangles = 50'000'000;

/// Loop subdivision of a mesh of triangles. Parallel; same bytes for any number of threads.
/// @param mesh  its polygons are not looked at
/// @throws Error::Input for a mesh that cannot be subdivided (make_control_mesh), and for more triangles than there may be.
Subdivided subdivide(const Mesh& mesh, const SubdivideOptions& options);

} // namespace limn
