#include "limn/terrain/delaunay_no_data.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace limn {
namespace {

bool has_holes(const HeightMap& map)
{
    return std::any_of(map.heights.begin(), map.heights.end(), [](float height) { return std::isnan(height); });
}

bool has_data_at_corners(const HeightMap& map, const DelaunayTriangulation& mesh, std::uint32_t triangle)
{
    for (std::uint32_t e = triangle * 3; e < triangle * 3 + 3; ++e)
        if (!map.has_data(mesh.at(e).x, mesh.at(e).y))
            return false;
    return true;
}

/// The corners of a square between four neighbouring samples, clockwise seen from above.
struct Square {
    ivec2 corners[4];
    explicit Square(int column, int row) : corners{{column, row}, {column + 1, row}, {column + 1, row + 1}, {column, row + 1}} {}
    int count_data(const HeightMap& map) const
    {
        return int(std::count_if(corners, corners + 4, [&](const ivec2& p) { return map.has_data(p.x, p.y); }));
    }
};

/// Calls `f(square)` for the squares with some corners that have data and some that do not, row by row.
template <class F> void each_mixed_square(const HeightMap& map, F&& f)
{
    for (int row = 0; row + 1 < map.rows; ++row)
        for (int column = 0; column + 1 < map.columns; ++column) {
            const Square square(column, row);
            const int count = square.count_data(map);
            if (count > 0 && count < 4)
                f(square);
        }
}

class HoleBorders {
public:
    HoleBorders(const HeightMap& map, DelaunayTriangulation& mesh) : map_(map), mesh_(mesh) {}
    void insert()
    {
        vertices_.assign(map_.heights.size(), none);
        for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v)
            vertex_at(mesh_.point(v)) = v;
        std::uint32_t last = 0;
        std::vector<std::uint32_t> changed;
        each_mixed_square(map_, [&](const Square& square) {
            for (const ivec2& p : square.corners)
                if (vertex_at(p) == none) {
                    last = mesh_.find_triangle(p, last);
                    changed.clear();
                    vertex_at(p) = mesh_.insert(p, last, changed);
                }
        });
        each_mixed_square(map_, [&](const Square& square) {
            if (square.count_data(map_) == 3)
                cut_off_hole(square);
        });
    }

private:
    std::uint32_t& vertex_at(const ivec2& p) { return vertices_[map_.index(p.x, p.y)]; }
    /// Flips the diagonal that ends at the corner without data.
    void cut_off_hole(const Square& square)
    {
        for (int i = 0; i < 4; ++i)
            if (const ivec2& p = square.corners[i], &opposite = square.corners[(i + 2) % 4]; !map_.has_data(p.x, p.y)) {
                mesh_.find_star(vertex_at(p), star_);
                for (const std::uint32_t t : star_.triangles)
                    for (std::uint32_t e = t * 3; e < t * 3 + 3; ++e)
                        if (mesh_.at(e) == p && mesh_.at(DelaunayTriangulation::next(e)) == opposite)
                            return mesh_.flip(e);
            }
    }

    const HeightMap& map_;
    DelaunayTriangulation& mesh_;
    std::vector<std::uint32_t> vertices_; ///< at samples, or none
    DelaunayTriangulation::Star star_;
};

} // namespace

void insert_hole_borders(const HeightMap& map, DelaunayTriangulation& mesh)
{
    if (has_holes(map))
        HoleBorders(map, mesh).insert();
}

void drop_triangles_without_data(const HeightMap& map, DelaunayTriangulation& mesh)
{
    std::vector<std::uint32_t> dropped;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
        if (mesh.has_triangle(t) && !has_data_at_corners(map, mesh, t))
            dropped.push_back(t);
    if (!dropped.empty())
        mesh.drop(dropped);
}

} // namespace limn
