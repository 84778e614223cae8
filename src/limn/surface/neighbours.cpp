#include "limn/surface/neighbours.h"

#include <algorithm>

#include "limn/base/parallel.h"
#include "limn/surface/tangent.h"

namespace limn {
namespace {

constexpr std::size_t grain = 4096;
constexpr int most_rings = 8;
/// After this many edges no further ring is looked at: bounds the work beside vertices of huge valence.
constexpr std::size_t most_visits = 2048;

/// Removes repeated entries behind `first`. Short lists keep their order; long ones (fans) are sorted instead.
void remove_repeats(std::vector<std::uint32_t>& list, std::size_t first)
{
    const auto begin = list.begin() + std::ptrdiff_t(first);
    if (list.size() - first > 64) {
        std::sort(begin, list.end());
        list.erase(std::unique(begin, list.end()), list.end());
        return;
    }
    auto end = begin;
    for (auto i = begin; i != list.end(); ++i)
        if (std::find(begin, end, *i) == end)
            *end++ = *i;
    list.erase(end, list.end());
}

} // namespace

Neighbours build_neighbours(std::span<const uvec3> triangles, const VertexFaces& faces)
{
    const std::size_t vertices = faces.start.size() - 1;
    Neighbours result;
    result.start.assign(vertices + 1, 0);
    result.vertex = parallel_collect<std::uint32_t>(vertices, grain, [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& out) {
        out.reserve(faces.start[end] - faces.start[begin] + 64);
        for (std::size_t v = begin; v < end; ++v) {
            const std::size_t first = out.size();
            for (std::uint32_t i = faces.start[v]; i < faces.start[v + 1]; ++i)
                for (int k = 0; k < 3; ++k)
                    if (const std::uint32_t other = triangles[faces.face[i]][k]; other != v)
                        out.push_back(other);
            remove_repeats(out, first);
            result.start[v + 1] = std::uint32_t(out.size() - first);
        }
    });
    for (std::size_t v = 0; v < vertices; ++v)
        result.start[v + 1] += result.start[v];
    return result;
}

std::vector<dvec3> area_normals(std::span<const dvec3> positions, std::span<const uvec3> triangles, const VertexFaces& faces)
{
    std::vector<dvec3> normals(positions.size());
    parallel_each(positions.size(), grain, [&](std::size_t v) {
        dvec3 sum(0);
        for (std::uint32_t i = faces.start[v]; i < faces.start[v + 1]; ++i) {
            const uvec3& t = triangles[faces.face[i]];
            sum += glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]);
        }
        normals[v] = unit_or_zero(sum);
    });
    return normals;
}

RingCollector::RingCollector(std::span<const dvec3> positions, std::span<const dvec3> normals, const Neighbours& neighbours)
    : positions_(positions), normals_(normals), neighbours_(neighbours), stamps_(positions.size(), 0)
{
}

void RingCollector::collect(std::uint32_t centre, const RingSize& size, std::vector<std::uint32_t>& out)
{
    if (++stamp_ == 0) {
        std::fill(stamps_.begin(), stamps_.end(), 0u);
        stamp_ = 1;
    }
    axis_ = normals_[centre];
    least_cosine_ = size.least_cosine;
    stamps_[centre] = stamp_;
    const std::size_t first = out.size();
    for (const std::uint32_t u : neighbours_.of(centre))
        visit(u, out);
    visits_ = 0;
    std::size_t begin = first;
    for (int ring = 2; ring <= most_rings && (ring <= size.rings || out.size() - first < size.least); ++ring) {
        const std::size_t end = out.size();
        for (std::size_t i = begin; i < end; ++i)
            for (const std::uint32_t u : neighbours_.of(out[i]))
                if (visits_ < most_visits)
                    visit(u, out);
                else
                    break;
        begin = end;
    }
    if (out.size() - first > most)
        keep_nearest(centre, first, out);
}

void RingCollector::visit(std::uint32_t vertex, std::vector<std::uint32_t>& out)
{
    ++visits_;
    if (stamps_[vertex] == stamp_)
        return;
    stamps_[vertex] = stamp_;
    if (glm::dot(normals_[vertex], axis_) >= least_cosine_)
        out.push_back(vertex);
}

void RingCollector::keep_nearest(std::uint32_t centre, std::size_t first, std::vector<std::uint32_t>& out) const
{
    const auto distance = [&](std::uint32_t u) {
        const dvec3 d = positions_[u] - positions_[centre];
        return glm::dot(d, d);
    };
    const auto nearer = [&](std::uint32_t a, std::uint32_t b) {
        const double x = distance(a), y = distance(b);
        return x != y ? x < y : a < b;
    };
    std::nth_element(out.begin() + std::ptrdiff_t(first), out.begin() + std::ptrdiff_t(first + most), out.end(), nearer);
    out.resize(first + most);
}

} // namespace limn
