#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace limn {

// The vector types of the whole house are GLM's, so that formulas/ compiles as C++ and as GLSL.
using glm::dmat3;
using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;
using glm::ivec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

/// "No index": a missing neighbour, face, edge or vertex.
inline constexpr std::uint32_t none = 0xFFFFFFFFu;

} // namespace limn
