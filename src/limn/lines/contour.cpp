#include "limn/lines/contour.h"

#include "limn/base/parallel.h"
#include "limn/lines/contour_face.h"
#include "limn/lines/edge_zero.h"

namespace limn {
namespace {

constexpr std::size_t vertex_grain = 16384, face_grain = 8192;

/// A place along a crease edge.
struct CreasePlace {
    vec3 point;
    std::uint32_t id;
};

/// Appends the parts of the crease between half-edge h and its welded twin g where one side faces the eye and the other does not.
/// @param facing_of  n.v of a vertex
template <class F> void add_crease_outline(const LineModel& model, F&& facing_of, std::uint32_t h, std::vector<Segment>& out)
{
    const std::uint32_t g = model.welded_adjacency.twin[h];
    const auto corner = [&](std::uint32_t half_edge) { return model.faces[half_edge / 3][int(half_edge % 3)]; };
    const std::uint32_t i = corner(h), j = corner(next_half_edge(h));             // the side of h, from its start to its end
    const std::uint32_t other_i = corner(next_half_edge(g)), other_j = corner(g); // the side of g, likewise
    const float own_start = facing_of(i), own_end = facing_of(j), other_start = facing_of(other_i), other_end = facing_of(other_j);
    const EdgeZero own = edge_zero(i, j, own_start, own_end), other = edge_zero(other_i, other_j, other_start, other_end);
    const float own_s = own.from == i ? own.t : 1 - own.t, other_s = other.from == other_i ? other.t : 1 - other.t;
    const auto place = [&](std::uint32_t which) -> CreasePlace {
        switch (which) {
        case formulas::CREASE_START: return {model.positions[i], model.vertex_node(i)};
        case formulas::CREASE_OWN_TURN: return {own.mix(model.positions[own.from], model.positions[own.to]), h};
        case formulas::CREASE_OTHER_TURN: return {other.mix(model.positions[other.from], model.positions[other.to]), g};
        default: return {model.positions[j], model.vertex_node(j)};
        }
    };
    for (int k = 0; k < 3; ++k) {
        const formulas::CreasePart part = formulas::crease_part(k, own_start, own_end, other_start, other_end, own_s, other_s);
        if (!part.drawn)
            continue;
        const CreasePlace from = place(part.from), to = place(part.to);
        const std::uint32_t front = part.own_back ? g / 3 : h / 3, behind = part.own_back ? h / 3 : g / 3;
        out.push_back({from.point, to.point, 1, 1, front, from.id, to.id, behind, true});
    }
}

} // namespace

std::vector<float> facing_of_vertices(const LineModel& model, const View& view)
{
    std::vector<float> facing(model.vertex_count());
    parallel_each(facing.size(), vertex_grain, [&](std::size_t i) { facing[i] = facing_at(model, view, std::uint32_t(i)); });
    return facing;
}

std::vector<Segment> extract_contours(const LineModel& model, std::span<const float> facing)
{
    std::vector<Segment> segments = parallel_collect<Segment>(model.faces.size(), face_grain, [&](std::size_t begin, std::size_t end, std::vector<Segment>& out) {
        for (std::size_t f = begin; f < end; ++f) {
            const uvec3& t = model.faces[f];
            const float corners[3] = {facing[t.x], facing[t.y], facing[t.z]};
            Segment segment;
            if (contour_in_face(model, std::uint32_t(f), corners, segment))
                out.push_back(segment);
        }
    });
    for (const std::uint32_t h : model.split_edges)
        add_crease_outline(model, [&](std::uint32_t v) { return facing[v]; }, h, segments);
    return segments;
}

void append_crease_outlines(const LineModel& model, const View& view, std::vector<Segment>& segments)
{
    for (const std::uint32_t h : model.split_edges)
        add_crease_outline(model, [&](std::uint32_t v) { return facing_at(model, view, v); }, h, segments);
}

} // namespace limn
