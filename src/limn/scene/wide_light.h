#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "limn/raycast/environment.h"
#include "limn/raycast/light.h"

namespace limn {

/// An environment by its file, a Radiance picture (.hdr).
struct EnvironmentFile {
    std::filesystem::path file;
    std::shared_ptr<const EnvironmentMap> map; ///< null until it is read
};

/// A light with a size as a user says it.
using WantedWideLight = std::variant<SphereLight, RectangleLight, EnvironmentFile>;

/// The light of "sphere:x,y,z,r", "rect:x,y,z,w,h", "rect:x,y,z,w,h,x,y,z" (and the place it faces) or "env:FILE"; nothing where the text begins otherwise.
/// @throws Error::Input naming the option and what is wrong
std::optional<WantedWideLight> wide_light_from_text(std::string_view name, std::string_view text);
/// Where its middle is; nothing for light from all sides.
std::optional<dvec3> middle_of(const WantedWideLight& light);
std::string wide_light_text(const WantedWideLight& light);

/// Reads the file of an environment, unless it was. @throws Error::Read for what is no Radiance picture; Error::Input for one without light
void load(WantedWideLight& light);
WideLight loaded(const WantedWideLight& light);

} // namespace limn
