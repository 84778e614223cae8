#pragma once

#include <array>
#include <span>
#include <vector>

#include "limn/subdivision/box_spline.h"
#include "limn/subdivision/control_edges.h"
#include "limn/subdivision/loop_topology.h"

namespace limn {

/// How the limit surface over a triangle is cut into polynomials: a tree of triangles cut into four. Towards an extraordinary vertex, or the
/// end of a crease, which is the triangle's first corner, it goes on to `deepest` levels; what is left there counts as the corner itself.
struct PatchClass {
    static constexpr int deepest = 26;

    enum class Kind : std::uint8_t {
        inner,  ///< its children are first_child + k at corner k, + 3 in the middle
        patch,  ///< a polynomial: rows of 15 coefficients (QuarticPatch)
        corner, ///< the rest at the first corner
    };
    struct Node {
        Kind kind = Kind::inner;
        std::uint32_t first_child = 0; ///< inner
        std::uint32_t row = 0;         ///< patch: the first of its rows
    };

    std::size_t support = 0; ///< points that the surface over the triangle depends on
    /// Where there is more than one patch, the first three rows are the limit position of the first corner and two directions of its tangent
    /// plane (LimitPoint), and the rows of patches give their coefficients as seen from there: so they keep their digits however small they are.
    bool anchored = false;
    bool fades = false;          ///< there are semi-sharp edges: near them the surface turns at every level otherwise
    std::vector<Node> nodes;     ///< the first is the whole triangle
    std::vector<double> weights; ///< rows of `support`
    std::span<const double> row(std::size_t i) const { return {weights.data() + i * support, support}; }
};

/// How the limit surface of a control mesh depends on its vertices: made once for a topology, whatever the pose. Patches are those of the mesh
/// after one step, where a face has at most one extraordinary vertex: four for each control face. Faces that hang together in the same way
/// share a class. Under the rule of OpenSubdiv. (After Stam 1998 and Niessner et al. 2012; silhouette-loop specification, 2.4 and appendix.)
class PatchTable {
public:
    /// The class of faces without anything extraordinary around them, whose 12 points are in the order of box_spline.h.
    static constexpr std::uint32_t regular = 0;

    explicit PatchTable(LoopTopology control);

    const LoopTopology& control() const { return control_; }
    /// The mesh after one step; face 4f + k is at corner k of control face f, 4f + 3 in its middle.
    const LoopTopology& refined() const { return refined_; }
    const ControlEdges& edges() const { return edges_; }
    std::uint32_t class_of(std::uint32_t refined_face) const { return class_[refined_face]; }
    const PatchClass& patch_class(std::uint32_t number) const { return classes_[number]; }
    /// The vertices of the refined mesh that a face of it depends on.
    std::span<const std::uint32_t> support(std::uint32_t refined_face) const
    {
        return {support_.data() + first_[refined_face], first_[refined_face + 1] - first_[refined_face]};
    }

private:
    LoopTopology control_, refined_;
    ControlEdges edges_;
    std::vector<PatchClass> classes_;
    std::vector<std::uint32_t> class_;   ///< per refined face
    std::vector<std::size_t> first_;     ///< per refined face, and one past the last
    std::vector<std::uint32_t> support_;
};

} // namespace limn
