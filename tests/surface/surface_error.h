#pragma once

#include <cmath>

#include "limn/base/random.h"
#include "limn/geometry/mesh.h"
#include "limn/surface/shapes.h"
#include "limn/surface/surface.h"

namespace limn::test {

/// A generated shape with double positions.
inline Shape make_test_shape(const char* name, std::size_t triangles, double jitter = 0.2, bool float_positions = false)
{
    ShapeOptions options;
    options.name = name;
    options.triangles = triangles;
    options.jitter = jitter;
    options.float_positions = float_positions;
    return make_shape(options);
}

/// Moves every coordinate by a normal deviate.
inline Mesh with_noise(Mesh mesh, double deviation, std::uint64_t seed = 7)
{
    Random random(seed);
    for (dvec3& p : mesh.positions)
        p += deviation * dvec3(random.normal(), random.normal(), random.normal());
    return mesh;
}

inline double mean_edge(const Mesh& mesh)
{
    double sum = 0;
    for (const uvec3& t : mesh.triangles)
        sum += glm::distance(mesh.positions[t.x], mesh.positions[t.y]);
    return sum / double(mesh.triangles.size());
}

/// Error of the derivative at v after (e1,e2) -> (-e1,-e2), which negates all four, is undone.
inline dvec4 derivative_difference(const Surface& got, const Surface& exact, std::size_t v)
{
    const double sign = glm::dot(got.e1[v], exact.e1[v]) < 0 ? -1 : 1;
    return sign * dvec4(got.derivative[v]) - dvec4(exact.derivative[v]);
}

/// Relative rms over the vertices of (P,Q,S,T), for all four together and for each.
struct DerivativeError {
    double all = 0;
    dvec4 each = dvec4(0);
};

template <class Keep> DerivativeError derivative_error_where(const Surface& got, const Surface& exact, Keep&& keep)
{
    dvec4 error(0), size(0);
    for (std::size_t v = 0; v < exact.e1.size(); ++v)
        if (keep(v)) {
            const dvec4 d = derivative_difference(got, exact, v), e(exact.derivative[v]);
            error += d * d;
            size += e * e;
        }
    const auto sum = [](const dvec4& x) { return x.x + x.y + x.z + x.w; };
    return {std::sqrt(sum(error) / sum(size)), glm::sqrt(error / size)};
}

inline DerivativeError derivative_error(const Surface& got, const Surface& exact)
{
    return derivative_error_where(got, exact, [](std::size_t) { return true; });
}

/// Relative rms error of k1.
inline double k1_error(const Surface& got, const Surface& exact)
{
    double error = 0, size = 0;
    for (std::size_t v = 0; v < exact.k1.size(); ++v) {
        error += std::pow(double(got.k1[v]) - exact.k1[v], 2);
        size += std::pow(double(exact.k1[v]), 2);
    }
    return std::sqrt(error / size);
}

/// rms angle between the normals, radians.
inline double normal_error(const Surface& got, const Surface& exact)
{
    double sum = 0;
    for (std::size_t v = 0; v < exact.normals.size(); ++v) {
        const dvec3 cross = glm::cross(dvec3(got.normals[v]), dvec3(exact.normals[v]));
        sum += glm::dot(cross, cross);
    }
    return std::sqrt(sum / double(exact.normals.size()));
}

} // namespace limn::test
