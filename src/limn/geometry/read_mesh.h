#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "limn/geometry/mesh.h"

namespace limn {

struct ReadOptions {
    std::string format = {};     ///< ending to assume ("ply"); "" takes the file's own, or looks at its first bytes
    bool weld = true;            ///< join vertices at bit-identical positions
    bool clean = true;           ///< drop faces with NaN or infinite vertices, and exact duplicates; count them in `notes`
    bool orient = true;          ///< turn faces round that disagree with their neighbours (orient.h); count them in `notes`
    bool cache_order = true;     ///< put vertices and faces in a cache-friendly order
    bool keep_polygons = false;  ///< fill Mesh::polygons, creases (control meshes); implies weld, clean, orient, cache_order off
};

/// A mesh and what was noticed while reading it.
struct ReadResult {
    Mesh mesh;
    std::vector<std::string> notes; ///< unclean but readable: one line each, with counts
};

/// True for an ending ("ply") whose files are read as meshes.
bool is_mesh_format(const std::string& format);

/// Reads OBJ, PLY and STL with Limn's own readers and every other format through Assimp. Polygons are cut into triangles.
/// "-" reads standard input (format required, or recognised by its first bytes).
/// @throws Error::Read when the file cannot be read, naming line or byte, what was found and what was expected, or when no face is left.
ReadResult read_mesh_with_notes(const std::filesystem::path& path, const ReadOptions& options = {});
Mesh read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// What reading does to triangles: welds, cleans, turns round and orders them as the options ask; for meshes that were read as they are.
/// @param mesh   without polygons, which would no longer be its triangles
/// @param notes  are added to
void tidy_mesh(Mesh& mesh, const ReadOptions& options, std::vector<std::string>& notes);

} // namespace limn
