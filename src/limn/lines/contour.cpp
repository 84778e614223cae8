#include "limn/lines/contour.h"

#include <utility>

#include "limn/base/parallel.h"
#include "limn/lines/contour_face.h"

namespace limn {
namespace {

constexpr std::size_t vertex_grain = 16384, face_grain = 8192;

/// A place on a crease edge where one of its sides turns, or one of its ends.
struct CreasePlace {
    float s; ///< from the start of the crease's half-edge
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
    const auto zero_place = [&](std::uint32_t from, std::uint32_t to, std::uint32_t id) {
        const EdgeZero zero = edge_zero(from, to, facing_of(from), facing_of(to));
        return CreasePlace{zero.from == from ? zero.t : 1 - zero.t, zero.mix(model.positions[zero.from], model.positions[zero.to]), id};
    };
    CreasePlace places[4] = {{0, model.positions[i], model.vertex_node(i)}};
    int count = 1;
    bool back = facing_of(i) < 0, other_back = facing_of(other_i) < 0;
    const bool own_turns = back != (facing_of(j) < 0), other_turns = other_back != (facing_of(other_j) < 0);
    if (own_turns)
        places[count++] = zero_place(i, j, h);
    if (other_turns)
        places[count++] = zero_place(other_i, other_j, g);
    if (count == 3 && places[2].s < places[1].s)
        std::swap(places[1], places[2]);
    places[count++] = {1, model.positions[j], model.vertex_node(j)};

    for (int k = 0; k + 1 < count; ++k) {
        back ^= places[k].id == h;
        other_back ^= places[k].id == g;
        if (back == other_back)
            continue;
        // The front keeps to the right: h has its own face to its left.
        const CreasePlace &from = back ? places[k] : places[k + 1], &to = back ? places[k + 1] : places[k];
        const std::uint32_t front = back ? g / 3 : h / 3, behind = back ? h / 3 : g / 3;
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
