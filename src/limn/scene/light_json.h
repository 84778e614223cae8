#pragma once

#include <filesystem>
#include <vector>

#include "limn/scene/json_place.h"
#include "limn/scene/scene.h"

namespace limn {

/// A list of lights, one at most. @param folder  that files count from
/// @throws Error::Read naming the place of what is unknown or wrong, and a file that does not exist
std::vector<Light> read_lights(const JsonPlace& place, const std::filesystem::path& folder);
/// What read_lights makes the light from.
Json light_json(const Light& light, const std::filesystem::path& folder);
/// The lights of a scene, whichever way it says them.
std::vector<Light> all_lights(const Scene& scene);

/// The file that a text names, which has to be there.
std::filesystem::path read_path(const JsonPlace& place, const std::filesystem::path& folder);
/// A file as it is called from a folder; "": as it is.
std::string path_from(const std::filesystem::path& file, const std::filesystem::path& folder);

} // namespace limn
