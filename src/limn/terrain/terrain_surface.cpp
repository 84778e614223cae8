#include "limn/terrain/terrain_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "limn/base/parallel.h"
#include "limn/surface/surface_point.h"
#include "limn/terrain/fill_no_data.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1024;
constexpr int reach = 2; ///< of a third difference

/// Heights around a sample, the border's mirror images beyond it; [east + reach][north + reach].
using Window = std::array<std::array<double, 2 * reach + 1>, 2 * reach + 1>;

/// The height at a place on or beyond the map, by columns and rows.
double height_beyond(const HeightMap& map, int column, int row)
{
    const int inner_column = std::clamp(column, 0, map.columns - 1), inner_row = std::clamp(row, 0, map.rows - 1);
    const double border = double(map.height(inner_column, inner_row));
    if (column == inner_column && row == inner_row)
        return border;
    const int other_column = std::clamp(2 * inner_column - column, 0, map.columns - 1), other_row = std::clamp(2 * inner_row - row, 0, map.rows - 1);
    return 2 * border - double(map.height(other_column, other_row));
}

Window window_at(const HeightMap& map, const ivec2& sample)
{
    Window w;
    for (int x = -reach; x <= reach; ++x)
        for (int y = -reach; y <= reach; ++y)
            w[std::size_t(x + reach)][std::size_t(y + reach)] = height_beyond(map, sample.x + x, sample.y - y);
    return w;
}

/// The heights around a sample as a polynomial of metres to the east and north.
Taylor height_taylor(const HeightMap& map, const ivec2& sample)
{
    const Window w = window_at(map, sample);
    const auto h = [&](int x, int y) { return w[std::size_t(x + reach)][std::size_t(y + reach)]; };
    const auto bend_x = [&](int y) { return h(1, y) - 2 * h(0, y) + h(-1, y); };
    const auto bend_y = [&](int x) { return h(x, 1) - 2 * h(x, 0) + h(x, -1); };
    const double x = map.spacing.x, y = map.spacing.y;
    Taylor t(h(0, 0));
    t.c[1] = (h(1, 0) - h(-1, 0)) / (2 * x);
    t.c[2] = (h(0, 1) - h(0, -1)) / (2 * y);
    t.c[3] = bend_x(0) / (2 * x * x);
    t.c[4] = (h(1, 1) - h(-1, 1) - h(1, -1) + h(-1, -1)) / (4 * x * y);
    t.c[5] = bend_y(0) / (2 * y * y);
    t.c[6] = (h(2, 0) - 2 * h(1, 0) + 2 * h(-1, 0) - h(-2, 0)) / (12 * x * x * x);
    t.c[7] = (bend_x(1) - bend_x(-1)) / (4 * x * x * y);
    t.c[8] = (bend_y(1) - bend_y(-1)) / (4 * x * y * y);
    t.c[9] = (h(0, 2) - 2 * h(0, 1) + 2 * h(0, -1) - h(0, -2)) / (12 * y * y * y);
    return t;
}

ivec2 sample_under(const HeightMap& map, const dvec3& p)
{
    const ivec2 sample(int(std::lround(p.x / map.spacing.x)), map.rows - 1 - int(std::lround(p.y / map.spacing.y)));
    return glm::clamp(sample, ivec2(0), ivec2(map.columns - 1, map.rows - 1));
}

} // namespace

Surface terrain_surface(const HeightMap& map, const Mesh& mesh, Need need)
{
    HeightMap filled = map;
    fill_no_data(filled);
    const std::size_t n = mesh.positions.size();
    Surface surface;
    surface.normals.resize(n);
    if (need >= Need::curvature)
        surface.e1.resize(n), surface.e2.resize(n), surface.k1.resize(n), surface.k2.resize(n);
    if (need >= Need::derivative)
        surface.derivative.resize(n);
    parallel_each(n, grain, [&](std::size_t i) {
        const Taylor height = height_taylor(filled, sample_under(filled, mesh.positions[i]));
        const SurfacePoint point = surface_point({Taylor::u(0), Taylor::v(0), height});
        surface.normals[i] = vec3(point.normal);
        if (need >= Need::curvature) {
            surface.e1[i] = vec3(point.e1), surface.e2[i] = vec3(point.e2);
            surface.k1[i] = float(point.k1), surface.k2[i] = float(point.k2);
        }
        if (need >= Need::derivative)
            surface.derivative[i] = vec4(point.derivative);
    });
    return surface;
}

} // namespace limn
