#pragma once

#include <vector>

#include "limn/base/image.h"
#include "limn/base/vec.h"

namespace limn {

/// Normals of a model in textures, finer than those of its vertices.
struct MappedNormals {
    /// One object's texture, and how its frame stands in the model's.
    struct Part {
        std::uint32_t map = 0;
        glm::mat3 rotation = glm::mat3(1);
    };
    std::vector<const Image*> maps; ///< square, all of one size; 3 channels or more, the first three as formulas::normal_colour has them
    std::vector<Part> parts;        ///< per object of the model
    std::vector<vec2> uvs;          ///< 3 per face of the model; (0,0) is a map's lower left corner
    bool empty() const { return maps.empty(); }
};

/// A map's normal at texture coordinates, between texels too; beyond the map's border that of the border.
vec3 mapped_normal(const Image& map, const vec2& uv);

} // namespace limn
