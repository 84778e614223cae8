#include "limn/scene/cusp_legend.h"

#include <algorithm>

#include <fmt/format.h>

namespace limn {
namespace {

constexpr int margin = 16, bar_area = 60, strip = 10, letter = 10;

void fill(Image& image, int left, int top, int right, int bottom, const vec3& colour)
{
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x)
            for (int k = 0; k < 3; ++k)
                image.at(x, y)[k] = colour[k];
}

} // namespace

void add_cusp_legend(Drawing& drawing, const CuspHistogram& cusps)
{
    Image& image = drawing.background;
    const int bins = int(cusps.shares.size()), width = std::max(4, std::min(10, image.width / (3 * std::max(bins, 1))));
    const int low = image.height - margin - 2 * letter, top = low - strip - bar_area, right = margin + bins * width;
    if (bins == 0 || top < margin || right + margin > image.width)
        return;
    const double most = *std::max_element(cusps.shares.begin(), cusps.shares.end());
    for (int k = 0; k < bins; ++k) {
        const vec3 colour = cusp_colour((float(k) + 0.5f) / float(bins));
        const int high = most > 0 ? int(cusps.shares[std::size_t(k)] / most * bar_area + 0.5) : 0, left = margin + k * width;
        fill(image, left, low - strip, left + width, low, colour);
        fill(image, left, low - strip - high, left + width - 1, low - strip, colour);
    }
    const double base = image.height - margin;
    drawing.captions.push_back({{margin + 4.0, base}, letter, "0", 0});
    drawing.captions.push_back({{double(right), base}, letter, fmt::format("{:.3g} mm", cusps.most), 0});
}

} // namespace limn
