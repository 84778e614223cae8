#pragma once

#include "limn/scene/json_place.h"
#include "limn/scene/scene.h"

namespace limn {

/// A whole camera by the keys of camera_to_json, where "eye" or "look" stands, and a side to frame the scene from otherwise: "view", "up_axis", "fov_degrees",
/// "orthographic", "size". @throws Error::Read naming the key that is unknown or wrong.
SceneView read_view(const JsonPlace& place);
/// What read_view makes the view from; empty for a default-made one.
Json view_json(const SceneView& view);

} // namespace limn
