#include "mesh_painter.h"

#include <epoxy/gl.h>
#include <glm/gtc/matrix_transform.hpp>

using namespace limn;

namespace {

constexpr const char* vertex_text = R"(
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Normals { vec4 normals[]; };
layout(std430, binding = 2) readonly buffer Triangles { uint corners[]; };
uniform mat4 to_clip;
out vec3 normal;
void main()
{
    normal = normals[gl_VertexID].xyz;
    gl_Position = to_clip * vec4(positions[corners[gl_VertexID]].xyz, 1.0f);
}
)";

constexpr const char* fragment_text = R"(
in vec3 normal;
layout(location = 0) out vec4 colour;
void main() { colour = vec4(0.5f + 0.5f * normalize(normal), 1.0f); }
)";

/// Writes into a buffer, or into a larger new one where it does not fit.
void write(gpu::Buffer& buffer, std::size_t bytes, const void* data)
{
    if (bytes > buffer.bytes())
        buffer = gpu::Buffer(bytes, data);
    else
        buffer.write(0, bytes, data);
}

glm::mat4 clip_of(const Camera& camera, const Bounds& bounds)
{
    const double distance = glm::distance(camera.eye, bounds.centre()), near = std::max(distance - bounds.radius(), 0.01 * distance), far = distance + bounds.radius();
    const double aspect = double(camera.size.x) / camera.size.y, half = 0.5 * camera.ortho_height;
    const glm::dmat4 projection = camera.orthographic ? glm::ortho(-half * aspect, half * aspect, -half, half, near, far)
                                                      : glm::perspective(glm::radians(camera.fov_degrees), aspect, near, far);
    return glm::mat4(projection * glm::lookAt(camera.eye, camera.look, camera.up));
}

} // namespace

MeshPainter::MeshPainter(ivec2 size)
    : program_({{gpu::Stage::vertex, "painted.vert", vertex_text}, {gpu::Stage::fragment, "painted.frag", fragment_text}}),
      picture_(size, {gpu::Format::rgba8}), array_(gpu::make_vertex_array())
{
}

void MeshPainter::keep_triangles(std::span<const uvec3> triangles)
{
    write(triangles_, triangles.size_bytes(), triangles.data());
    corners_ = 3 * triangles.size();
}

template <class V> void MeshPainter::upload_any(std::span<const dvec3> positions, std::span<const V> normals)
{
    floats_.clear();
    for (const dvec3& p : positions)
        floats_.push_back(vec4(vec3(p), 1));
    write(positions_, floats_.size() * sizeof(vec4), floats_.data());
    floats_.clear();
    for (const V& n : normals)
        floats_.push_back(vec4(vec3(n), 0));
    write(normals_, floats_.size() * sizeof(vec4), floats_.data());
}

void MeshPainter::upload(std::span<const dvec3> positions, std::span<const dvec3> normals) { upload_any(positions, normals); }
void MeshPainter::upload(std::span<const dvec3> positions, std::span<const vec3> normals) { upload_any(positions, normals); }

void MeshPainter::draw(const Camera& camera, const Bounds& bounds) const
{
    picture_.bind();
    picture_.clear(0, vec4(0));
    picture_.clear_depth();
    glEnable(GL_DEPTH_TEST);
    positions_.bind_storage(0);
    normals_.bind_storage(1);
    triangles_.bind_storage(2);
    program_.set("to_clip", clip_of(camera, bounds));
    program_.use();
    glBindVertexArray(array_.id());
    glDrawArrays(GL_TRIANGLES, 0, GLsizei(corners_));
    glFinish();
}
