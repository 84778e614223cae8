#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// A point that an edge of the control mesh is cut at, on the limit surface.
struct CutPoint {
    double t = 0; ///< from the start of the edge's half-edge (0) to its end (1)
    std::uint32_t edge = 0;
    std::array<bool, 2> crossing = {false, false}; ///< the contour runs through it on the side of that half-edge, and of its twin
    dvec3 position;
    std::array<dvec3, 2> normals; ///< on both sides; they differ at sharp edges
};

/// Whether a point comes before another: by edge, then along it.
inline bool comes_before(const CutPoint& a, const CutPoint& b) { return a.edge != b.edge ? a.edge < b.edge : a.t < b.t; }

/// Whether one of an edge's points is at a parameter.
bool has_point(std::span<const CutPoint> points, double t);

/// The points of all edges of a control mesh, in one piece of memory: most edges have none.
class EdgePoints {
public:
    /// @param edges  how many there are
    /// @param points  in the order of comes_before
    EdgePoints(std::size_t edges, std::vector<CutPoint> points);

    /// The number of edges.
    std::size_t size() const { return edges_; }
    bool has_points(std::uint32_t edge) const { return words_[edge / 64].marked >> edge % 64 & 1; }
    /// An edge's points, ascending; until points are added.
    std::span<const CutPoint> operator[](std::uint32_t edge) const;
    /// Those of all edges.
    std::span<const CutPoint> all() const { return points_; }
    /// The number among all() of the first of an edge's points.
    std::size_t number(std::span<const CutPoint> of_edge) const { return std::size_t(of_edge.data() - points_.data()); }
    /// @param points  in the order of comes_before
    void add(const std::vector<CutPoint>& points);

private:
    /// What there is on 64 edges.
    struct Word {
        std::uint64_t marked = 0; ///< a bit for each edge that has points
        std::size_t first = 0;    ///< among the points
    };
    void count();

    std::size_t edges_;
    std::vector<CutPoint> points_;
    std::vector<Word> words_; ///< and one behind the last
};

} // namespace limn
