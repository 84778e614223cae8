#include <exception>
#include <filesystem>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/geometry/gltf_claims.h"
#include "limn/geometry/readers.h"

namespace limn {
namespace {

constexpr std::size_t node_limit = 1 << 20, deepest = 1000;

dmat4 to_glm(const aiMatrix4x4& m)
{
    return glm::transpose(dmat4(m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4));
}

std::string one_line(std::string text)
{
    std::replace_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
    return text;
}

/// Where a format has a signature it is checked here: Assimp would let every other reader it has try the bytes.
void check_beginning(const FileBytes& file, const std::string& ending)
{
    constexpr std::pair<std::string_view, std::string_view> signatures[] = {{"3mf", "PK"}, {"3ds", "MM"}, {"dae", "<"}, {"x", "xof "}};
    for (const auto& [format, signature] : signatures)
        if (ending == format && !std::string_view(file.bytes).starts_with(signature))
            throw Error::Read(fmt::format("{}: byte 0: does not begin as a file of format {}", file.name, ending));
}

/// Puts the meshes of a scene's nodes into one mesh, in the order of a depth-first walk.
class SceneJoiner {
public:
    SceneJoiner(const aiScene& scene, const std::string& name) : scene_(scene), name_(name) {}

    Mesh join()
    {
        visit(*scene_.mRootNode, dmat4(1), 0);
        return std::move(mesh_);
    }

private:
    void visit(const aiNode& node, const dmat4& parent, std::size_t depth)
    {
        if (depth > deepest || ++nodes_ > node_limit)
            throw Error::Read(fmt::format("{}: node {}: the tree of nodes is deeper than {} or has more than {}", name_, nodes_, deepest, node_limit));
        const dmat4 transform = parent * to_glm(node.mTransformation);
        for (unsigned i = 0; i < node.mNumMeshes; ++i)
            if (node.mMeshes[i] < scene_.mNumMeshes)
                add(node.mMeshes[i], transform);
        for (unsigned i = 0; i < node.mNumChildren; ++i)
            visit(*node.mChildren[i], transform, depth + 1);
    }

    void add(unsigned number, const dmat4& transform)
    {
        const aiMesh& part = *scene_.mMeshes[number];
        const std::size_t first = mesh_.positions.size();
        if (first + part.mNumVertices >= none)
            throw Error::Read(fmt::format("{}: mesh {}: more vertices than 32-bit indices can name", name_, number));
        for (unsigned v = 0; v < part.mNumVertices; ++v) {
            const aiVector3D& p = part.mVertices[v];
            mesh_.positions.push_back(dvec3(transform * dvec4(p.x, p.y, p.z, 1)));
        }
        // A transform that mirrors turns faces inside out.
        const bool mirrored = glm::determinant(dmat3(transform)) < 0;
        const std::size_t before = mesh_.triangles.size();
        for (unsigned f = 0; f < part.mNumFaces; ++f)
            add_face(part.mFaces[f], number, std::uint32_t(first), mirrored);
        mesh_.face_groups.resize(mesh_.triangles.size(), std::uint32_t(mesh_.group_names.size()));
        if (mesh_.triangles.size() > before)
            mesh_.group_names.push_back(part.mName.length > 0 ? part.mName.C_Str() : fmt::format("mesh {}", mesh_.group_names.size()));
    }

    void add_face(const aiFace& face, unsigned mesh, std::uint32_t first, bool mirrored)
    {
        const unsigned vertices = scene_.mMeshes[mesh]->mNumVertices;
        if (face.mNumIndices != 3)
            return;
        uvec3 t(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
        for (int k = 0; k < 3; ++k)
            if (t[k] >= vertices)
                throw Error::Read(fmt::format("{}: mesh {}: a face has vertex index {}, outside 0..{}", name_, mesh, t[k], int(vertices) - 1));
        if (mirrored)
            std::swap(t.y, t.z);
        mesh_.triangles.push_back(t + first);
    }

    const aiScene& scene_;
    const std::string& name_;
    Mesh mesh_;
    std::size_t nodes_ = 0;
};

} // namespace

bool is_known_to_assimp(const std::string& ending)
{
    return Assimp::Importer().IsExtensionSupported("." + ending);
}

Mesh read_with_assimp(FileBytes file, const std::string& ending)
{
    check_beginning(file, ending);
    if (ending == "glb" || ending == "gltf")
        check_gltf_claims(file.bytes, ending == "glb", file.name);
    const std::size_t size = file.bytes.size();
    Assimp::Importer importer;
    // Only shape is wanted: this keeps materials, textures, bones and animations from being read where it can.
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_ANIMATIONS | aiComponent_BONEWEIGHTS | aiComponent_CAMERAS |
                                                            aiComponent_LIGHTS | aiComponent_TEXTURES | aiComponent_TEXCOORDS |
                                                            aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_NORMALS | aiComponent_COLORS);
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    try {
        constexpr unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_RemoveComponent;
        // A .gltf may keep its buffers in files beside it, which only its path finds.
        const bool has_path = ending == "gltf" && std::filesystem::exists(file.name);
        const aiScene* scene = has_path ? importer.ReadFile(file.name, steps)
                                        : importer.ReadFileFromMemory(file.bytes.data(), file.bytes.size(), steps, ending.c_str());
        if (!scene || !scene->mRootNode)
            throw Error::Read(fmt::format("{}: its {} bytes cannot be read as {}: {}", file.name, size, ending, one_line(importer.GetErrorString())));
        std::string().swap(file.bytes);
        return SceneJoiner(*scene, file.name).join();
    } catch (const Error&) {
        throw;
    } catch (const std::exception& e) {
        throw Error::Read(fmt::format("{}: its {} bytes cannot be read as {}: {}", file.name, size, ending, one_line(e.what())));
    }
}

} // namespace limn
