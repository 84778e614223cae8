#include "limn/geometry/orient.h"

#include <algorithm>
#include <utility>

#include "limn/base/parallel.h"
#include "limn/geometry/adjacency.h"
#include "limn/geometry/unpaired_edges.h"

namespace limn {
namespace {

/// The finaliser of SplitMix64.
std::uint64_t scrambled(std::uint64_t z)
{
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/// True where every edge is walked as often in one direction as in the other: each half-edge adds a number that stands for its
/// edge, or takes it away where it runs downwards. (Chance fails it once in 2^64 meshes.)
bool is_balanced(const Mesh& mesh)
{
    std::vector<std::uint64_t> sums = parallel_collect<std::uint64_t>(mesh.triangles.size(), 1 << 15, [&](std::size_t begin, std::size_t end, auto& out) {
        std::uint64_t sum = 0;
        for (std::size_t f = begin; f < end; ++f)
            for (int k = 0; k < 3; ++k) {
                const std::uint64_t a = mesh.triangles[f][k], b = mesh.triangles[f][(k + 1) % 3];
                sum += a < b ? scrambled(a << 32 | b) : -scrambled(b << 32 | a);
            }
        out.push_back(sum);
    });
    std::uint64_t total = 0;
    for (const std::uint64_t sum : sums)
        total += sum;
    return total == 0;
}

/// Faces beside each other: those of twins agree, those of `same_way` (per half-edge, or `none`) do not.
struct Neighbours {
    Adjacency adjacency;
    std::vector<std::uint32_t> same_way;
    bool disagree = false; ///< some do
};

Neighbours find_neighbours(const Mesh& mesh)
{
    Neighbours n;
    n.adjacency = build_adjacency(mesh.triangles, mesh.positions.size());
    n.same_way.assign(n.adjacency.twin.size(), none);
    const auto corner = [&](std::uint32_t h) { return mesh.triangles[h / 3][int(h % 3)]; };
    for_each_unpaired(find_unpaired_edges(n.adjacency, 0, n.adjacency.twin.size(), corner), [&](const UnpairedEdge* e, std::size_t count) {
        if (count != 2)
            return;
        n.same_way[e[0].half_edge] = e[1].half_edge;
        n.same_way[e[1].half_edge] = e[0].half_edge;
        n.disagree = true;
    });
    return n;
}

/// Six times the volume that some faces enclose.
double volume_of(const Mesh& mesh, const std::vector<std::uint32_t>& faces, const std::vector<std::uint8_t>& turned)
{
    const dvec3 origin = mesh.positions[mesh.triangles[faces.front()].x];
    double sum = 0;
    for (const std::uint32_t f : faces) {
        const uvec3& t = mesh.triangles[f];
        const double part = glm::dot(mesh.positions[t.x] - origin, glm::cross(mesh.positions[t.y] - origin, mesh.positions[t.z] - origin));
        sum += turned[f] ? -part : part;
    }
    return sum;
}

/// Decides shell by shell which faces turn.
class Orientation {
public:
    Orientation(const Mesh& mesh, const Neighbours& neighbours)
        : mesh_(mesh), neighbours_(neighbours), turned_(mesh.triangles.size(), 0), seen_(mesh.triangles.size(), 0)
    {
        for (std::uint32_t f = 0; f < seen_.size(); ++f)
            if (!seen_[f]) {
                walk_shell(f);
                decide();
            }
    }
    const std::vector<std::uint8_t>& turned() const { return turned_; }

private:
    /// Collects the shell of a face and turns what disagrees with that face.
    void walk_shell(std::uint32_t first)
    {
        shell_.assign(1, first);
        seen_[first] = 1;
        closed_ = agreeable_ = true;
        for (std::size_t i = 0; i < shell_.size(); ++i)
            for (std::uint32_t h = 3 * shell_[i]; h < 3 * shell_[i] + 3; ++h) {
                const bool same_way = neighbours_.same_way[h] != none;
                const std::uint32_t other = same_way ? neighbours_.same_way[h] : neighbours_.adjacency.twin[h];
                if (other == none)
                    closed_ = false;
                else
                    visit(other / 3, turned_[shell_[i]] ^ std::uint8_t(same_way));
            }
    }

    void visit(std::uint32_t face, std::uint8_t turned)
    {
        if (!seen_[face]) {
            seen_[face] = 1;
            turned_[face] = turned;
            shell_.push_back(face);
        }
        agreeable_ = agreeable_ && turned_[face] == turned;
    }

    void decide()
    {
        const auto turned = std::size_t(std::count_if(shell_.begin(), shell_.end(), [&](std::uint32_t f) { return turned_[f]; }));
        if (!agreeable_) {
            for (const std::uint32_t f : shell_)
                turned_[f] = 0;
            return;
        }
        if (turned == 0)
            return;
        if (2 * turned > shell_.size())
            turn_the_others();
        if (closed_ && volume_of(mesh_, shell_, turned_) < 0)
            turn_the_others();
    }

    void turn_the_others()
    {
        for (const std::uint32_t f : shell_)
            turned_[f] ^= 1;
    }

    const Mesh& mesh_;
    const Neighbours& neighbours_;
    std::vector<std::uint8_t> turned_, seen_;
    // The shell at hand.
    std::vector<std::uint32_t> shell_;
    bool closed_ = true, agreeable_ = true;
};

void turn_face(Mesh& mesh, std::size_t face)
{
    std::swap(mesh.triangles[face].y, mesh.triangles[face].z);
    if (!mesh.corner_normals.empty())
        std::swap(mesh.corner_normals[3 * face + 1], mesh.corner_normals[3 * face + 2]);
    if (!mesh.corner_uvs.empty())
        std::swap(mesh.corner_uvs[3 * face + 1], mesh.corner_uvs[3 * face + 2]);
}

} // namespace

std::size_t orient_faces(Mesh& mesh)
{
    if (is_balanced(mesh))
        return 0;
    const Neighbours neighbours = find_neighbours(mesh);
    if (!neighbours.disagree)
        return 0;
    const Orientation orientation(mesh, neighbours);
    std::size_t count = 0;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
        if (orientation.turned()[f]) {
            turn_face(mesh, f);
            ++count;
        }
    return count;
}

} // namespace limn
