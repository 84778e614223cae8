#pragma once

#include <vector>

#include "limn/subdivision/side_net.h"

namespace limn {

/// A place where the contour crosses an edge.
struct EdgeCrossing {
    double t; ///< from the start (0) to the end (1) of the half-edge that was searched; inside
    SurfaceSample sample;
};

/// Finds where the contour crosses edges of the control mesh, each on the side of one of its half-edges. All crossings are found, also even
/// numbers of them (silhouette-loop specification, 7, exact search), but for pairs nearer to each other than 2^-20 of the edge, and pairs within
/// 2^-6 of an extraordinary end where the vertex is turned to the eye as what lies beyond them is. Their number always agrees with the signs at
/// the ends. One edge after another: memory is used again.
class CrossingSearch {
public:
    /// @param shape, eye  must live as long as this does
    CrossingSearch(const LimitShape& shape, const Eye& eye) : shape_(shape), eye_(eye) {}

    /// @param faces_eye  whether the surface faces the eye at the half-edge's start and at its end
    /// @return ascending; until the next search
    const std::vector<EdgeCrossing>& along(std::uint32_t half_edge, const std::array<bool, 2>& faces_eye) &;
    /// The same for LoopTopology::half_edge of an edge of ControlEdges::Kind::regular.
    const std::vector<EdgeCrossing>& along_regular(std::uint32_t edge, const std::array<bool, 2>& faces_eye) &;

private:
    struct Piece {
        dvec3 anchor;
        SideNet net;
        double begin, end; ///< in parameters of the half-edge
    };
    /// A part of an edge: the side of a polynomial, or of a triangle that is still many and has no net.
    struct Part {
        const FacePatches* face;
        const PatchClass::Node* node;
        int side;
        Piece piece;
        std::array<double, 10> along; ///< the contour's polynomial
        bool is_patch() const { return node->kind == PatchClass::Kind::patch; }
    };

    void collect(const FacePatches& face, const PatchClass::Node& node, int side, double begin, double end, int levels, std::vector<Part>& parts) const;
    void search(const std::vector<Part>& parts, bool before, bool after, int levels);
    bool add_changes(const Piece& piece, const std::array<double, 10>& along, bool before);
    void add_at(double t);
    void finish();

    const LimitShape& shape_;
    const Eye& eye_;
    std::uint32_t half_edge_ = 0;
    std::vector<Part> parts_;
    std::vector<double> roots_;
    std::vector<EdgeCrossing> crossings_;
};

} // namespace limn
