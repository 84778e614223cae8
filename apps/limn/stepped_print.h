#pragma once

#include <vector>

#include "limn/geometry/mesh.h"
#include "limn/raycast/ray_scene.h"

/// The real steps of a print as triangles, for rays to meet.
struct SteppedPrint {
    std::vector<limn::vec3> positions; ///< with one spare element at the end, for the ray tracer
    std::vector<limn::vec3> normals;   ///< one per vertex, unit
    std::vector<limn::uvec3> triangles;

    limn::RayTriangles rays() const { return {positions, triangles}; }
};

/// How slices are made solid.
struct StepOptions {
    double layer_height = 0.2; ///< above 0
    double bulge = 0;          ///< of edges, by half a layer's height: they are half ellipses that touch the model; 0: upright
    int bead_segments = 16;    ///< of an edge from its bottom to its top
};

/// A closed model in layers along z, from its lowest place on: each is the slice at its middle, extruded over its height.
/// Slices are rings without holes in them; what is in a ring is taken for solid.
/// @throws limn::Error::Input for a model that is not closed
SteppedPrint stepped_print(const limn::Mesh& mesh, const StepOptions& options);

/// The rings of a closed mesh at a height, counter-clockwise seen from above. @throws limn::Error::Input for a mesh that is not closed
std::vector<std::vector<limn::dvec2>> slice(const limn::Mesh& mesh, double height);

/// A simple polygon, counter-clockwise, cut into triangles (ears).
std::vector<limn::uvec3> cut_polygon(const std::vector<limn::dvec2>& ring);
