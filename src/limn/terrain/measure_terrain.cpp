#include "limn/terrain/measure_terrain.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "limn/base/parallel.h"

namespace limn {
namespace {

/// A sample that nothing of the mesh is above or below.
constexpr double bare = -2;

/// Corners of a triangle in units of samples, with x to the east and y to the north.
struct GridTriangle {
    dvec3 p[3];
};

GridTriangle on_grid(const HeightMap& map, const Mesh& mesh, const uvec3& triangle)
{
    GridTriangle t;
    for (int i = 0; i < 3; ++i) {
        const dvec3& p = mesh.positions[triangle[i]];
        t.p[i] = {p.x / map.spacing.x, p.y / map.spacing.y, p.z};
    }
    return t;
}

/// Calls `f(column, row, height)` for the samples in a triangle, with the triangle's height there.
template <class F> void rasterise(const HeightMap& map, const GridTriangle& t, F&& f)
{
    constexpr double slack = 1e-9; // vertices are at samples but for rounding
    const auto& [p, q, r] = t.p;
    const double area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    if (!(std::abs(area) > slack))
        return;
    const int left = std::max(0, int(std::ceil(std::min({p.x, q.x, r.x}) - slack))), right = std::min(map.columns - 1, int(std::floor(std::max({p.x, q.x, r.x}) + slack)));
    const int south = std::max(0, int(std::ceil(std::min({p.y, q.y, r.y}) - slack))), north = std::min(map.rows - 1, int(std::floor(std::max({p.y, q.y, r.y}) + slack)));
    for (int y = south; y <= north; ++y)
        for (int x = left; x <= right; ++x) {
            const double u = ((q.x - x) * (r.y - y) - (q.y - y) * (r.x - x)) / area, v = ((r.x - x) * (p.y - y) - (r.y - y) * (p.x - x)) / area, w = 1 - u - v;
            if (u >= -slack && v >= -slack && w >= -slack)
                f(x, map.rows - 1 - y, u * p.z + v * q.z + w * r.z);
        }
}

/// Keeps the greatest value, from any thread.
void raise(double& slot, double value)
{
    std::atomic_ref<double> shared(slot);
    double now = shared.load(std::memory_order_relaxed);
    while (now < value && !shared.compare_exchange_weak(now, value, std::memory_order_relaxed)) {
    }
}

/// How far apart a sample and the mesh at its place are: metres, or pixels where a camera sees it, else unseen.
class Distance {
public:
    static constexpr double unseen = -1;
    Distance(const std::optional<Camera>& camera, double nearest) : camera_(camera), nearest_(nearest) {}
    double operator()(const dvec3& sample, double height) const
    {
        if (!camera_)
            return std::abs(sample.z - height);
        const Projected wanted = camera_->project(sample), found = camera_->project({sample.x, sample.y, height});
        if (!(wanted.depth > nearest_ && found.depth > nearest_) || !(is_inside(wanted.pixel) || is_inside(found.pixel)))
            return unseen;
        return glm::distance(wanted.pixel, found.pixel);
    }

private:
    bool is_inside(const dvec2& pixel) const { return pixel.x >= 0 && pixel.y >= 0 && pixel.x <= camera_->size.x && pixel.y <= camera_->size.y; }
    const std::optional<Camera>& camera_;
    double nearest_;
};

MeasuredTerrain sum_up(const HeightMap& map, const std::vector<double>& off, double tolerance)
{
    MeasuredTerrain sum;
    double squares = 0;
    for (std::size_t i = 0; i < off.size(); ++i) {
        if (std::isnan(map.heights[i]) || off[i] == Distance::unseen)
            continue;
        if (off[i] == bare) {
            ++sum.bare;
            continue;
        }
        ++sum.samples;
        sum.over += off[i] > tolerance;
        sum.maximum = std::max(sum.maximum, off[i]);
        squares += off[i] * off[i];
    }
    sum.rms = sum.samples > 0 ? std::sqrt(squares / double(sum.samples)) : 0;
    return sum;
}

} // namespace

MeasuredTerrain measure_terrain(const HeightMap& map, const Mesh& mesh, double tolerance, const std::optional<Camera>& camera, double nearest)
{
    std::vector<double> off(map.heights.size(), bare);
    const Distance distance(camera, nearest);
    parallel_each(mesh.triangles.size(), 1024, [&](std::size_t i) {
        rasterise(map, on_grid(map, mesh, mesh.triangles[i]), [&](int column, int row, double height) {
            if (map.has_data(column, row))
                raise(off[map.index(column, row)], distance(map.position(column, row), height));
        });
    });
    return sum_up(map, off, tolerance);
}

} // namespace limn
