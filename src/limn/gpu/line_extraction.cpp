#include "limn/gpu/line_extraction.h"

#include <algorithm>
#include <string>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/gpu/context.h"
#include "limn/lines/suggestive_face.h"

namespace limn::gpu {
namespace {

constexpr std::size_t block_size = 256, words_per_block = 3 * block_size / 32, grain = 16384; // as in extraction_elements.glsl

/// As in segments.glsl.
struct DeviceSegment {
    vec4 a, b;
    std::uint32_t face, id_a, id_b, other;
};
constexpr std::size_t command_bytes = 4 * sizeof(unsigned), fill_groups_at = 3 * command_bytes; // as in extract_commands.comp

std::size_t blocks_of(std::size_t elements) { return (elements + block_size - 1) / block_size; }

/// One vec4 per vertex.
template <class At> Buffer upload_vertices(std::size_t count, At&& at)
{
    std::vector<vec4> data(count);
    parallel_each(count, grain, [&](std::size_t i) { data[i] = at(i); });
    return Buffer(data);
}

Buffer upload_creases(const LineModel& m)
{
    std::vector<uvec4> creases;
    for (const std::uint32_t h : m.split_edges) {
        const auto node = [&](std::uint32_t half_edge) { return m.vertex_node(m.faces[half_edge / 3][int(half_edge % 3)]); };
        creases.emplace_back(h, m.welded_adjacency.twin[h], node(h), node(next_half_edge(h)));
    }
    return Buffer(storage_bytes(creases.size(), sizeof(uvec4), "creases"), creases.data());
}

const LineModel& checked(const LineModel& model)
{
    if (model.normals.empty())
        throw Error::Input("a line drawing needs the normals of the surface");
    storage_bytes(model.faces.size(), sizeof(uvec3), "faces");
    storage_bytes(model.vertex_count(), sizeof(vec4), "vertices");
    return model;
}

void set_limits(const Program& program, const char* index, const SuggestiveOptions* options)
{
    if (!options)
        return;
    const formulas::SuggestiveLimits limits = suggestive_limits(*options);
    const auto set = [&](const char* name, float value) { program.set(fmt::format("limits[{}].{}", index, name).c_str(), value); };
    set("feature_size", limits.feature_size);
    set("limit", limits.limit);
    set("fade", limits.fade);
    set("speed_limit", limits.speed_limit);
    set("side", limits.side);
}

/// Bits for the kinds: contours, suggestive contours, highlights.
unsigned bits(bool contours, bool suggestive, bool highlights) { return unsigned(contours) | unsigned(suggestive) << 1 | unsigned(highlights) << 2; }

void set_view(const Program& program, const View& view, const ClusterRequest& request)
{
    const auto front = [](const SuggestiveOptions* options) { return options && options->shortcuts.front_only; };
    program.set("eye", view.eye);
    program.set("orthographic", int(view.orthographic));
    program.set("wanted", bits(request.contours, request.suggestive != nullptr, request.highlights != nullptr));
    program.set("front_only", bits(false, front(request.suggestive), front(request.highlights)));
    set_limits(program, "0", request.suggestive);
    set_limits(program, "1", request.highlights);
}

Segment from_device(const LineModel& model, const DeviceSegment& s)
{
    Segment segment = {vec3(s.a), vec3(s.b), s.a.w, s.b.w, s.face, s.id_a, s.id_b, s.other, s.other != none};
    if (!segment.along_edge)
        for (std::uint32_t* edge : {&segment.edge_a, &segment.edge_b})
            if (*edge != none)
                *edge = model.adjacency.edge_id(*edge);
    return segment;
}

} // namespace

LineExtractor::LineExtractor(const LineModel& model)
    : model_(checked(model)), face_blocks_(blocks_of(model.faces.size())), blocks_(face_blocks_ + blocks_of(3 * model.split_edges.size())),
      vertices_program_(load_program({"extract_vertices.comp"})), count_program_(load_program({"extract_count.comp"})),
      commands_program_(load_program({"extract_commands.comp"})), fill_program_(load_program({"extract_fill.comp"})), geometry_(model),
      creases_(upload_creases(model)), commands_(4 * command_bytes), scan_(blocks_)
{
    const std::size_t n = model.vertex_count();
    if (model.has_derivative()) {
        e1_ = upload_vertices(n, [&](std::size_t i) { return vec4(model.e1[i], model.k1[i]); });
        e2_ = upload_vertices(n, [&](std::size_t i) { return vec4(model.e2[i], model.k2[i]); });
        derivatives_ = Buffer(model.derivative);
        speeds_ = Buffer(n * sizeof(vec2));
    }
    values_ = Buffer(n * sizeof(vec4));
    found_ = Buffer(blocks_ * words_per_block * sizeof(unsigned));
    segments_ = Buffer(0);
    vertices_program_.set("vertex_count", unsigned(n));
    for (const Program* program : {&count_program_, &fill_program_}) {
        program->set("face_count", unsigned(model.faces.size()));
        program->set("crease_count", unsigned(model.split_edges.size()));
        program->set("face_blocks", unsigned(face_blocks_));
        program->set("block_count", unsigned(blocks_));
    }
    fill_program_.set("level1", scan_.level1());
    fill_program_.set("level2", scan_.level2());
    fill_program_.set("total", scan_.total());
    commands_program_.set("total", scan_.total());
}

void LineExtractor::extract(const View& view, const ClusterRequest& request)
{
    if ((request.suggestive || request.highlights) && !model_.has_derivative())
        throw Error::Input("suggestive lines need the derivative of curvature, which the surface does not hold");
    find(view, request);
    fill();
    if (!measured_)
        complete();
    measured_ = true;
}

void LineExtractor::find(const View& view, const ClusterRequest& request) const
{
    for (const Program* program : {&vertices_program_, &count_program_, &fill_program_})
        set_view(*program, view, request);
    geometry_.positions.bind_storage(0);
    geometry_.normals.bind_storage(1);
    values_.bind_storage(2);
    if (model_.has_derivative()) {
        speeds_.bind_storage(3);
        e1_.bind_storage(4);
        e2_.bind_storage(5);
        derivatives_.bind_storage(6);
    }
    vertices_program_.use();
    dispatch_groups(blocks_of(model_.vertex_count()));

    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    geometry_.faces.bind_storage(1);
    creases_.bind_storage(4);
    found_.bind_storage(5);
    scan_.sums().bind_storage(6);
    count_program_.use();
    dispatch_groups(blocks_);
    scan_.run();
}

void LineExtractor::fill() const
{
    const auto bind = [](std::initializer_list<const Buffer*> buffers) {
        unsigned binding = 0;
        for (const Buffer* buffer : buffers)
            buffer->bind_storage(binding++);
    };
    bind({&geometry_.positions, &geometry_.faces, &values_, &speeds_, &creases_, &found_, &scan_.sums(), &commands_});
    commands_program_.set("capacity", unsigned(capacity_));
    commands_program_.use();
    glDispatchCompute(1, 1, 1);

    segments_.bind_storage(7);
    fill_program_.set("capacity", unsigned(capacity_));
    fill_program_.use();
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, commands_.id());
    glDispatchComputeIndirect(GLintptr(fill_groups_at));
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

uvec4 LineExtractor::count() const { return scan_.sums().read<uvec4>(1, scan_.total())[0]; }

void LineExtractor::complete()
{
    const uvec4 found = count();
    const std::size_t needed = std::size_t(found.x) + found.y + found.z;
    if (needed <= capacity_)
        return;
    storage_bytes(needed, sizeof(DeviceSegment), "segments");
    GLint64 most = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    capacity_ = std::min(2 * needed, std::size_t(most) / sizeof(DeviceSegment));
    segments_ = Buffer(capacity_ * sizeof(DeviceSegment));
    fill();
}

ClusterLines LineExtractor::read()
{
    complete();
    const uvec4 found = count();
    const std::vector<DeviceSegment> all = segments_.read<DeviceSegment>(std::size_t(found.x) + found.y + found.z);
    check_errors("extracting lines");
    std::size_t first = 0;
    const auto take = [&](std::size_t number) {
        std::vector<Segment> segments(number);
        parallel_each(number, grain, [&](std::size_t i) { segments[i] = from_device(model_, all[first + i]); });
        first += number;
        return segments;
    };
    ClusterLines lines;
    lines.contours = take(found.x);
    lines.suggestive = take(found.y);
    lines.highlights = take(found.z);
    return lines;
}

} // namespace limn::gpu
