#pragma once

#include <string>
#include <vector>

#include "limn/base/image.h"
#include "limn/geometry/mesh.h"

/// Pictures of one size beside and under each other.
/// @param gap  white pixels between them
limn::Image in_rows(const std::vector<std::vector<limn::Image>>& rows, int gap);

struct NamedMesh {
    std::string name;
    limn::Mesh mesh;
};

/// Closed models that are printed along z: a sphere, a cone, a wedge and a blob.
std::vector<NamedMesh> print_shapes();
