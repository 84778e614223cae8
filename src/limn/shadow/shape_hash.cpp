#include "limn/shadow/shape_hash.h"

#include <bit>

namespace limn {
namespace {

/// The finaliser of SplitMix64: one to one.
std::uint64_t mix(std::uint64_t z)
{
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

std::uint64_t hash_of(const dvec3& p)
{
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis)
        hash = mix(hash + 0x9E3779B97F4A7C15u + std::bit_cast<std::uint32_t>(float(p[axis]) + 0.0f)); // -0 is 0
    return hash;
}

} // namespace

std::uint64_t shape_hash(const Mesh& mesh)
{
    std::uint64_t sum = mix(mesh.triangles.size());
    for (const uvec3& t : mesh.triangles)
        sum += mix(hash_of(mesh.positions[t.x]) + hash_of(mesh.positions[t.y]) + hash_of(mesh.positions[t.z]));
    return sum;
}

} // namespace limn
