#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/geometry/byte_writer.h"
#include "limn/geometry/split_corners.h"
#include "limn/geometry/writers.h"

namespace limn {
namespace {

using nlohmann::json;

constexpr std::size_t grain = 1 << 14;
constexpr int type_byte = 5121, type_uint = 5125, type_float = 5126; // glTF 2.0, section 3.6.2.2
constexpr int target_vertices = 34962, target_indices = 34963;

/// The two chunks of a .glb while they are filled: arrays one after the other, all of 4-byte items, so that every offset
/// is aligned.
struct Chunks {
    json document;
    std::string binary;

    /// Adds an array of `count` items of `width` bytes that `fill(at, i)` writes. @return the number of its accessor
    template <class Fill> std::size_t add(std::size_t count, std::size_t width, json accessor, int target, Fill&& fill)
    {
        const std::size_t offset = binary.size();
        if (offset + count * width > std::numeric_limits<std::uint32_t>::max() - 65536)
            throw Error::Input("the mesh is too large for a glTF binary file, which holds 4 GiB at most");
        binary.resize(offset + count * width);
        parallel_each(count, grain, [&](std::size_t i) { fill(binary.data() + offset + i * width, i); });
        document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", count * width}, {"target", target}});
        accessor["bufferView"] = document["bufferViews"].size() - 1;
        accessor["count"] = count;
        document["accessors"].push_back(std::move(accessor));
        return document["accessors"].size() - 1;
    }
};

std::string join(const Chunks& chunks)
{
    std::string text = chunks.document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t total = 12 + 8 + text.size() + 8 + chunks.binary.size();
    std::string file(20, '\0');
    char* at = put(file.data(), std::uint32_t(0x46546c67)); // "glTF"
    at = put(put(at, std::uint32_t(2)), std::uint32_t(total));
    put(put(at, std::uint32_t(text.size())), std::uint32_t(0x4e4f534a)); // "JSON"
    file.reserve(total);
    file += text;
    char head[8];
    put(put(head, std::uint32_t(chunks.binary.size())), std::uint32_t(0x004e4942)); // "BIN"
    file.append(head, 8);
    file += chunks.binary;
    return file;
}

char* put_vector(char* at, const vec3& v) { return put(put(put(at, v.x), v.y), v.z); }

/// glTF demands the box of the positions as they are stored: rounded to float.
json position_accessor(const std::vector<vec3>& positions)
{
    vec3 low(std::numeric_limits<float>::infinity()), high(-low);
    for (const vec3& p : positions) {
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            throw Error::Input("glTF cannot hold NaN or infinite coordinates");
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return {{"componentType", type_float}, {"type", "VEC3"}, {"min", {low.x, low.y, low.z}}, {"max", {high.x, high.y, high.z}}};
}

/// Adds a PNG file as a texture. @return its number
std::size_t add_texture(Chunks& chunks, const std::string& png)
{
    const std::size_t offset = chunks.binary.size();
    if (offset + png.size() > std::numeric_limits<std::uint32_t>::max() - 65536)
        throw Error::Input("the mesh and its textures are too large for a glTF binary file, which holds 4 GiB at most");
    chunks.binary += png;
    chunks.binary.resize((chunks.binary.size() + 3) / 4 * 4, '\0');
    chunks.document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", png.size()}});
    chunks.document["images"].push_back({{"bufferView", chunks.document["bufferViews"].size() - 1}, {"mimeType", "image/png"}});
    chunks.document["textures"].push_back({{"source", chunks.document["images"].size() - 1}, {"sampler", 0}});
    return chunks.document["textures"].size() - 1;
}

/// A material whose normals or colours come from PNG files within the binary chunk.
void add_material(Chunks& chunks, const WriteMeshOptions& options)
{
    constexpr int linear = 9729, linear_mipmap_linear = 9987, clamp_to_edge = 33071; // glTF 2.0, section 5.26
    json surface = {{"metallicFactor", 0}, {"roughnessFactor", options.colour_texture.empty() ? 0.5 : 1.0}}, material;
    if (!options.normal_texture.empty())
        material["normalTexture"] = {{"index", add_texture(chunks, options.normal_texture)}};
    if (!options.colour_texture.empty())
        surface["baseColorTexture"] = {{"index", add_texture(chunks, options.colour_texture)}};
    material["pbrMetallicRoughness"] = surface;
    chunks.document["samplers"] = {{{"magFilter", linear}, {"minFilter", linear_mipmap_linear}, {"wrapS", clamp_to_edge}, {"wrapT", clamp_to_edge}}};
    chunks.document["materials"].push_back(material);
    chunks.document["meshes"][0]["primitives"][0]["material"] = 0;
}

} // namespace

std::string glb_bytes(const Mesh& mesh, const WriteMeshOptions& options)
{
    const bool normals = options.normals && !mesh.corner_normals.empty(), uvs = !mesh.corner_uvs.empty();
    const SplitCorners split = split_corners(mesh, normals, uvs);
    const std::size_t count = split.source.size();
    const auto vertex = [&](std::size_t i) { return mesh.triangles[split.source[i] / 3][int(split.source[i] % 3)]; };

    Chunks chunks;
    json attributes;
    std::vector<vec3> positions(count);
    for (std::size_t i = 0; i < count; ++i)
        positions[i] = vec3(mesh.positions[vertex(i)]);
    attributes["POSITION"] = chunks.add(count, 12, position_accessor(positions), target_vertices,
                                        [&](char* at, std::size_t i) { put_vector(at, positions[i]); });
    if (normals)
        attributes["NORMAL"] = chunks.add(count, 12, {{"componentType", type_float}, {"type", "VEC3"}}, target_vertices,
                                          [&](char* at, std::size_t i) { put_vector(at, mesh.corner_normals[split.source[i]]); });
    if (uvs) // glTF counts v from the top
        attributes["TEXCOORD_0"] = chunks.add(count, 8, {{"componentType", type_float}, {"type", "VEC2"}}, target_vertices,
                                              [&](char* at, std::size_t i) {
                                                  const vec2& uv = mesh.corner_uvs[split.source[i]];
                                                  put(put(at, uv.x), 1 - uv.y);
                                              });
    if (!mesh.colours.empty())
        attributes["COLOR_0"] = chunks.add(count, 4, {{"componentType", type_byte}, {"type", "VEC4"}, {"normalized", true}}, target_vertices,
                                           [&](char* at, std::size_t i) {
                                               for (int k = 0; k < 4; ++k)
                                                   at = put(at, std::uint8_t(glm::clamp(mesh.colours[vertex(i)][k], 0.0f, 1.0f) * 255 + 0.5f));
                                           });
    const std::size_t indices = chunks.add(split.corner.size(), 4, {{"componentType", type_uint}, {"type", "SCALAR"}}, target_indices,
                                           [&](char* at, std::size_t i) { put(at, split.corner[i]); });
    chunks.document["meshes"] = {{{"primitives", {{{"attributes", attributes}, {"indices", indices}, {"mode", 4}}}}}};
    if (!options.normal_texture.empty() || !options.colour_texture.empty())
        add_material(chunks, options);
    chunks.document["asset"] = {{"version", "2.0"}, {"generator", "Limn"}};
    chunks.document["buffers"] = {{{"byteLength", chunks.binary.size()}}};
    chunks.document["nodes"] = {{{"mesh", 0}}};
    chunks.document["scenes"] = {{{"nodes", {0}}}};
    chunks.document["scene"] = 0;
    return join(chunks);
}

} // namespace limn
