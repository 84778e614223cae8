#include "limn/subdivision/limit_triangles.h"

#include "limn/base/parallel.h"
#include "limn/subdivision/contour_cells.h"

namespace limn {
namespace {

constexpr int least_levels = 3, least_beside_semi_sharp = 5, most_levels = 12;

/// Per face: whether an edge at one of its corners is semi-sharp.
std::vector<std::uint8_t> faces_beside_semi_sharp(const LoopTopology& t)
{
    std::vector<std::uint8_t> vertices(t.vertex_count(), 0), faces(t.triangles.size());
    for (std::uint32_t e = 0; e < t.edge_count(); ++e)
        if (t.sharpness[e] > 0 && t.sharpness[e] < infinitely_sharp)
            vertices[t.start(t.half_edge[e])] = vertices[t.end(t.half_edge[e])] = 1;
    for (std::size_t f = 0; f < faces.size(); ++f)
        faces[f] = std::uint8_t(vertices[t.triangles[f].x] | vertices[t.triangles[f].y] | vertices[t.triangles[f].z]);
    return faces;
}

class NearTriangles {
public:
    NearTriangles(const LimitShape& shape, std::uint32_t face, double near, int least, std::vector<dvec3>& corners)
        : shape_(shape), face_(face), near_(near), least_(least), corners_(corners)
    {
    }
    void append(const ParameterTriangle& at, int level)
    {
        const dvec3 p[3] = {position(at[0]), position(at[1]), position(at[2])};
        if (level < least_ || (level < most_levels && distance(at, p) > near_)) {
            for (const ParameterTriangle& quarter : quarters(at))
                append(quarter, level + 1);
            return;
        }
        corners_.insert(corners_.end(), p, p + 3);
    }

private:
    dvec3 position(const dvec2& at) const { return shape_.position({face_, at.x, at.y}); }
    double distance(const ParameterTriangle& at, const dvec3 (&p)[3]) const
    {
        double most = glm::distance(position((at[0] + at[1] + at[2]) / 3.0), (p[0] + p[1] + p[2]) / 3.0);
        for (std::size_t k = 0; k < 3; ++k)
            most = std::max(most, glm::distance(position(0.5 * (at[k] + at[(k + 1) % 3])), 0.5 * (p[k] + p[(k + 1) % 3])));
        return most;
    }

    const LimitShape& shape_;
    std::uint32_t face_;
    double near_;
    int least_;
    std::vector<dvec3>& corners_;
};

} // namespace

Mesh limit_triangles(const LimitShape& shape, double near)
{
    const LoopTopology& t = shape.table().control();
    const std::vector<std::uint8_t> narrow = faces_beside_semi_sharp(t);
    Mesh mesh;
    mesh.positions = parallel_collect<dvec3>(t.triangles.size(), 4, [&](std::size_t begin, std::size_t end, std::vector<dvec3>& corners) {
        for (std::size_t f = begin; f < end; ++f)
            NearTriangles(shape, std::uint32_t(f), near, narrow[f] ? least_beside_semi_sharp : least_levels, corners).append({dvec2(0, 0), dvec2(1, 0), dvec2(0, 1)}, 0);
    });
    mesh.triangles.reserve(mesh.positions.size() / 3);
    for (std::uint32_t first = 0; first < mesh.positions.size(); first += 3)
        mesh.triangles.push_back({first, first + 1, first + 2});
    return mesh;
}

} // namespace limn
