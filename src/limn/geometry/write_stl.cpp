#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "limn/base/parallel.h"
#include "limn/geometry/byte_writer.h"
#include "limn/geometry/writers.h"

namespace limn {
namespace {

char* put_vector(char* at, const vec3& v) { return put(put(put(at, v.x), v.y), v.z); }

vec3 face_normal(const Mesh& mesh, const uvec3& t)
{
    const dvec3 n = glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
    const double length = glm::length(n);
    return length > 0 && std::isfinite(length) ? vec3(n / length) : vec3(0);
}

} // namespace

std::string stl_bytes(const Mesh& mesh)
{
    constexpr std::size_t header = 84, record = 50;
    // The header must not begin with "solid", which would make it look like text.
    constexpr std::string_view title = "binary STL written by Limn";
    std::string bytes(header + record * mesh.triangles.size(), '\0');
    std::copy(title.begin(), title.end(), bytes.begin());
    put(bytes.data() + 80, std::uint32_t(mesh.triangles.size()));
    parallel_each(mesh.triangles.size(), 1 << 14, [&](std::size_t i) {
        const uvec3& t = mesh.triangles[i];
        char* at = put_vector(bytes.data() + header + record * i, face_normal(mesh, t));
        for (int k = 0; k < 3; ++k)
            at = put_vector(at, vec3(mesh.positions[t[k]]));
    });
    return bytes;
}

} // namespace limn
