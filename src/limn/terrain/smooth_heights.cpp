#include "limn/terrain/smooth_heights.h"

#include <algorithm>
#include <cmath>

#include "limn/base/parallel.h"
#include "limn/terrain/fill_no_data.h"

namespace limn {
namespace {

constexpr std::size_t grain_rows = 16, grain_samples = 1 << 14;

/// Weights of a sample and of those to one side of it; with both sides they add up to 1.
std::vector<double> half_kernel(double deviation)
{
    std::vector<double> weights = {1};
    double sum = 1;
    for (int i = 1; i <= int(std::ceil(3 * deviation)); ++i) {
        weights.push_back(std::exp(-0.5 * i * i / (deviation * deviation)));
        sum += 2 * weights.back();
    }
    for (double& w : weights)
        w /= sum;
    return weights;
}

/// What stands at a place on or beyond a line of samples that goes on as its mirror image through each of its ends:
/// sign * line[at] + first * line[0] + last * line[count - 1].
struct Mirrored {
    int at;
    double sign, first, last;
};
Mirrored mirrored(int i, int count)
{
    const int period = 2 * (count - 1), turns = i >= 0 ? i / period : -((-i + period - 1) / period), rest = i - turns * period;
    const Mirrored once = rest < count ? Mirrored{rest, 1, 0, 0} : Mirrored{period - rest, -1, 0, 2};
    return {once.at, once.sign, once.first - 2 * turns, once.last + 2 * turns}; // each period rises as far again
}

class Smoother {
public:
    explicit Smoother(HeightMap map) : map_(std::move(map)) {}

    /// The map smoothed by a Gaussian of so many metres.
    std::vector<float> smoothed(double deviation) const
    {
        return along_columns(along_rows(half_kernel(deviation / map_.spacing.x)), half_kernel(deviation / map_.spacing.y));
    }
    const HeightMap& map() const { return map_; }

private:
    std::vector<float> along_rows(const std::vector<double>& weights) const
    {
        std::vector<float> out(map_.heights.size());
        const int n = map_.columns, reach = int(weights.size()) - 1;
        parallel_each(std::size_t(map_.rows), grain_rows, [&](std::size_t row) {
            const float* const in = map_.heights.data() + row * std::size_t(n);
            std::vector<double> line(std::size_t(n + 2 * reach));
            for (int i = -reach; i < n + reach; ++i) {
                const Mirrored m = mirrored(i, n);
                line[std::size_t(i + reach)] = m.sign * double(in[m.at]) + m.first * double(in[0]) + m.last * double(in[n - 1]);
            }
            for (int i = 0; i < n; ++i) {
                const double* const here = line.data() + i + reach;
                double sum = weights[0] * *here;
                for (int k = 1; k <= reach; ++k)
                    sum += weights[std::size_t(k)] * (here[-k] + here[k]);
                out[row * std::size_t(n) + std::size_t(i)] = float(sum);
            }
        });
        return out;
    }
    std::vector<float> along_columns(const std::vector<float>& in, const std::vector<double>& weights) const
    {
        std::vector<float> out(in.size());
        const std::size_t n = std::size_t(map_.columns);
        const int reach = int(weights.size()) - 1;
        parallel_each(std::size_t(map_.rows), grain_rows, [&](std::size_t row) {
            std::vector<double> sum(n, 0);
            for (int k = -reach; k <= reach; ++k) {
                const Mirrored m = mirrored(int(row) + k, map_.rows);
                const double w = weights[std::size_t(std::abs(k))];
                const float* const line = in.data() + std::size_t(m.at) * n;
                for (std::size_t i = 0; i < n; ++i)
                    sum[i] += w * m.sign * double(line[i]);
                if (m.first != 0 || m.last != 0)
                    for (std::size_t i = 0; i < n; ++i)
                        sum[i] += w * (m.first * double(in[i]) + m.last * double(in[in.size() - n + i]));
            }
            for (std::size_t i = 0; i < n; ++i)
                out[row * n + i] = float(sum[i]);
        });
        return out;
    }
    HeightMap map_;
};

/// The deviation that is wanted at every sample, in metres: 0 where there is no data.
std::vector<float> deviations_of(const HeightMap& map, const std::function<double(const dvec3&)>& deviation)
{
    const double most = widest_smoothing * std::min(map.spacing.x, map.spacing.y);
    std::vector<float> out(map.heights.size(), 0.0f);
    parallel_each(std::size_t(map.rows), grain_rows, [&](std::size_t row) {
        for (int column = 0; column < map.columns; ++column)
            if (map.has_data(column, int(row))) {
                const double wanted = deviation(map.position(column, int(row)));
                out[map.index(column, int(row))] = float(wanted > 0 ? std::min(wanted, most) : 0.0);
            }
    });
    return out;
}

} // namespace

HeightMap smooth_heights(const HeightMap& map, const std::function<double(const dvec3&)>& deviation)
{
    const std::vector<float> wanted = deviations_of(map, deviation);
    float least = std::numeric_limits<float>::infinity(), most = 0;
    for (const float d : wanted)
        if (d > 0)
            least = std::min(least, d), most = std::max(most, d);
    HeightMap result = map;
    if (most == 0)
        return result;
    HeightMap filled = map;
    fill_no_data(filled);
    const Smoother smoother(std::move(filled));
    // Between two Gaussians the mean of heights changes as the variance does (the heat equation, to first order).
    float below = 0, above = std::max(least, 0.5f * float(std::min(map.spacing.x, map.spacing.y)));
    std::vector<float> finer = smoother.map().heights, wider = smoother.smoothed(double(above));
    for (;;) {
        parallel_each(wanted.size(), grain_samples, [&](std::size_t i) {
            if (wanted[i] > below && wanted[i] <= above && !std::isnan(map.heights[i])) {
                const float share = (wanted[i] * wanted[i] - below * below) / (above * above - below * below);
                result.heights[i] = finer[i] + share * (wider[i] - finer[i]);
            }
        });
        if (above >= most)
            return result;
        below = above, above = 2 * above;
        finer = std::move(wider), wider = smoother.smoothed(double(above));
    }
}

} // namespace limn
