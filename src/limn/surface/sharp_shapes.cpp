#include "limn/surface/sharp_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "limn/base/random.h"

namespace limn {
namespace {

/// The surface points of the lattice {0…n}^3, numbered in the order in which they are asked for.
class LatticeSurface {
public:
    explicit LatticeSurface(std::uint32_t n) : n_(n) { index_.reserve(6 * std::size_t(n) * n + 2); }

    std::uint32_t vertex(const uvec3& at)
    {
        const std::uint64_t key = (std::uint64_t(at.z) * (n_ + 1) + at.y) * (n_ + 1) + at.x;
        const auto [place, is_new] = index_.try_emplace(key, std::uint32_t(points_.size()));
        if (is_new)
            points_.push_back(at);
        return place->second;
    }
    const std::vector<uvec3>& points() const { return points_; }

private:
    std::uint32_t n_;
    std::unordered_map<std::uint64_t, std::uint32_t> index_;
    std::vector<uvec3> points_;
};

/// A cap of the cylinder is a hexagonal grid bent to a disc: ring k has 6k vertices at radius k/m.
std::uint32_t disc_vertex(std::uint32_t ring, std::uint32_t step)
{
    return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1) + step % (6 * ring);
}

/// Triangles of a disc of m rings, counter-clockwise.
std::vector<uvec3> disc_triangles(std::uint32_t m)
{
    std::vector<uvec3> triangles;
    triangles.reserve(6 * std::size_t(m) * m);
    for (std::uint32_t ring = 0; ring < m; ++ring)
        for (std::uint32_t sector = 0; sector < 6; ++sector)
            for (std::uint32_t i = 0; i <= ring; ++i) {
                const std::uint32_t inner = sector * ring + i, outer = sector * (ring + 1) + i;
                triangles.push_back({disc_vertex(ring, inner), disc_vertex(ring + 1, outer), disc_vertex(ring + 1, outer + 1)});
                if (i < ring)
                    triangles.push_back({disc_vertex(ring, inner), disc_vertex(ring + 1, outer + 1), disc_vertex(ring, inner + 1)});
            }
    return triangles;
}

constexpr double cylinder_radius = 0.5, cylinder_half_height = 0.75;

struct CylinderCells {
    std::uint32_t rings, rows; ///< of a cap, of the side
};

/// Square cells as far as the wanted count allows: the rings fix the size of a cell, the rows meet the count.
CylinderCells cylinder_cells(double triangles)
{
    const double rows_per_ring = 2 * cylinder_half_height / cylinder_radius;
    const double rings = std::max(1.0, std::round(std::sqrt(triangles / (12 + 12 * rows_per_ring))));
    return {std::uint32_t(rings), std::uint32_t(std::max(1.0, std::round((triangles - 12 * rings * rings) / (12 * rings))))};
}

/// The inner vertices of both caps; the rims belong to the side.
dvec3 cap_point(std::uint32_t ring, std::uint32_t step, std::uint32_t rings, double z, double jitter, Random& random)
{
    const double cell = 1.0 / rings, radius = double(ring) / rings;
    const double angle = ring == 0 ? 0 : 2 * std::numbers::pi * step / (6.0 * ring);
    const double x = random.uniform(-jitter, jitter) * cell, y = random.uniform(-jitter, jitter) * cell;
    return {cylinder_radius * (radius * std::cos(angle) + x), cylinder_radius * (radius * std::sin(angle) + y), z};
}

dvec3 side_point(std::uint32_t row, std::uint32_t column, const CylinderCells& cells, double jitter, Random& random)
{
    const double around = 6.0 * cells.rings;
    const bool rim = row == 0 || row == cells.rows;
    const double angle = 2 * std::numbers::pi * (column + random.uniform(-jitter, jitter)) / around;
    const double height = (row + (rim ? 0 : random.uniform(-jitter, jitter))) / cells.rows;
    return {cylinder_radius * std::cos(angle), cylinder_radius * std::sin(angle), cylinder_half_height * (2 * height - 1)};
}

} // namespace

