#pragma once

#include <string>
#include <string_view>

namespace limn {

/// Checks that what a glTF file claims to hold is there, since Assimp takes memory for it before it looks: the lengths of a
/// .glb and its chunks, the nesting of its JSON, buffers, buffer views and accessors. The rest is Assimp's to check.
/// @param binary  a .glb; else the JSON of a .gltf
/// @throws Error::Read naming the claim and what there is
void check_gltf_claims(std::string_view bytes, bool binary, const std::string& name);

} // namespace limn
