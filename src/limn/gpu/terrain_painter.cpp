#include "limn/gpu/terrain_painter.h"

#include <algorithm>
#include <limits>

#include <epoxy/gl.h>

namespace limn::gpu {
namespace {

/// Depths from 1 at the nearest to 0, for as long as it lives.
class FallingDepth {
public:
    FallingDepth()
    {
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        glDepthFunc(GL_GEQUAL);
    }
    ~FallingDepth()
    {
        glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
        glDepthFunc(GL_LESS);
    }
    FallingDepth(const FallingDepth&) = delete;
    FallingDepth& operator=(const FallingDepth&) = delete;
};

/// Half of the picture at depth 1, or at any in parallel views.
dvec2 half_picture(const Camera& camera)
{
    const double pixels = camera.pixels_per_unit(1);
    return dvec2(camera.size) / (2 * pixels);
}

double reach_of(const TerrainModel& model)
{
    float furthest = 0;
    for (const vec4& v : model.vertices)
        furthest = std::max(furthest, glm::length(vec3(v)));
    return double(furthest);
}

} // namespace

TerrainPainter::TerrainPainter(const HeightMap& frame, const PyramidLayout& layout)
    : spacing_(frame.spacing), rows_(frame.rows), program_(load_program({"terrain_paint.vert", "terrain_paint.frag"})),
      lines_(load_program({"terrain_paint.vert", "terrain_mesh_lines.frag"})), normals_(layout), array_(make_vertex_array())
{
}

void TerrainPainter::take(const TerrainModel& model)
{
    middle_ = model.middle;
    reach_ = reach_of(model);
    triangles_ = model.triangles.size();
    met_ = model.met;
    storage_bytes(model.vertices.size(), sizeof(vec4), "vertices of a terrain");
    vertices_ = {}, faces_ = {}; // before there are both
    vertices_ = Buffer(model.vertices);
    faces_ = Buffer(model.triangles);
    glVertexArrayElementBuffer(array_.id(), faces_.id());
}

double TerrainPainter::farthest(const Camera& camera) const { return glm::length(middle_ - camera.eye) + reach_ + 1; }

void TerrainPainter::draw(const Framebuffer& target, const Camera& camera, const TerrainPaint& paint, double nearest) const
{
    target.clear(0, vec4(paint.background, 1));
    target.clear_depth(0);
    if (triangles_ == 0)
        return;
    for (const Program* program : {&program_, &lines_}) {
        program->set("middle", vec3(middle_ - camera.eye));
        program->set("right", vec3(camera.right()));
        program->set("above", vec3(camera.above()));
        program->set("forward", vec3(camera.forward()));
        program->set("across", vec2(half_picture(camera)));
        program->set("nearest", float(nearest));
        program->set("farthest", float(farthest(camera)));
        program->set("parallel", int(camera.orthographic));
    }
    const dvec2 sample = {middle_.x / spacing_.x, double(rows_ - 1) - middle_.y / spacing_.y}, whole = glm::floor(sample);
    program_.set("spacing", vec2(spacing_));
    program_.set("middle_cell", ivec2(whole));
    program_.set("middle_rest", vec2(sample - whole));
    program_.set("pixels_between_normals", float(pixels_between_normals));
    normals_.bind(program_, 0, 1);
    program_.set("to_sun", paint.to_sun);
    program_.set("plain", paint.plain ? vec4(*paint.plain, 1) : vec4(0));
    program_.set("marked", paint.marks ? int(met_) : std::numeric_limits<int>::max());
    const FallingDepth depths;
    target.bind();
    vertices_.bind_storage(0);
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glBindVertexArray(array_.id());
    program_.use();
    const auto draw_all = [&] { glDrawElements(GL_TRIANGLES, GLsizei(3 * triangles_), GL_UNSIGNED_INT, nullptr); };
    draw_all();
    if (paint.mesh_lines) {
        lines_.use();
        glEnable(GL_BLEND);
        glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
        glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
        glEnable(GL_POLYGON_OFFSET_LINE);
        glPolygonOffset(1, 1); // nearer, where depths fall
        draw_all();
        glDisable(GL_POLYGON_OFFSET_LINE);
        glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
        glDisable(GL_BLEND);
    }
    glBindVertexArray(0);
}

std::optional<double> TerrainPainter::depth_at(const Framebuffer& target, const Camera& camera, const ivec2& pixel, double nearest) const
{
    const ivec2 size = target.size();
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= size.x || pixel.y >= size.y)
        return {};
    const double value = double(target.depth_at({pixel.x, size.y - 1 - pixel.y}));
    if (value <= 0)
        return {};
    return camera.orthographic ? nearest + (1 - value) * (farthest(camera) - nearest) : nearest / value;
}

} // namespace limn::gpu
