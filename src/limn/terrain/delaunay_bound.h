#pragma once

#include <algorithm>
#include <cstdint>

#include "limn/terrain/delaunay_triangulation.h"
#include "limn/terrain/height_map.h"
#include "limn/terrain/triangle_scan.h"

namespace limn {

/// What triangles of a mesh may be like.
struct DelaunayBound {
    double tolerance = 0; ///< metres along z of any sample
    double max_edge = 0;  ///< samples; infinite: any

    bool has_short_edges(const ivec2& p, const ivec2& q, const ivec2& r) const { return !(longest2(p, q, r) > max_edge * max_edge); }
    /// Whether a triangle with data at its corners is counter-clockwise, its edges are short enough and all its samples near enough.
    bool holds(const HeightMap& map, const ivec2& p, const ivec2& q, const ivec2& r) const
    {
        const std::int64_t area = DelaunayTriangulation::area2(p, q, r);
        if (area <= 0 || !has_short_edges(p, q, r))
            return false;
        return has_no_sample_inside(area) || SampledTriangle(map, p, q, r).is_within(tolerance);
    }
    /// Twice the area tells, by Pick's theorem, whether corners are a triangle's only samples.
    static bool has_no_sample_inside(std::int64_t area2) { return area2 == 1; }

private:
    static double longest2(const ivec2& p, const ivec2& q, const ivec2& r)
    {
        const auto length2 = [](const ivec2& a, const ivec2& b) { return glm::dot(dvec2(b - a), dvec2(b - a)); };
        return std::max({length2(p, q), length2(q, r), length2(r, p)});
    }
};

} // namespace limn