std::size_t fewest_sharp_triangles(std::string_view name) { return name == "cube" ? 12 : 24; }

Mesh make_cube(std::size_t triangles, double jitter, std::uint64_t seed)
{
    const std::uint32_t n = std::uint32_t(std::max(1.0, std::round(std::sqrt(double(triangles) / 12))));
    LatticeSurface lattice(n);
    Mesh mesh;
    mesh.triangles.reserve(12 * std::size_t(n) * n);
    for (int axis = 0; axis < 3; ++axis)
        for (std::uint32_t side = 0; side < 2; ++side)
            for (std::uint32_t j = 0; j < n; ++j)
                for (std::uint32_t i = 0; i < n; ++i) {
                    auto at = [&](std::uint32_t u, std::uint32_t v) {
                        uvec3 p;
                        p[axis] = side * n;
                        p[(axis + 1) % 3] = side == 1 ? u : v; // the low side is seen from behind
                        p[(axis + 2) % 3] = side == 1 ? v : u;
                        return lattice.vertex(p);
                    };
                    const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
                    mesh.triangles.push_back({a, b, c});
                    mesh.triangles.push_back({a, c, d});
                }
    mesh.positions.reserve(lattice.points().size());
    for (std::size_t i = 0; i < lattice.points().size(); ++i) {
        Random random(seed, i);
        dvec3 p;
        for (int axis = 0; axis < 3; ++axis) {
            const std::uint32_t at = lattice.points()[i][axis];
            const double step = random.uniform(-jitter, jitter);
            p[axis] = 2 * (at + (at == 0 || at == n ? 0 : step)) / n - 1;
        }
        mesh.positions.push_back(p);
    }
    return mesh;
}

Mesh make_cylinder(std::size_t triangles, double jitter, std::uint64_t seed)
{
    const CylinderCells cells = cylinder_cells(double(triangles));
    const std::uint32_t m = cells.rings, around = 6 * m, inner = disc_vertex(m, 0);
    Mesh mesh;
    std::uint64_t drawn = 0;
    for (std::uint32_t row = 0; row <= cells.rows; ++row)
        for (std::uint32_t column = 0; column < around; ++column) {
            Random random(seed, drawn++);
            mesh.positions.push_back(side_point(row, column, cells, jitter, random));
        }
    for (std::uint32_t row = 0; row < cells.rows; ++row)
        for (std::uint32_t column = 0; column < around; ++column) {
            const std::uint32_t right = (column + 1) % around;
            const std::uint32_t a = row * around + column, b = row * around + right, c = b + around, d = a + around;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        }
    for (const bool top : {false, true}) {
        const std::uint32_t first = std::uint32_t(mesh.positions.size()), rim = top ? cells.rows * around : 0;
        for (std::uint32_t ring = 0; ring < m; ++ring)
            for (std::uint32_t step = 0; step < std::max(1u, 6 * ring); ++step) {
                Random random(seed, drawn++);
                mesh.positions.push_back(cap_point(ring, step, m, top ? cylinder_half_height : -cylinder_half_height, jitter, random));
            }
        auto vertex = [&](std::uint32_t v) { return v < inner ? first + v : rim + v - inner; };
        for (const uvec3& t : disc_triangles(m))
            mesh.triangles.push_back(top ? uvec3(vertex(t.x), vertex(t.y), vertex(t.z)) : uvec3(vertex(t.x), vertex(t.z), vertex(t.y)));
    }
    return mesh;
}

std::vector<vec3> area_normals(const Mesh& mesh)
{
    std::vector<dvec3> sums(mesh.positions.size(), dvec3(0));
    for (const uvec3& t : mesh.triangles) {
        const dvec3 n = glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
        for (int k = 0; k < 3; ++k)
            sums[t[k]] += n;
    }
    std::vector<vec3> normals;
    normals.reserve(sums.size());
    for (const dvec3& s : sums)
        normals.push_back(vec3(glm::normalize(s)));
    return normals;
}

} // namespace limn
