#pragma once

#include <filesystem>
#include <string>

#include "limn/geometry/mesh.h"

namespace limn {

struct WriteMeshOptions {
    std::string format = {};      ///< ending to use ("obj", "ply", "stl", "glb"); "" takes the path's
    bool double_positions = false; ///< PLY: write double instead of float properties; OBJ always keeps 17 digits when set
    bool normals = true;          ///< write corner normals where the mesh has them and the format can
    std::string normal_texture = {}; ///< glTF: a PNG file's bytes, a tangent-space normal map for the mesh's texture coordinates; "": none
    std::string colour_texture = {}; ///< glTF: a PNG file's bytes, colours for the same coordinates; "": none
};

/// Writes OBJ, PLY (binary little endian), STL (binary) or glTF binary (.glb). "-" writes to standard output.
/// @throws Error::Write when the file cannot be written, Error::Input when the format is unknown.
void write_mesh(const Mesh& mesh, const std::filesystem::path& path, const WriteMeshOptions& options = {});

} // namespace limn
