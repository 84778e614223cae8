#pragma once

#include <string>

#include "limn/geometry/mesh.h"
#include "limn/geometry/write_mesh.h"

namespace limn {

// The writer of each format, behind write_mesh.h: the bytes of the file.

std::string obj_bytes(const Mesh& mesh, const WriteMeshOptions& options);
std::string ply_bytes(const Mesh& mesh, const WriteMeshOptions& options);
std::string stl_bytes(const Mesh& mesh);
/// @throws Error::Input where a position is not finite or the file would pass 4 GiB: glTF cannot hold either
std::string glb_bytes(const Mesh& mesh, const WriteMeshOptions& options);

} // namespace limn
