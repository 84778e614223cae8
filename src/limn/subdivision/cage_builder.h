#pragma once

#include <functional>
#include <span>
#include <vector>

#include "limn/geometry/mesh.h"

namespace limn {

/// Builds a control mesh as a modeller does: rings of vertices, bands of quadrilaterals between them, faces pulled out, a half mirrored.
/// Faces are counter-clockwise seen from outside.
class CageBuilder {
public:
    /// Numbers of vertices, in their order along a row or around a ring or face.
    using Row = std::vector<std::uint32_t>;

    std::uint32_t vertex(const dvec3& position);
    Row row(std::span<const dvec3> positions);
    const dvec3& position(std::uint32_t v) const { return positions_[v]; }

    /// A triangle or quadrilateral. The latter is cut from its second to its fourth corner.
    void face(const Row& corners);
    /// The quadrilaterals a0 a1 b1 b0 and so on between two rows of the same length. Their outer side is to the left of `b` seen from `a`.
    void band(const Row& a, const Row& b);
    /// The same with a band from the last vertices to the first.
    void closed_band(const Row& a, const Row& b);
    /// The band between a ring and one of half as many vertices, each of which lies beside a vertex of the ring of an even number.
    /// `inwards`: the outer side is that of closed_band(a, half), else that of closed_band(half, a).
    void halving_band(const Row& a, const Row& half, bool inwards = true);
    /// Closes a ring by triangles around a vertex in the middle.
    void fan(const Row& ring, const dvec3& middle);
    /// Closes a row of an even number of vertices by quadrilaterals between its first half and its second.
    void ladder(const Row& row);

    /// Takes the face with these corners away, and joins its border by quadrilaterals to a face of new vertices, one for each corner.
    /// @param corners  in any order
    /// @param moved    the new position for a corner's; called in the order of the face (see band)
    /// @return the new vertices in the order of the face
    /// @throws std::logic_error where there is no such face
    Row extrude(const Row& corners, const std::function<dvec3(const dvec3&)>& moved);
    /// @param corners  in any order. @throws std::logic_error where there is no such face
    void remove_face(const Row& corners);

    void crease(std::uint32_t a, std::uint32_t b, float sharpness) { creases_.push_back({a, b, sharpness}); }
    void crease_row(const Row& row, float sharpness);
    void crease_ring(const Row& ring, float sharpness);

    /// Adds the image of everything on the other side of the plane z = 0. Vertices with z = 0 belong to both halves.
    void mirror();

    /// Triangles, with the creases.
    Mesh mesh() const;

private:
    std::size_t find_face(const Row& corners) const;

    std::vector<dvec3> positions_;
    std::vector<Row> faces_;
    std::vector<CreaseEdge> creases_;
};

} // namespace limn
