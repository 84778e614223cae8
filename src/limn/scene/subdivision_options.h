#pragma once

#include "limn/base/options.h"
#include "limn/subdivision/loop_topology.h"

namespace limn {

/// How meshes are drawn that were made as control meshes of subdivision surfaces.
struct SubdivisionOptions {
    enum class Scheme : std::uint8_t { polygons, loop };
    enum class Silhouette : std::uint8_t {
        exact, ///< cut along the contour of the limit surface (exact_silhouette)
        seed,  ///< the method of the thesis (seed_silhouette)
        off,   ///< the control mesh on the limit surface, as it is
    };
    enum class Normals : std::uint8_t {
        limit,  ///< of the limit surface, for each pixel; a GPU takes `map`, and `vertex` where the faces do not fit into one
        map,    ///< from a normal map of the limit surface, made in memory
        vertex, ///< those of vertices, interpolated
    };
    Scheme scheme = Scheme::polygons; ///< a mesh is what it is
    Silhouette silhouette = Silhouette::exact;
    double outline_error = 0.5; ///< pixels
    double surface_error = 1;   ///< pixels; 0: any (ExactSilhouetteOptions)
    int base_levels = 0;        ///< how often the control mesh is subdivided before anything else
    int depth = 5;              ///< of the seed's search
    int curve_points = 0;       ///< parts of the contour in each face; 0: exact: as outline_error asks; seed: 8
    Normals normals = Normals::limit;
    int map_size = 1024;        ///< texels along a side of the normal map
    CreaseRule crease_rule = CreaseRule::opensubdiv;
    double sharp_angle = 0;     ///< degrees: ControlOptions::crease_angle
    bool crease_tags = true;
};

const OptionTable<SubdivisionOptions>& subdivision_option_table();

} // namespace limn
