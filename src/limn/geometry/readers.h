#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "limn/geometry/mesh.h"

namespace limn {

// The reader of each format, behind read_mesh.h: bytes in, mesh as it stands in the file out (NaN positions, unused
// vertices and all). Each takes the file's bytes over, to free them early. `name` is the file's name for messages;
// `notes` receives what is unclean but readable. All throw Error::Read with line or byte.

struct FileBytes {
    std::string bytes;
    std::string name;
};

Mesh read_obj(FileBytes file, bool keep_polygons, std::vector<std::string>& notes);
Mesh read_ply(FileBytes file, bool keep_polygons, std::vector<std::string>& notes);
Mesh read_stl(FileBytes file);
/// True where the bytes are as long as a binary STL's own count of triangles says.
bool is_binary_stl(std::string_view bytes);
Mesh read_off(FileBytes file, bool keep_polygons);
/// @param ending  tells Assimp the format where the bytes do not
Mesh read_with_assimp(FileBytes file, const std::string& ending);
/// True where Assimp has a reader for files with this ending ("glb").
bool is_known_to_assimp(const std::string& ending);

} // namespace limn
