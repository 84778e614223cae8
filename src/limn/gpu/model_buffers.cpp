#include "limn/gpu/model_buffers.h"

#include <epoxy/gl.h>

namespace limn::gpu {
namespace {

std::vector<vec4> positions_of(const LineModel& m)
{
    std::vector<vec4> positions(m.vertex_count());
    for (std::size_t object = 0; object + 1 < m.first_vertex.size(); ++object)
        for (std::uint32_t i = m.first_vertex[object]; i < m.first_vertex[object + 1]; ++i)
            positions[i] = vec4(m.positions[i], float(object));
    return positions;
}

std::vector<vec4> normals_of(const LineModel& m)
{
    std::vector<vec4> normals(m.vertex_count(), vec4(0));
    for (std::size_t i = 0; i < m.normals.size(); ++i)
        normals[i] = vec4(m.normals[i], 0);
    return normals;
}

} // namespace

ModelBuffers::ModelBuffers(const LineModel& model)
    : positions(positions_of(model)), normals(normals_of(model)), faces(model.faces), array(make_vertex_array())
{
    glVertexArrayElementBuffer(array.id(), faces.id());
}

void ModelBuffers::bind() const
{
    positions.bind_storage(positions_at);
    normals.bind_storage(normals_at);
    faces.bind_storage(faces_at);
}

void ModelBuffers::draw() const
{
    glBindVertexArray(array.id());
    glDrawElements(GL_TRIANGLES, GLsizei(3 * face_count()), GL_UNSIGNED_INT, nullptr);
    glBindVertexArray(0);
}

void ModelBuffers::draw_corners() const
{
    glBindVertexArray(array.id());
    glDrawArrays(GL_TRIANGLES, 0, GLsizei(3 * face_count()));
    glBindVertexArray(0);
}

} // namespace limn::gpu
