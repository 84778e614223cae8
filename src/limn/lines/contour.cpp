#include "limn/lines/contour.h"

#include "limn/base/parallel.h"
#include "limn/lines/edge_zero.h"

namespace limn {
namespace {

constexpr std::size_t vertex_grain = 16384, face_grain = 8192;

} // namespace

std::vector<float> facing_of_vertices(const LineModel& model, const View& view)
{
    std::vector<float> facing(model.vertex_count());
    parallel_each(facing.size(), vertex_grain, [&](std::size_t i) { facing[i] = glm::dot(model.normals[i], view.to_eye(model.positions[i])); });
    return facing;
}

std::vector<Segment> extract_contours(const LineModel& model, std::span<const float> facing)
{
    return parallel_collect<Segment>(model.faces.size(), face_grain, [&](std::size_t begin, std::size_t end, std::vector<Segment>& out) {
        for (std::size_t f = begin; f < end; ++f) {
            const uvec3& t = model.faces[f];
            const bool s[3] = {facing[t.x] < 0, facing[t.y] < 0, facing[t.z] < 0};
            if (s[0] == s[1] && s[1] == s[2])
                continue;
            // The two mixed edges run from and to the odd corner k. An odd back corner is entered by the edge that leaves it.
            const int k = odd_corner(s[0], s[1], s[2]);
            const int leaving = k, arriving = (k + 2) % 3; // half-edges k -> k+1 and k+2 -> k
            const int enter = s[k] ? leaving : arriving, exit = s[k] ? arriving : leaving;
            const auto end_on = [&](int edge) {
                const std::uint32_t i = t[edge], j = t[(edge + 1) % 3];
                const EdgeZero zero = edge_zero(i, j, facing[i], facing[j]);
                return zero.mix(model.positions[zero.from], model.positions[zero.to]);
            };
            Segment segment;
            segment.a = end_on(enter);
            segment.b = end_on(exit);
            segment.face = std::uint32_t(f);
            segment.edge_a = model.adjacency.edge_id(std::uint32_t(3 * f) + std::uint32_t(enter));
            segment.edge_b = model.adjacency.edge_id(std::uint32_t(3 * f) + std::uint32_t(exit));
            out.push_back(segment);
        }
    });
}

} // namespace limn
