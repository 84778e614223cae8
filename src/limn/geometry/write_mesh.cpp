#include "limn/geometry/write_mesh.h"

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/geometry/writers.h"

namespace limn {

void write_mesh(const Mesh& mesh, const std::filesystem::path& path, const WriteMeshOptions& options)
{
    const std::string format = file_ending(options.format.empty() ? path : std::filesystem::path("x." + options.format));
    if (format == "obj")
        write_file(path, obj_bytes(mesh, options));
    else if (format == "ply")
        write_file(path, ply_bytes(mesh, options));
    else if (format == "stl")
        write_file(path, stl_bytes(mesh));
    else if (format == "glb")
        write_file(path, glb_bytes(mesh, options));
    else
        throw Error::Input(fmt::format("{}: '{}' is no mesh format that can be written; these are obj, ply, stl and glb", path.string(), format));
}

} // namespace limn
