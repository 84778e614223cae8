#include "limn/terrain/measure_terrain.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "limn/base/parallel.h"
#include "limn/terrain/height_window.h"

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

/// Calls `f(column, row, height)` for the samples in a triangle and some rows of the map, with the triangle's height there.
template <class F> void rasterise(const HeightMap& map, const HeightWindow& rows, const GridTriangle& t, F&& f)
{
    constexpr double slack = 1e-9; // vertices are at samples but for rounding
    const auto& [p, q, r] = t.p;
    const double area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    if (!(std::abs(area) > slack))
        return;
    const int left = std::max(0, int(std::ceil(std::min({p.x, q.x, r.x}) - slack))), right = std::min(map.columns - 1, int(std::floor(std::max({p.x, q.x, r.x}) + slack)));
    const int south = std::max(map.rows - rows.end.y, int(std::ceil(std::min({p.y, q.y, r.y}) - slack)));
    const int north = std::min(map.rows - 1 - rows.first.y, int(std::floor(std::max({p.y, q.y, r.y}) + slack)));
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

/// Adds the samples of some rows up.
class Sum {
public:
    explicit Sum(double tolerance) : tolerance_(tolerance) {}
    /// @param off  of each sample in the rows
    void add(const HeightWindow& rows, const std::vector<double>& off)
    {
        const double* at = off.data();
        for (int row = rows.first.y; row < rows.end.y; ++row, at += rows.end.x)
            add_row(rows.at(0, row), at, rows.end.x);
    }
    MeasuredTerrain result() const
    {
        MeasuredTerrain result = sum_;
        result.rms = sum_.samples > 0 ? std::sqrt(squares_ / double(sum_.samples)) : 0;
        return result;
    }

private:
    void add_row(const float* heights, const double* off, int count)
    {
        for (int i = 0; i < count; ++i) {
            if (std::isnan(heights[i]) || off[i] == Distance::unseen)
                continue;
            if (off[i] == bare) {
                ++sum_.bare;
                continue;
            }
            ++sum_.samples;
            sum_.over += off[i] > tolerance_;
            sum_.maximum = std::max(sum_.maximum, off[i]);
            squares_ += off[i] * off[i];
        }
    }
    double tolerance_, squares_ = 0;
    MeasuredTerrain sum_;
};

/// How far samples of some rows are from a mesh: of each, the most by all triangles over it.
std::vector<double> distances(const HeightMap& frame, const HeightWindow& rows, const Mesh& mesh, std::span<const std::uint32_t> triangles, const Distance& distance)
{
    const std::size_t columns = std::size_t(rows.end.x);
    std::vector<double> off(std::size_t(rows.end.y - rows.first.y) * columns, bare);
    parallel_each(triangles.size(), 1024, [&](std::size_t i) {
        rasterise(frame, rows, on_grid(frame, mesh, mesh.triangles[triangles[i]]), [&](int column, int row, double height) {
            const double sample = double(rows.height({column, row}));
            if (!std::isnan(sample))
                raise(off[std::size_t(row - rows.first.y) * columns + std::size_t(column)],
                      distance({column * frame.spacing.x, (frame.rows - 1 - row) * frame.spacing.y, sample}, height));
        });
    });
    return off;
}

/// The triangles over each band of so many rows.
std::vector<std::vector<std::uint32_t>> triangles_of_bands(const HeightMap& frame, const Mesh& mesh, int rows_in_band)
{
    std::vector<std::vector<std::uint32_t>> bands(std::size_t((frame.rows - 1) / rows_in_band) + 1);
    const auto band_of = [&](double y) { return std::size_t(std::clamp(frame.rows - 1 - int(std::lround(y / frame.spacing.y)), 0, frame.rows - 1) / rows_in_band); };
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const uvec3& t = mesh.triangles[i];
        const auto [south, north] = std::minmax({mesh.positions[t.x].y, mesh.positions[t.y].y, mesh.positions[t.z].y});
        for (std::size_t band = band_of(north); band <= band_of(south); ++band)
            bands[band].push_back(std::uint32_t(i));
    }
    return bands;
}

} // namespace

MeasuredTerrain measure_terrain(const HeightMap& map, const Mesh& mesh, double tolerance, const std::optional<Camera>& camera, double nearest)
{
    Sum sum(tolerance);
    const std::vector<std::vector<std::uint32_t>> all = triangles_of_bands(map, mesh, map.rows);
    sum.add(whole_window(map), distances(map, whole_window(map), mesh, all.front(), Distance(camera, nearest)));
    return sum.result();
}

MeasuredTerrain measure_terrain(const HeightRows& rows, const Mesh& mesh, double tolerance, const std::optional<Camera>& camera, double nearest, double exaggerate)
{
    constexpr int rows_in_band = 256;
    const HeightMap& frame = rows.frame;
    const std::vector<std::vector<std::uint32_t>> bands = triangles_of_bands(frame, mesh, rows_in_band);
    Sum sum(tolerance);
    std::vector<float> heights;
    for (std::size_t band = 0; band < bands.size(); ++band) {
        const int first = int(band) * rows_in_band, end = std::min(frame.rows, first + rows_in_band);
        heights.resize(std::size_t(end - first) * std::size_t(frame.columns));
        rows.read(first, end - first, heights.data());
        if (exaggerate != 1)
            for (float& height : heights)
                height = float(double(height) * exaggerate);
        const HeightWindow window = {heights.data(), std::size_t(frame.columns), {0, first}, {frame.columns, end}};
        sum.add(window, distances(frame, window, mesh, bands[band], Distance(camera, nearest)));
    }
    return sum.result();
}

} // namespace limn
