#pragma once

#include <span>
#include <vector>

#include "limn/subdivision/seed_search.h"

namespace limn {

/// The infinitely sharp edges that may be outlines in a view, and their points: all borders, and the creases unless both of their sides face
/// the eye at both ends or none does. They are followed on the limit surface, each by the same points for the faces on both sides.
class SharpOutlines {
public:
    /// A point of such an edge.
    struct Mark {
        double t = 0;             ///< along the edge's limit curve, from its start
        std::uint32_t vertex = 0;
        std::uint32_t row = none; ///< of `point`; `none` for a crossing
        bool operator<(const Mark& other) const { return t != other.t ? t < other.t : vertex < other.vertex; }
    };

    /// @param surface, found  must live as long as this does
    /// @param pieces  of an edge, at most 2^(levels + 1) of them
    /// @param first_vertex  the number that the first point between two ends gets
    SharpOutlines(const SeedSurface& surface, const SeedCrossings& found, int pieces, std::uint32_t first_vertex);

    std::uint32_t vertex_count() const { return end_ - begin_; }
    bool is_outline(std::uint32_t edge) const { return !first_.empty() && s_.sharp_number[edge] != none && first_[s_.sharp_number[edge]] != none; }
    /// How many points an outline has between its ends, the crossings of both sides among them.
    std::uint32_t count(std::uint32_t edge) const;
    /// These points, from the start of the edge to its end. @param first_crossing  the vertex of the first crossing
    void gather(std::uint32_t edge, std::uint32_t first_crossing, std::vector<Mark>& marks) const;
    /// @param row    Mark::row
    /// @param right  as the face at the right of the edge's half-edge sees it
    EdgePoint point(std::uint32_t edge, std::uint32_t row, bool right, std::span<const dvec3> fine) const;
    /// Sets those of the vertices from first_vertex on. @param fine  SeedPose::fine
    void set_positions(std::span<const dvec3> fine, std::vector<dvec3>& positions) const;

private:
    std::uint32_t row(std::uint32_t i) const { return std::uint32_t((std::uint64_t(i) * rows_ + pieces_ / 2) / pieces_); }
    bool may_be_outline(std::uint32_t edge) const;
    /// Calls f(side) for each side.
    template <class F> void each_side(std::uint32_t edge, F&& f) const
    {
        f(edge);
        const std::uint32_t over = s_.topology.twin[s_.topology.half_edge[edge]];
        if (over != none && s_.side[over] != edge)
            f(s_.side[over]);
    }

    const SeedSurface& s_;
    const SeedCrossings& found_;
    std::uint32_t rows_, pieces_; ///< of a whole edge
    std::uint32_t begin_, end_;   ///< vertices
    std::vector<std::uint32_t> first_; ///< per sharp edge: its first vertex, or `none` where it is no outline
};

} // namespace limn
