#include "limn/lines/coverage.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "limn/base/parallel.h"

namespace limn {
namespace {

constexpr std::size_t grain = 4096;
constexpr double nearest_depth = 1e-3;

/// A convex polygon of at most four corners.
struct Polygon {
    dvec2 corners[4];
    int count = 0;
};

/// The part of a face in front of the eye, in coordinates of the grid (samples at whole numbers).
Polygon projected_face(const LineModel& model, const Projector& projector, const SampleGrid& grid, const uvec3& face)
{
    Polygon polygon;
    const auto add = [&](const dvec3& p) { polygon.corners[polygon.count++] = (dvec2(p) - grid.low) / grid.spacing - 0.5; };
    for (int k = 0; k < 3; ++k) {
        const vec3 &a = model.positions[face[k]], &b = model.positions[face[(k + 1) % 3]];
        if (projector.orthographic) {
            add(projector.project(a));
            continue;
        }
        const double da = projector.depth(a), db = projector.depth(b);
        if (da >= nearest_depth)
            add(projector.project(a));
        if ((da >= nearest_depth) != (db >= nearest_depth))
            add(projector.project(glm::mix(a, b, float((nearest_depth - da) / (db - da)))));
    }
    return polygon;
}

/// Where the line of samples at height y meets the edge from a to b; the same bits whichever face asks.
double crossing(dvec2 a, dvec2 b, double y)
{
    if (b.y < a.y)
        std::swap(a, b);
    return a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
}

/// The range of x that the polygon covers at height y; empty (first > second) where it does not reach there.
std::pair<double, double> span_at(const Polygon& polygon, double y)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int k = 0; k < polygon.count; ++k) {
        const dvec2 &a = polygon.corners[k], &b = polygon.corners[(k + 1) % polygon.count];
        if ((a.y < y && b.y < y) || (a.y > y && b.y > y))
            continue;
        const bool level = a.y == b.y;
        low = std::min(low, level ? std::min(a.x, b.x) : crossing(a, b, y));
        high = std::max(high, level ? std::max(a.x, b.x) : crossing(a, b, y));
    }
    return {low, high};
}

void cover(Image& image, const Polygon& polygon)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int k = 0; k < polygon.count; ++k) {
        low = std::min(low, polygon.corners[k].y);
        high = std::max(high, polygon.corners[k].y);
    }
    const double last_row = image.height - 1, last_column = image.width - 1;
    for (int j = int(std::ceil(glm::clamp(low, 0.0, last_row + 1))); j <= std::floor(std::min(high, last_row)); ++j) {
        const auto [from, to] = span_at(polygon, j);
        for (int i = int(std::ceil(glm::clamp(from, 0.0, last_column + 1))); i <= std::floor(std::min(to, last_column)); ++i)
            std::atomic_ref(*image.at(i, j)).store(1.0f, std::memory_order_relaxed); // every writer writes the same
    }
}

} // namespace

Image rasterise_coverage(const LineModel& model, const Projector& projector, const SampleGrid& grid)
{
    Image image(grid.size, 1);
    parallel_each(model.faces.size(), grain, [&](std::size_t f) {
        const Polygon polygon = projected_face(model, projector, grid, model.faces[f]);
        if (polygon.count >= 3)
            cover(image, polygon);
    });
    return image;
}

} // namespace limn
