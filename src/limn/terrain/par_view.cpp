#include "limn/terrain/par_view.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/formulas/formulas.h"

namespace limn {

SeenTerrain::SeenTerrain(const HeightMap& map, const NestedErrors& ranges, const Camera& camera)
    : map_(map), ranges_(ranges), eye_(camera.eye), right_(camera.right()), above_(camera.above()), forward_(camera.forward()),
      scale_(camera.pixels_per_unit(1)), parallel_(camera.orthographic)
{
    if (ranges.low.empty() && !ranges.errors.empty())
        throw Error::Input("what is seen of a terrain needs the heights' ranges; nest errors with ranges");
    across_ = 0.5 * dvec2(camera.size) / scale_;
}

bool SeenTerrain::box(const dvec2& middle, double reach, double low, double high) const
{
    if (!(low <= high))
        return false;
    const formulas::BoundCamera camera = {right_, above_, forward_, scale_, 0, parallel_ ? 1.0 : 0.0};
    const dvec3 place(middle.x * map_.spacing.x, (map_.rows - 1 - middle.y) * map_.spacing.y, 0.5 * (low + high));
    const dvec3 half(reach * map_.spacing.x, reach * map_.spacing.y, 0.5 * (high - low));
    return formulas::box_may_be_seen(camera, across_, place - eye_, half, 1e-9 * (glm::length(place) + glm::length(eye_)));
}

bool SeenTerrain::edge(const ivec2& a, const ivec2& b) const
{
    const ivec2 p = (a + b) / 2, along = glm::abs(a - b);
    const std::size_t i = ranges_.lattice.index(p);
    return box(p, 0.5 * std::max(along.x, along.y), double(ranges_.low[i]), double(ranges_.high[i]));
}

bool SeenTerrain::triangle(const BisectionTriangle& t) const
{
    if (t.can_split()) { // around the boxes of its edges: legs reach further than a diagonal hypotenuse
        const ivec2 along = glm::abs(t.a - t.b);
        const std::size_t i = ranges_.lattice.index(t.middle());
        return box(t.middle(), along.x == along.y ? along.x : 0.5 * std::max(along.x, along.y), double(ranges_.low[i]),
                   double(ranges_.high[i]));
    }
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (const ivec2& p : {t.apex, t.a, t.b})
        if (map_.contains(p.x, p.y) && map_.has_data(p.x, p.y))
            low = std::min(low, map_.height(p.x, p.y)), high = std::max(high, map_.height(p.x, p.y));
    return box(0.5 * dvec2(t.a + t.b), 1, double(low), double(high));
}

bool is_same_view(const Camera& a, const Camera& b)
{
    return a.eye == b.eye && a.look == b.look && a.up == b.up && a.fov_degrees == b.fov_degrees && a.orthographic == b.orthographic &&
           a.ortho_height == b.ortho_height && a.size == b.size;
}

ParView::ParView(const HeightMap& map, const NestedErrors& ranges, std::vector<BisectionTriangle> start)
    : map_(map), ranges_(ranges), start_(std::move(start))
{
}

std::size_t ParView::update(const Camera& camera, double pixels, std::function<void(ParStage)> on_stage)
{
    if (!(pixels >= 0))
        throw Error::Input(fmt::format("a tolerance of {} px: it has to be 0 or more", pixels));
    if (pixels == pixels_ && is_same_view(camera, camera_))
        return 0;
    const SeenTerrain seen(map_, ranges_, camera);
    const EdgeTest off = screen_height_test(map_, camera, pixels);
    const EdgeTest test = [&](const ivec2& a, const ivec2& b) { return seen.edge(a, b) && off(a, b); };
    ParOptions options;
    options.visible = [&](const BisectionTriangle& t) { return seen.triangle(t); };
    options.on_stage = std::move(on_stage);
    result_ = refine_in_parallel(ranges_.lattice, start_, test, options);
    camera_ = camera, pixels_ = pixels;
    std::size_t tested = 0;
    for (const ParStep& step : result_.steps)
        tested += step.tested;
    return tested;
}

std::vector<BisectionTriangle> ParView::seen() const
{
    const SeenTerrain seen(map_, ranges_, camera_);
    std::vector<BisectionTriangle> out;
    std::copy_if(result_.triangles.begin(), result_.triangles.end(), std::back_inserter(out),
                 [&](const BisectionTriangle& t) { return seen.triangle(t); });
    return out;
}

} // namespace limn
