#include "limn/pattern/cusp.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace limn {

vec3 cusp_colour(float share)
{
    static constexpr std::array<float, 3> stops[] = {{0.16f, 0.24f, 0.55f}, {0.12f, 0.49f, 0.66f}, {0.25f, 0.68f, 0.5f},
                                                     {0.94f, 0.86f, 0.36f}, {0.93f, 0.52f, 0.22f}, {0.75f, 0.15f, 0.16f}};
    constexpr int last = int(std::size(stops)) - 1;
    const float place = std::clamp(share, 0.0f, 1.0f) * float(last);
    const int k = std::min(int(place), last - 1);
    const auto colour = [](const std::array<float, 3>& c) { return vec3(c[0], c[1], c[2]); };
    return glm::mix(colour(stops[k]), colour(stops[k + 1]), place - float(k));
}

std::string CuspHistogram::line() const
{
    return fmt::format("cusps to {:.3g} mm, mean {:.3g}, half of the surface below {:.3g}", most, mean, middle);
}

CuspHistogram cusp_histogram(const std::vector<float>& heights, const std::vector<float>& areas, double most, int bins)
{
    CuspHistogram histogram;
    histogram.most = most;
    histogram.shares.assign(std::size_t(bins), 0);
    double area = 0;
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const int bin = std::clamp(int(double(heights[i]) / most * bins), 0, bins - 1);
        histogram.shares[std::size_t(bin)] += double(areas[i]);
        histogram.mean += double(heights[i]) * double(areas[i]);
        area += double(areas[i]);
    }
    if (!(area > 0))
        return histogram;
    histogram.mean /= area;
    double below = 0;
    for (int k = 0; k < bins; ++k) {
        double& share = histogram.shares[std::size_t(k)];
        share /= area;
        if (below < 0.5 && below + share >= 0.5)
            histogram.middle = most * (k + (0.5 - below) / share) / bins;
        below += share;
    }
    return histogram;
}

} // namespace limn
