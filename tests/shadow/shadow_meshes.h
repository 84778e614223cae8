#pragma once

#include <cmath>
#include <numbers>

#include "limn/geometry/mesh.h"
#include "limn/shadow/shadow_caster.h"

namespace limn::test {

/// Vertices of a grid that is closed along v, and along u or with poles at both ends of it.
template <class F> Mesh grid_mesh(int u_cells, int v_cells, bool closed_in_u, F&& at)
{
    Mesh mesh;
    const int u_count = closed_in_u ? u_cells : u_cells + 1;
    for (int i = 0; i < u_count; ++i)
        for (int k = 0; k < v_cells; ++k)
            mesh.positions.push_back(at(double(i) / u_cells, double(k) / v_cells));
    const auto index = [&](int i, int k) { return std::uint32_t((i % u_count) * v_cells + k % v_cells); };
    for (int i = 0; i < u_cells; ++i)
        for (int k = 0; k < v_cells; ++k) {
            const std::uint32_t a = index(i, k), b = index(i + 1, k), c = index(i + 1, k + 1), d = index(i, k + 1);
            if (closed_in_u || i > 0)
                mesh.triangles.push_back({a, b, d});
            if (closed_in_u || i + 1 < u_cells)
                mesh.triangles.push_back({b, c, d});
        }
    return mesh;
}

/// The shapes of the specification's regression anchors, section 8.3.
inline Mesh anchor_blob()
{
    return grid_mesh(100, 200, false, [](double u, double v) {
        const double theta = u * std::numbers::pi, phi = 2 * std::numbers::pi * v;
        const dvec3 d(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
        const double radius = 1 + 0.25 * std::sin(5 * d.x + 1) * std::sin(4 * d.y) + 0.12 * std::sin(11 * d.x) * std::sin(9 * d.z + 2) * std::cos(10 * d.y) +
                              0.05 * std::sin(23 * d.z) * std::sin(21 * d.y);
        return radius * d;
    });
}

inline Mesh anchor_knot()
{
    const auto path = [](double t) {
        const double q = 2 + std::cos(3 * t);
        return dvec3(q * std::cos(2 * t), q * std::sin(2 * t), std::sin(3 * t));
    };
    return grid_mesh(400, 20, true, [&](double u, double v) {
        const double t = 2 * std::numbers::pi * u, turn = 2 * std::numbers::pi * v, step = 1e-5;
        const dvec3 along = glm::normalize(path(t + step) - path(t - step)), side = glm::normalize(glm::cross(along, dvec3(0, 0, 1))), up = glm::cross(side, along);
        return path(t) + (0.35 + 0.08 * std::sin(40 * t)) * (std::cos(turn) * side + std::sin(turn) * up);
    });
}

/// As the anchors have it: about the middle of the box, the furthest vertex at 0.999.
inline ShadowCaster anchor_caster(const Mesh& mesh)
{
    ShadowCaster caster = make_shadow_caster(mesh);
    const dvec3 centre = mesh.bounds().centre();
    double radius = 0;
    for (const dvec3& p : mesh.positions)
        radius = std::max(radius, glm::distance(p, centre));
    caster.sphere = {centre, radius / 0.999};
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const dvec3 p = caster.to_unit(mesh.positions[i]);
        caster.x[i] = float(p.x), caster.y[i] = float(p.y), caster.z[i] = float(p.z);
    }
    return caster;
}

} // namespace limn::test
