#pragma once

#include <span>
#include <string>
#include <vector>

#include "limn/geometry/mesh.h"

namespace limn {

/// Faces of a part of a file, in its order, as their reader found them. Indices count from 0 and are in range.
struct FaceBlock {
    std::vector<std::uint32_t> corners; ///< vertex of each corner
    std::vector<std::uint32_t> sizes;   ///< corners of each face, at least 3; empty: all are triangles
    std::vector<std::uint32_t> uvs;     ///< texture coordinate of each corner, or `none`; empty: no corner has one
    std::vector<std::uint32_t> normals; ///< normal of each corner, or `none`; empty: no corner has one
    struct GroupStart {
        std::uint32_t face, group; ///< faces from here on belong to this group
    };
    std::vector<GroupStart> groups; ///< ascending; empty: no groups. The first starts at face 0.

    std::size_t face_count() const { return sizes.empty() ? corners.size() / 3 : sizes.size(); }
    std::size_t triangle_count() const { return corners.size() - 2 * face_count(); }
    /// Adds the number of corners of the face whose corners were just appended.
    void end_face(std::uint32_t size);
};

/// Cuts the faces into triangles and appends them to `mesh`, whose positions are complete; fills corner normals and
/// texture coordinates, groups, and (with `keep_polygons`, where some face is no triangle) the polygons.
/// Corners without a normal get the normal of their triangle; those without a texture coordinate get 0.
/// Releases the blocks' memory.
void assemble_faces(Mesh& mesh, std::vector<FaceBlock>& blocks, std::span<const vec2> uvs, std::span<const vec3> normals,
                    bool keep_polygons);

/// Fills corner normals and texture coordinates from ones given per vertex; an empty list leaves them out.
void take_corners_from_vertices(Mesh& mesh, std::span<const vec3> normals, std::span<const vec2> uvs);

} // namespace limn
