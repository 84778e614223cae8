#pragma once

#include <string>
#include <vector>

#include "limn/subdivision/limit_shape.h"

/// A control mesh and the faces that are looked at: those around its vertex 0.
struct LimitSubject {
    std::string name;
    limn::Mesh mesh;
};

/// Irregular vertices of valence 3 to 12, smooth; and of valence 8 with a dart, a crease, a corner, a fading crease, and at a border; all
/// among regular or far vertices, moved at random.
std::vector<LimitSubject> limit_subjects();

/// What the limit surface truly is at a place.
struct LimitSample {
    limn::PatchPoint at;
    limn::dvec3 position, normal;
};

/// The limits of vertices around vertex 0 of a mesh that is refined around it level by level, with limit masks in double: of all that lie
/// within two edges at each of 12 levels, in the faces at vertex 0. Vertex 0 is left out: where it ends a sector of many triangles, there are
/// several planes that normals could be said to be of.
std::vector<LimitSample> limit_truth(const limn::Mesh& mesh);
