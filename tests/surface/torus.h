#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "limn/geometry/mesh.h"
#include "limn/surface/surface.h"

namespace limn::test {

/// A torus R = 1, r = 0.4 around z on a grid of `rings` by `rings * 2/5` (rounded) cells, each vertex moved by up to
/// `jitter` cells, with its exact fields (contour-lines specification, section 7).
struct Torus {
    Mesh mesh;
    Surface exact;
};

struct TorusOptions {
    std::uint32_t rings = 394;     ///< 394: 124 k triangles
    double jitter = 0.2;
    double noise = 0;              ///< standard deviation of a displacement in every coordinate
    bool float_positions = false;
    std::uint32_t seed = 1;
};

inline Torus make_torus(const TorusOptions& options)
{
    const std::uint32_t m = options.rings, n = std::uint32_t(std::lround(m * 0.4));
    const double R = 1, r = 0.4, tau = 2 * std::numbers::pi;
    std::mt19937_64 random(options.seed);
    std::uniform_real_distribution<double> shift(-options.jitter, options.jitter);
    std::normal_distribution<double> noise(0, options.noise > 0 ? options.noise : 1);
    Torus torus;
    for (std::uint32_t i = 0; i < m; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            const double v = tau * (i + shift(random)) / m, u = tau * (j + shift(random)) / n, q = R + r * std::cos(u);
            dvec3 p(q * std::cos(v), q * std::sin(v), r * std::sin(u));
            if (options.noise > 0)
                p += dvec3(noise(random), noise(random), noise(random));
            torus.mesh.positions.push_back(options.float_positions ? dvec3(vec3(p)) : p);
            torus.exact.normals.push_back(vec3(dvec3(std::cos(u) * std::cos(v), std::cos(u) * std::sin(v), std::sin(u))));
            torus.exact.e1.push_back(vec3(dvec3(-std::sin(u) * std::cos(v), -std::sin(u) * std::sin(v), std::cos(u))));
            torus.exact.e2.push_back(glm::cross(torus.exact.normals.back(), torus.exact.e1.back()));
            torus.exact.k1.push_back(float(1 / r));
            torus.exact.k2.push_back(float(std::cos(u) / q));
            torus.exact.derivative.push_back(vec4(0, 0, float(-R * std::sin(u) / (r * q * q)), 0));
            const std::uint32_t a = i * n + j, b = ((i + 1) % m) * n + j;
            const std::uint32_t c = ((i + 1) % m) * n + (j + 1) % n, d = i * n + (j + 1) % n;
            torus.mesh.triangles.push_back({a, b, c});
            torus.mesh.triangles.push_back({a, c, d});
        }
    return torus;
}

} // namespace limn::test
