#include "limn/geometry/read_mesh.h"

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/geometry/clean.h"
#include "limn/geometry/counted.h"
#include "limn/geometry/orient.h"
#include "limn/geometry/readers.h"
#include "limn/geometry/vertex_order.h"
#include "limn/geometry/weld.h"

namespace limn {
namespace {

/// The format that the first bytes give away, or "".
std::string format_of_bytes(std::string_view bytes)
{
    if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r"))
        return "ply";
    if (bytes.starts_with("glTF"))
        return "glb";
    if (bytes.starts_with("OFF") || bytes.starts_with("COFF") || bytes.starts_with("NOFF"))
        return "off";
    if (bytes.size() > 84 && is_binary_stl(bytes))
        return "stl";
    if (bytes.starts_with("solid"))
        return "stl";
    const std::string_view head = bytes.substr(0, 4096);
    if (head.starts_with("v ") || head.find("\nv ") != std::string_view::npos || head.find("\nmtllib ") != std::string_view::npos)
        return "obj";
    return "";
}

/// The format asked for, or the ending's where it is one of a mesh, or the one the bytes give away.
std::string format_of(const std::filesystem::path& path, const std::string& asked, std::string_view bytes, const std::string& name)
{
    const std::string ending = file_ending(asked.empty() ? path : std::filesystem::path("x." + asked));
    if (!ending.empty() && is_mesh_format(ending))
        return ending;
    const std::string found = asked.empty() ? format_of_bytes(bytes) : "";
    if (found.empty())
        throw Error::Read(ending.empty() ? fmt::format("{}: unknown format: it has no ending, and does not begin as PLY, OBJ, STL, OFF or glTF", name)
                                         : fmt::format("{}: unknown format '{}'", name, ending));
    return found;
}

Mesh read_format(FileBytes file, const std::string& format, bool keep_polygons, std::vector<std::string>& notes)
{
    if (format == "obj")
        return read_obj(std::move(file), keep_polygons, notes);
    if (format == "ply")
        return read_ply(std::move(file), keep_polygons, notes);
    if (format == "stl")
        return read_stl(std::move(file));
    if (format == "off")
        return read_off(std::move(file), keep_polygons);
    return read_with_assimp(std::move(file), format);
}

void clean(Mesh& mesh, std::vector<std::string>& notes)
{
    const DroppedFaces dropped = drop_bad_faces(mesh);
    if (dropped.not_finite > 0)
        notes.push_back(counted(dropped.not_finite, "face", "faces") + " with NaN or infinite vertices dropped");
    if (dropped.repeated > 0)
        notes.push_back(counted(dropped.repeated, "face that uses", "faces that use") + " a vertex twice dropped");
    if (dropped.duplicate > 0)
        notes.push_back(counted(dropped.duplicate, "duplicate face", "duplicate faces") + " dropped");
    drop_unused_vertices(mesh);
}

void orient(Mesh& mesh, std::vector<std::string>& notes)
{
    if (const std::size_t turned = orient_faces(mesh); turned > 0)
        notes.push_back(counted(turned, "face", "faces") + " turned round");
}

} // namespace

bool is_mesh_format(const std::string& format)
{
    return format == "obj" || format == "ply" || format == "stl" || format == "off" || is_known_to_assimp(format);
}

ReadResult read_mesh_with_notes(const std::filesystem::path& path, const ReadOptions& options)
{
    const std::string name = path == "-" ? "standard input" : path.string();
    FileBytes file{read_file(path), name};
    if (file.bytes.empty())
        throw Error::Read(fmt::format("{}: is empty", name));
    const std::string format = format_of(path, options.format, file.bytes, name);
    ReadResult result;
    const std::size_t size = file.bytes.size();
    result.mesh = read_format(std::move(file), format, options.keep_polygons, result.notes);
    Mesh& mesh = result.mesh;
    if (!options.keep_polygons) {
        ReadOptions tidy = options;
        tidy.weld = options.weld || format == "stl";
        tidy_mesh(mesh, tidy, result.notes);
    }
    if (mesh.triangles.empty()) {
        std::string why;
        for (const std::string& note : result.notes)
            why += (why.empty() ? " (" : "; ") + note;
        throw Error::Read(fmt::format("{}: holds no face in its {} bytes{}", name, size, why.empty() ? why : why + ")"));
    }
    return result;
}

void tidy_mesh(Mesh& mesh, const ReadOptions& options, std::vector<std::string>& notes)
{
    if (options.weld)
        weld(mesh);
    if (options.clean)
        clean(mesh, notes);
    if (options.orient)
        orient(mesh, notes);
    if (options.cache_order)
        put_in_cache_order(mesh);
}

Mesh read_mesh(const std::filesystem::path& path, const ReadOptions& options)
{
    return read_mesh_with_notes(path, options).mesh;
}

} // namespace limn
