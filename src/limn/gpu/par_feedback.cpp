#include "limn/gpu/par_feedback.h"

#include <algorithm>
#include <utility>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/gpu/context.h"
#include "limn/gpu/terrain_lists.h"

namespace limn::gpu {
namespace {

constexpr std::size_t point_bytes = sizeof(std::uint32_t), triangle_bytes = 3 * point_bytes;

Name<delete_query> make_query(GLenum target)
{
    unsigned id = 0;
    glCreateQueries(target, 1, &id);
    return Name<delete_query>(id);
}

std::size_t read_query(const Name<delete_query>& query)
{
    GLuint64 value = 0;
    glGetQueryObjectui64v(query.id(), GL_QUERY_RESULT, &value);
    return std::size_t(value);
}

Texture upload_heights(const HeightMap& map)
{
    Image image(ivec2(map.columns, map.rows), 1);
    image.samples = map.heights;
    return make_mipmaps({image});
}

ivec2 checked_points(const TerrainBuffers& terrain)
{
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    const ivec2 points = terrain.lattice().points();
    if (std::max(points.x, points.y) > most)
        throw Error::Device(fmt::format("a lattice of {} x {} points is larger than a texture of the GPU ({})", points.x, points.y, most));
    return points;
}

/// A vertex array that reads packed points, one after the other.
VertexArray make_point_array()
{
    VertexArray array = make_vertex_array();
    glEnableVertexArrayAttrib(array.id(), 0);
    glVertexArrayAttribIFormat(array.id(), 0, 1, GL_UNSIGNED_INT, 0);
    glVertexArrayAttribBinding(array.id(), 0, 0);
    return array;
}

std::vector<std::uint32_t> packed(const std::vector<BisectionTriangle>& triangles)
{
    std::vector<std::uint32_t> out;
    out.reserve(3 * triangles.size());
    for (const BisectionTriangle& t : triangles) {
        const uvec4 entry = entry_for(t, 0);
        out.insert(out.end(), {entry.x, entry.y, entry.z});
    }
    return out;
}

/// Nothing is rasterised while it lives, and what a geometry shader emits goes into a buffer.
class Feedback {
public:
    Feedback(const Buffer& target, GLenum primitive)
    {
        glEnable(GL_RASTERIZER_DISCARD);
        glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, target.id());
        glBeginTransformFeedback(primitive);
    }
    Feedback(const Feedback&) = delete;
    Feedback& operator=(const Feedback&) = delete;
    ~Feedback()
    {
        glEndTransformFeedback();
        glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
        glDisable(GL_RASTERIZER_DISCARD);
    }
};

} // namespace

ParFeedback::ParFeedback(const HeightMap& map, const TerrainBuffers& terrain, std::vector<BisectionTriangle> start, std::size_t capacity)
    : terrain_(terrain), start_(std::move(start)), mark_program_(load_program({"par_feedback.vert", "par_feedback_mark.geom"})),
      scatter_program_(load_program({"par_feedback_scatter.vert", "par_feedback_scatter.frag"})),
      refine_program_(load_program({"par_feedback.vert", "par_feedback_refine.geom"})), heights_(upload_heights(map)),
      edge_error_map_(checked_points(terrain), {Format::r32ui}), array_(make_point_array()),
      generated_(make_query(GL_PRIMITIVES_GENERATED)), written_(make_query(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN))
{
    make_room(std::max(capacity, start_.size()));
    for (const Program* program : {&mark_program_, &refine_program_})
        terrain.set_map(*program);
    scatter_program_.set("points", terrain.lattice().points());
}

ParResult ParFeedback::refine(double metres)
{
    for (const Program* program : {&mark_program_, &refine_program_}) {
        program->set("on_screen", 0u);
        program->set("tolerance", float(metres));
    }
    return run();
}

ParResult ParFeedback::refine(const Camera& camera, double pixels, double nearest)
{
    for (const Program* program : {&mark_program_, &refine_program_}) {
        terrain_.set_view(*program, camera, nearest, false);
        program->set("on_screen", 1u);
        program->set("tolerance", float(pixels));
    }
    return run();
}

ParResult ParFeedback::run()
{
    const std::vector<std::uint32_t> start = packed(start_);
    mesh_.write(0, start.size() * point_bytes, start.data());
    edge_error_map_.clear(0, 0u);
    bind_texture(heights_, 0);
    bind_texture(edge_error_map_.colour(0), 1);
    glBindVertexArray(array_.id());
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    edge_error_map_.bind(); // also for passes that draw nothing: without a window there is no other framebuffer
    ParResult result;
    for (std::size_t triangles = start_.size(), before = 0; triangles != before;) {
        ParStep step;
        for (std::size_t made = 1; made > 0; ++step.mark_passes) {
            made = mark(triangles);
            step.marks += made;
        }
        before = std::exchange(triangles, split(triangles));
        step.triangles = triangles;
        step.tested = before;
        result.steps.push_back(step);
    }
    glBindVertexArray(0);
    check_errors("refining a terrain");
    const std::size_t number = result.steps.back().triangles;
    const std::vector<std::uint32_t> points = mesh_.read<std::uint32_t>(3 * number);
    for (std::size_t i = 0; i < number; ++i)
        result.triangles.push_back(triangle_of({points[3 * i], points[3 * i + 1], points[3 * i + 2], 0}));
    return result;
}

/// One pass over the mesh, whose marks are then drawn. @return how many there are
std::size_t ParFeedback::mark(std::size_t triangles)
{
    mark_program_.use();
    glVertexArrayVertexBuffer(array_.id(), 0, mesh_.id(), 0, point_bytes);
    glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, written_.id());
    {
        const Feedback feedback(marks_, GL_POINTS);
        glDrawArrays(GL_TRIANGLES, 0, GLsizei(3 * triangles));
    }
    glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    const std::size_t found = read_query(written_);
    if (found > 0) {
        scatter_program_.use();
        glVertexArrayVertexBuffer(array_.id(), 0, marks_.id(), 0, point_bytes);
        glDrawArrays(GL_POINTS, 0, GLsizei(found));
    }
    return found;
}

/// Splits what is marked into the other buffer, which is then the mesh. @return how many triangles it has
std::size_t ParFeedback::split(std::size_t triangles)
{
    for (;;) {
        refine_program_.use();
        glVertexArrayVertexBuffer(array_.id(), 0, mesh_.id(), 0, point_bytes);
        glBeginQuery(GL_PRIMITIVES_GENERATED, generated_.id());
        glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, written_.id());
        {
            const Feedback feedback(finer_, GL_TRIANGLES);
            glDrawArrays(GL_TRIANGLES, 0, GLsizei(3 * triangles));
        }
        glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
        glEndQuery(GL_PRIMITIVES_GENERATED);
        const std::size_t made = read_query(generated_);
        if (made == read_query(written_)) {
            std::swap(mesh_, finer_);
            return made;
        }
        make_room(2 * made);
    }
}

void ParFeedback::make_room(std::size_t capacity)
{
    Buffer larger(capacity * triangle_bytes);
    if (mesh_.bytes() > 0)
        glCopyNamedBufferSubData(mesh_.id(), larger.id(), 0, 0, GLsizeiptr(mesh_.bytes()));
    mesh_ = std::move(larger);
    finer_ = Buffer(capacity * triangle_bytes);
    marks_ = Buffer(capacity * point_bytes);
    capacity_ = capacity;
}

} // namespace limn::gpu
