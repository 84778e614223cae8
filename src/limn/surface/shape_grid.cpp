#include "limn/surface/shape_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "limn/base/parallel.h"
#include "limn/base/random.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1 << 12;

struct Icosahedron {
    std::array<dvec3, 12> corners;
    std::array<uvec3, 20> faces;
    std::array<std::array<std::uint32_t, 2>, 30> edges; ///< lower corner first

    std::uint32_t edge(std::uint32_t a, std::uint32_t b) const
    {
        const std::array<std::uint32_t, 2> key = {std::min(a, b), std::max(a, b)};
        return std::uint32_t(std::find(edges.begin(), edges.end(), key) - edges.begin());
    }
};

Icosahedron icosahedron()
{
    const double g = std::numbers::phi;
    Icosahedron ico;
    ico.corners = {{{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g}, {0, 1, g},
                    {0, -1, -g}, {0, 1, -g}, {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}}};
    ico.faces = {{{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                  {3, 9, 4}, {3, 4, 2}, {3, 2, 6}, {3, 6, 8}, {3, 8, 9}, {4, 9, 5}, {2, 4, 11}, {6, 2, 10}, {8, 6, 7}, {9, 8, 1}}};
    for (dvec3& c : ico.corners)
        c = glm::normalize(c);
    std::size_t count = 0;
    for (const uvec3& f : ico.faces)
        for (int k = 0; k < 3; ++k)
            if (f[k] < f[(k + 1) % 3])
                ico.edges[count++] = {f[k], f[(k + 1) % 3]};
    return ico;
}

/// Numbers the vertices of a geodesic sphere: 12 corners, then the edges, then the insides of the faces.
class GeodesicIndex {
public:
    GeodesicIndex(const Icosahedron& ico, std::uint32_t frequency) : ico_(ico), n_(frequency) {}

    std::size_t count() const { return 10 * std::size_t(n_) * n_ + 2; }
    /// The vertex of a face with integer weights i, j and n-i-j of its corners 1, 2 and 0.
    std::uint32_t vertex(std::uint32_t face, std::uint32_t i, std::uint32_t j) const
    {
        const uvec3& f = ico_.faces[face];
        if (j == 0)
            return on_edge(f[0], f[1], i);
        if (i == 0)
            return on_edge(f[0], f[2], j);
        if (i + j == n_)
            return on_edge(f[1], f[2], j);
        // Rows of constant j have n-1-j inner vertices.
        const std::uint32_t before = (j - 1) * (n_ - 1) - j * (j - 1) / 2;
        return 12 + 30 * (n_ - 1) + face * ((n_ - 1) * (n_ - 2) / 2) + before + i - 1;
    }

private:
    std::uint32_t on_edge(std::uint32_t from, std::uint32_t to, std::uint32_t step) const
    {
        if (step == 0)
            return from;
        if (step == n_)
            return to;
        return 12 + ico_.edge(from, to) * (n_ - 1) + (from < to ? step : n_ - step) - 1;
    }
    const Icosahedron& ico_;
    std::uint32_t n_;
};

/// The direction with weights a, b, c (sum 1) of the corners of an icosahedron's face; on its edges equal steps of arc.
dvec3 geodesic_direction(const Icosahedron& ico, const uvec3& face, double a, double b, double c)
{
    const double arc = std::acos(1 / std::sqrt(5.0));
    return glm::normalize(std::sin(a * arc) * ico.corners[face.x] + std::sin(b * arc) * ico.corners[face.y]
                          + std::sin(c * arc) * ico.corners[face.z]);
}

/// Moves a direction by a tangent vector that is uniform in a square of the given half-width.
dvec3 jittered_direction(const dvec3& d, double half_width, Random& random)
{
    const dvec3 side = glm::normalize(glm::cross(d, std::abs(d.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    const double x = random.uniform(-half_width, half_width), y = random.uniform(-half_width, half_width);
    return glm::normalize(d + x * side + y * glm::cross(d, side));
}

void jitter_sphere(ParameterMesh& mesh, double jitter, std::uint64_t seed)
{
    // Edge of an equilateral triangle with the mean area.
    const double spacing = std::sqrt(16 * std::numbers::pi / (std::sqrt(3.0) * double(mesh.triangles.size())));
    parallel_each(mesh.parameters.size(), grain, [&](std::size_t i) {
        Random random(seed, i);
        mesh.parameters[i] = jittered_direction(mesh.parameters[i], jitter * spacing, random);
    });
}

void jitter_grid(ParameterMesh& mesh, const ShapePart& part, dvec2 cell, double jitter, std::uint64_t seed)
{
    const bool open = part.topology == ShapePart::Topology::sheet;
    parallel_each(mesh.parameters.size(), grain, [&](std::size_t i) {
        Random random(seed, i);
        dvec3& q = mesh.parameters[i];
        for (int axis = 0; axis < 2; ++axis) {
            const double step = random.uniform(-jitter, jitter) * cell[axis];
            if (!open || (q[axis] > part.low[axis] && q[axis] < part.high[axis]))
                q[axis] += step;
        }
    });
}

} // namespace

ParameterMesh geodesic_sphere(std::uint32_t frequency)
{
    const Icosahedron ico = icosahedron();
    const GeodesicIndex index(ico, frequency);
    const std::uint32_t n = frequency;
    ParameterMesh mesh;
    mesh.parameters.resize(index.count());
    mesh.triangles.resize(20 * std::size_t(n) * n);
    for (std::uint32_t face = 0; face < 20; ++face) {
        uvec3* out = mesh.triangles.data() + face * std::size_t(n) * n;
        for (std::uint32_t j = 0; j <= n; ++j)
            for (std::uint32_t i = 0; i + j <= n; ++i) {
                mesh.parameters[index.vertex(face, i, j)] =
                    geodesic_direction(ico, ico.faces[face], double(n - i - j) / n, double(i) / n, double(j) / n);
                if (i + j < n)
                    *out++ = {index.vertex(face, i, j), index.vertex(face, i + 1, j), index.vertex(face, i, j + 1)};
                if (i + j + 1 < n)
                    *out++ = {index.vertex(face, i + 1, j), index.vertex(face, i + 1, j + 1), index.vertex(face, i, j + 1)};
            }
    }
    return mesh;
}

ParameterMesh parameter_grid(std::uint32_t columns, std::uint32_t rows, dvec2 low, dvec2 high, bool periodic)
{
    const std::uint32_t width = columns + (periodic ? 0 : 1), height = rows + (periodic ? 0 : 1);
    ParameterMesh mesh;
    mesh.parameters.resize(std::size_t(width) * height);
    mesh.triangles.resize(2 * std::size_t(columns) * rows);
    for (std::uint32_t j = 0; j < height; ++j)
        for (std::uint32_t i = 0; i < width; ++i) {
            // The last line of an open grid is `high` itself, not a rounded sum.
            const double u = i == columns ? high.x : low.x + (high.x - low.x) * i / columns;
            const double v = j == rows ? high.y : low.y + (high.y - low.y) * j / rows;
            mesh.parameters[std::size_t(j) * width + i] = {u, v, 0};
        }
    uvec3* out = mesh.triangles.data();
    for (std::uint32_t j = 0; j < rows; ++j)
        for (std::uint32_t i = 0; i < columns; ++i) {
            const std::uint32_t right = (i + 1) % width, up = (j + 1) % height;
            const std::uint32_t a = j * width + i, b = j * width + right, c = up * width + right, d = up * width + i;
            *out++ = {a, b, c};
            *out++ = {a, c, d};
        }
    return mesh;
}

ParameterMesh part_domain(const ShapePart& part, std::size_t triangles, double jitter, std::uint64_t seed)
{
    ParameterMesh mesh;
    if (part.topology == ShapePart::Topology::sphere) {
        mesh = geodesic_sphere(std::uint32_t(std::max(1.0, std::round(std::sqrt(double(triangles) / 20)))));
        if (jitter > 0)
            jitter_sphere(mesh, jitter, seed);
        return mesh;
    }
    const bool periodic = part.topology == ShapePart::Topology::torus;
    const double cells = double(triangles) / 2, fewest = periodic ? 3 : 1;
    const double rows = std::max(fewest, std::round(std::sqrt(cells / part.aspect)));
    const double columns = std::max(fewest, std::round(cells / rows));
    mesh = parameter_grid(std::uint32_t(columns), std::uint32_t(rows), part.low, part.high, periodic);
    if (jitter > 0)
        jitter_grid(mesh, part, (part.high - part.low) / dvec2(columns, rows), jitter, seed);
    return mesh;
}

} // namespace limn
