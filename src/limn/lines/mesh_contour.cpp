#include "limn/lines/mesh_contour.h"

#include "limn/base/parallel.h"

namespace limn {

namespace {

constexpr std::size_t grain = 8192;

enum Side : std::uint8_t { back = 0, front = 1, no_area = 2 };

std::uint8_t side_of_face(const LineModel& model, const View& view, std::size_t face)
{
    const uvec3 t = model.faces[face];
    const dvec3 p = model.positions[t.x], q = model.positions[t.y], r = model.positions[t.z];
    const dvec3 normal = glm::cross(q - p, r - p);
    if (normal == dvec3(0))
        return no_area;
    const dvec3 to_eye = view.orthographic ? dvec3(view.eye) : dvec3(view.eye) - p;
    return glm::dot(normal, to_eye) > 0 ? front : back;
}

double edge_length_squared(const LineModel& model, std::uint32_t half_edge)
{
    const uvec3 t = model.faces[half_edge / 3];
    const vec3 d = model.positions[t[int(half_edge % 3)]] - model.positions[t[int((half_edge + 1) % 3)]];
    return double(glm::dot(d, d));
}

std::uint8_t side_of_longest_neighbour(const LineModel& model, const std::vector<std::uint8_t>& sides, std::uint32_t face)
{
    std::uint32_t longest = 3 * face;
    for (std::uint32_t h = 3 * face + 1; h < 3 * face + 3; ++h)
        if (edge_length_squared(model, h) > edge_length_squared(model, longest))
            longest = h;
    const std::uint32_t other = model.solid().twin[longest];
    return other != none && sides[other / 3] == front ? front : back;
}

} // namespace

std::vector<std::uint8_t> front_faces(const LineModel& model, const View& view)
{
    std::vector<std::uint8_t> sides(model.faces.size()), result;
    parallel_each(sides.size(), grain, [&](std::size_t f) { sides[f] = side_of_face(model, view, f); });
    result = sides;
    parallel_each(sides.size(), grain, [&](std::size_t f) {
        if (sides[f] == no_area)
            result[f] = side_of_longest_neighbour(model, sides, std::uint32_t(f));
    });
    return result;
}

std::vector<Segment> extract_mesh_contours(const LineModel& model, const View& view, const MeshContourOptions& options)
{
    const std::vector<std::uint8_t> is_front = front_faces(model, view);
    const auto separates = [&](std::uint32_t half_edge) {
        const std::uint32_t other = model.solid().twin[half_edge];
        return other == none ? options.borders : !is_front[other / 3];
    };
    return parallel_collect<Segment>(model.faces.size(), grain, [&](std::size_t begin, std::size_t end, auto& out) {
        for (std::size_t f = begin; f < end; ++f)
            for (int k = 0; is_front[f] && k < 3; ++k)
                if (separates(std::uint32_t(3 * f) + std::uint32_t(k))) {
                    const std::uint32_t a = model.welded(model.faces[f][k]), b = model.welded(model.faces[f][(k + 1) % 3]);
                    const std::uint32_t twin = model.solid().twin[3 * f + std::size_t(k)];
                    out.push_back({model.positions[a], model.positions[b], 1, 1, std::uint32_t(f), a, b, twin == none ? none : twin / 3, true});
                }
    });
}

} // namespace limn
