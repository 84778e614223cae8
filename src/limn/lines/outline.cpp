#include "limn/lines/outline.h"

#include <algorithm>
#include <cmath>

#include "limn/base/parallel.h"
#include "limn/drawing/simplify.h"
#include "limn/drawing/trace.h"
#include "limn/lines/clip.h"
#include "limn/lines/coverage.h"
#include "limn/lines/regions.h"

namespace limn {
namespace {

/// Samples over the picture and what strokes keep beyond its border, and so much more that no curve closes in sight.
SampleGrid grid_of_picture(const Camera& camera, double spacing)
{
    const dvec2 margin = 0.02 * dvec2(camera.size) + 4.0 * spacing, extent = dvec2(camera.size) + 2.0 * margin;
    return {-margin, spacing, ivec2(glm::ceil(extent / spacing))};
}

/// A point of a curve: in the picture, and what was hit just inside of it.
struct OutlinePoint {
    dvec2 pixel;
    Fragment inner;
};

class Bisection {
public:
    Bisection(const FragmentTracer& tracer, const SampleGrid& grid) : tracer_(tracer), grid_(grid) {}

    /// Moves the middle between two neighbouring samples, one covered and one not, onto the edge of what rays hit.
    /// @param sample  in units of samples, whole where a sample stands
    OutlinePoint at(const dvec2& sample) const
    {
        const bool along_row = sample.y == std::floor(sample.y);
        const dvec2 half = along_row ? dvec2(0.5, 0) : dvec2(0, 0.5);
        dvec2 inside = pixel(sample - half), outside = pixel(sample + half);
        Fragment hit = tracer_.at(inside);
        if (!hit.hit()) {
            std::swap(inside, outside);
            hit = tracer_.at(inside);
        }
        for (int i = 0; i < 8; ++i) {
            const dvec2 middle = 0.5 * (inside + outside);
            const Fragment fragment = tracer_.at(middle);
            (fragment.hit() ? inside : outside) = middle;
            if (fragment.hit())
                hit = fragment;
        }
        return {0.5 * (inside + outside), hit};
    }

private:
    dvec2 pixel(const dvec2& sample) const { return grid_.low + (sample + 0.5) * grid_.spacing; }

    const FragmentTracer& tracer_;
    const SampleGrid& grid_;
};

/// A point that no ray hit (a sliver between rays) stands where the last one that was hit did.
void fill_misses(std::vector<OutlinePoint>& points)
{
    const auto first = std::find_if(points.begin(), points.end(), [](const OutlinePoint& p) { return p.inner.hit(); });
    if (first == points.end()) {
        points.clear();
        return;
    }
    Fragment last = first->inner;
    for (OutlinePoint& p : points) {
        if (!p.inner.hit())
            p.inner = last;
        last = p.inner;
    }
}

Stroke stroke_of(const LineModel& model, const std::vector<OutlinePoint>& points)
{
    Stroke stroke;
    stroke.type = LineType::outline;
    stroke.closed = true;
    stroke.object = model.object_of_face(points.front().inner.triangle);
    for (const OutlinePoint& p : points) {
        const std::uint32_t object = model.object_of_face(p.inner.triangle);
        stroke.points.push_back(p.pixel);
        stroke.world.push_back(model.to_world(p.inner.position));
        stroke.ink.push_back(1);
        stroke.faces.push_back(object == stroke.object ? p.inner.triangle - model.first_face[object] : none);
    }
    return stroke;
}

} // namespace

std::vector<Stroke> extract_outline(const LineModel& model, const RayScene& rays, const Camera& camera, const OutlineOptions& options)
{
    const SampleGrid grid = grid_of_picture(camera, options.spacing);
    const Image covered = rasterise_coverage(model, Projector(model, camera), grid);
    const SeenScene scene = seen_scene(model, rays);
    const FragmentTracer tracer(scene, camera);
    const Bisection bisection(tracer, grid);
    SimplifyOptions simplification;
    simplification.tolerance = options.tolerance;

    std::vector<Stroke> strokes;
    for (const std::vector<dvec2>& ring : trace_rings(covered, 0.5f, 0)) {
        if (std::abs(rings_area({ring})) * grid.spacing * grid.spacing < options.least_area)
            continue;
        std::vector<OutlinePoint> points(ring.size());
        parallel_each(ring.size(), 64, [&](std::size_t i) { points[i] = bisection.at(ring[i] - 0.5); });
        fill_misses(points);
        if (points.size() >= 3)
            clip_to_picture(simplify(stroke_of(model, points), simplification), camera.size, strokes);
    }
    return strokes;
}

} // namespace limn
