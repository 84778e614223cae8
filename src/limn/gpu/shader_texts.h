#pragma once

#include <optional>
#include <string_view>

namespace limn::gpu {

/// The text of a file of src/limn/formulas or src/limn/gpu/shaders, which the build puts into the library.
/// @param path  as included: "limn/formulas/shading.glsl"
std::optional<std::string_view> shader_text(std::string_view path);

} // namespace limn::gpu
