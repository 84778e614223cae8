#include "limn/subdivision/map_gutter.h"

#include <algorithm>
#include <limits>

namespace limn {
namespace {

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

/// The side of a chart's outline nearest to a place.
struct NearestSide {
    int face = 0, side = 0;
    double along = 0; ///< where on the side, 0..1
    double squared = std::numeric_limits<double>::infinity();
};

NearestSide nearest_side(const Chart& chart, const dvec2& p, const LoopTopology& t)
{
    NearestSide nearest;
    for (int f = 0; f < chart.face_count(); ++f)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t over = t.twin[3 * chart.faces[f] + std::uint32_t(k)];
            const dvec2 &a = chart.corners[f][k], side = chart.corners[f][(k + 1) % 3] - a;
            const double squared_length = glm::dot(side, side);
            const double along = squared_length > 0 ? std::clamp(glm::dot(p - a, side) / squared_length, 0.0, 1.0) : 0.0;
            const dvec2 d = p - (a + along * side);
            const bool inside = over != none && chart.face_count() == 2 && over / 3 == chart.faces[1 - f]; // between the chart's two faces
            if (!inside && glm::dot(d, d) < nearest.squared)
                nearest = {f, k, along, glm::dot(d, d)};
        }
    return nearest;
}

/// A place on a side of a face.
PatchPoint on_side(std::uint32_t face, int side, double along)
{
    double weights[3] = {0, 0, 0};
    weights[side] = 1 - along;
    weights[(side + 1) % 3] = along;
    return {face, weights[1], weights[2]};
}

} // namespace

dvec2 flat_parameters(const dvec2 (&corners)[3], const dvec2& p)
{
    const dvec2 v_side = corners[1] - corners[0], w_side = corners[2] - corners[0], d = p - corners[0];
    const double area = cross(v_side, w_side);
    return {cross(d, w_side) / area, cross(v_side, d) / area};
}

PatchPoint inside_face(std::uint32_t face, const dvec2& parameters)
{
    const double v = std::max(parameters.x, 0.0), w = std::max(parameters.y, 0.0), sum = std::max(v + w, 1.0);
    return {face, v / sum, w / sum};
}

GutterPoint gutter_point(const Chart& chart, const dvec2& p, const LoopTopology& t, std::span<const dvec3> limit)
{
    const NearestSide nearest = nearest_side(chart, p, t);
    const std::uint32_t h = 3 * chart.faces[nearest.face] + std::uint32_t(nearest.side), over = t.twin[h];
    const PatchPoint own = on_side(chart.faces[nearest.face], nearest.side, nearest.along);
    if (over == none || t.sharpness[t.edge[h]] >= infinitely_sharp)
        return {own, own};
    const dvec2 &a = chart.corners[nearest.face][nearest.side], b = chart.corners[nearest.face][(nearest.side + 1) % 3];
    const dvec3 &origin = limit[t.start(h)], edge = limit[t.end(h)] - origin, to_tip = limit[t.opposite(over)] - origin;
    const double length = glm::length(edge), height = length > 0 ? glm::length(glm::cross(edge, to_tip)) / length : 0;
    if (!(height > 0))
        return {own, own};
    const dvec2 x = (b - a) / length, out = {x.y, -x.x};
    dvec2 corners[3];
    const std::uint32_t k = over % 3; // the neighbour's side runs from b to a
    corners[k] = b;
    corners[(k + 1) % 3] = a;
    corners[(k + 2) % 3] = a + glm::dot(edge, to_tip) / length * x + height * out;
    return {own, inside_face(over / 3, flat_parameters(corners, p))};
}

} // namespace limn
