#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "limn/raycast/fragment.h"
#include "limn/raycast/occlusion.h"
#include "limn/scene/render_options.h"
#include "limn/shadow/shadow_maps.h"

namespace limn {

/// The maps of each object of a scene; null where one has none. Copies of a model share theirs.
using ObjectMaps = std::vector<std::shared_ptr<const ShadowMaps>>;

/// Tells what hides light by maps, and by rays for objects without them.
/// @param transforms  of the objects, to the world @param scene  whose parts are the objects, in the same order; has to outlive the result
std::shared_ptr<const Occlusion> map_shadows(const ObjectMaps& maps, std::span<const dmat4> transforms, const SeenScene& scene);

/// Lets maps hide light where the method says so.
/// @throws Error::Input where it asks for maps and no object has any
void hide_by_maps(ShadeOptions& options, ShadowMethod method, const ObjectMaps& maps, std::span<const dmat4> transforms, const SeenScene& scene);

/// The maps whose objects have the shapes (shape_hash) of a scene's.
/// @throws Error::Read naming a file that cannot be read or is of none of the shapes
ObjectMaps match_maps(std::span<const std::filesystem::path> files, std::span<const std::uint64_t> shapes);

} // namespace limn
