#pragma once

#include <span>
#include <vector>

#include "limn/geometry/adjacency.h"

namespace limn {

/// The distinct vertices that share an edge with each vertex, in CSR form: those of v are
/// vertex[start[v]] … vertex[start[v+1]-1]. Needs no manifoldness.
struct Neighbours {
    std::vector<std::uint32_t> start; ///< vertex_count + 1
    std::vector<std::uint32_t> vertex;
    std::span<const std::uint32_t> of(std::uint32_t v) const { return {vertex.data() + start[v], start[v + 1] - start[v]}; }
};
Neighbours build_neighbours(std::span<const uvec3> triangles, const VertexFaces& faces);

/// Unit vertex normals, weighted by the areas of the faces around; zero where no face has area.
std::vector<dvec3> area_normals(std::span<const dvec3> positions, std::span<const uvec3> triangles, const VertexFaces& faces);

/// How far a neighbourhood reaches.
struct RingSize {
    int rings = 2;
    std::size_t least = 18;      ///< rings are added (to at most 8) while there are fewer points
    double least_cosine = 0.5;   ///< vertices whose normal is turned further from the centre's are left out, with what lies
                                 ///< behind them: a height over the tangent plane says nothing about the other side of an ear
};

/// Collects rings of neighbours breadth first. Keeps one stamp per vertex, so make one collector for each thread and use
/// it for many vertices.
class RingCollector {
public:
    static constexpr std::size_t most = 128; ///< of more points the nearest are kept

    /// @param normals  unit; one for each position
    RingCollector(std::span<const dvec3> positions, std::span<const dvec3> normals, const Neighbours& neighbours);
    /// Appends the neighbourhood of `centre` (without itself) to `out`.
    void collect(std::uint32_t centre, const RingSize& size, std::vector<std::uint32_t>& out);

private:
    void visit(std::uint32_t vertex, std::vector<std::uint32_t>& out);
    void keep_nearest(std::uint32_t centre, std::size_t first, std::vector<std::uint32_t>& out) const;

    std::span<const dvec3> positions_, normals_;
    const Neighbours& neighbours_;
    std::vector<std::uint32_t> stamps_;
    std::uint32_t stamp_ = 0;
    std::size_t visits_ = 0;
    dvec3 axis_ = dvec3(0);
    double least_cosine_ = 0;
};

} // namespace limn
