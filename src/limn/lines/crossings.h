#pragma once

#include <span>
#include <vector>

#include "limn/lines/projector.h"
#include "limn/lines/segment.h"

namespace limn {

/// A piece of a line that can hide others behind one of its sides: a contour with radial curvature >= 0, a border edge, an
/// edge between a front and a back face.
struct Occluder {
    dvec3 a, b;                           ///< projected ends: pixels and depth
    dvec2 outward;                        ///< in the picture, away from the surface that it bounds
    std::uint32_t id_a = none, id_b = none; ///< ends: equal to those of a segment that it joins
};

/// Where a line passes under an occluder.
struct Cut {
    std::uint32_t segment;
    float t;         ///< place on the segment in space, in (0,1)
    bool may_hide;   ///< walking from a to b, visible -> hidden is expected here
    bool may_appear; ///< walking from a to b, hidden -> visible is expected here
};

/// The occluders of a view in a uniform grid over the picture.
class OccluderGrid {
public:
    OccluderGrid(std::vector<Occluder> occluders, const Camera& camera);

    /// The places where the segment with projected ends a and b passes behind an occluder that shares none of its ends.
    /// Appends to `cuts`, from a to b.
    void find(std::uint32_t index, const Segment& segment, const dvec3& a, const dvec3& b, const Projector& projector, std::vector<Cut>& cuts) const;

    bool empty() const { return occluders_.empty(); }

private:
    template <class F> void for_cells(const dvec3& a, const dvec3& b, F&& f) const;
    std::vector<Occluder> occluders_;
    double cell_ = 1;
    dvec2 low_ = dvec2(0);
    ivec2 cells_ = ivec2(0);
    std::vector<std::uint32_t> start_, item_;
};

} // namespace limn
