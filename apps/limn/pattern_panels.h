#pragma once

#include <string>
#include <vector>

#include "limn/base/image.h"
#include "limn/geometry/mesh.h"
#include "limn/scene/render.h"

/// Pictures of one size beside and under each other.
/// @param gap  white pixels between them
limn::Image in_rows(const std::vector<std::vector<limn::Image>>& rows, int gap);

struct NamedMesh {
    std::string name;
    limn::Mesh mesh;
};

/// Closed models that are printed along z: a sphere, a cone, a wedge and a blob.
std::vector<NamedMesh> print_shapes();

/// A camera that looks at a model from a side, z up, so that it fills the picture but for a twentieth of its sides.
limn::Camera filling_camera(const limn::SceneModel& model, const std::string& view, const limn::ivec2& size);
