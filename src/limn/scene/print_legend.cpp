#include "limn/scene/print_legend.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "limn/drawing/lettering.h"
#include "limn/pattern/cusp.h"

namespace limn {
namespace {

constexpr int margin = 16, capital = 10, swatch = 12, row = 20, scale_width = 160;

void fill(Image& image, int left, int top, int right, int bottom, const vec3& colour)
{
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x)
            for (int k = 0; k < 3; ++k)
                image.at(x, y)[k] = colour[k];
}

double width_of(const std::string& text)
{
    double most = 0; // from the middle
    for (const std::vector<dvec2>& line : letter(text))
        for (const dvec2& p : line)
            most = std::max(most, std::abs(p.x));
    return 2 * capital * most;
}

void add_left(Drawing& drawing, double left, double base, const std::string& text)
{
    drawing.captions.push_back({{left + 0.5 * width_of(text), base}, capital, text, 0});
}

} // namespace

void add_print_legend(Drawing& drawing, const PrintLegend& legend)
{
    Image& image = drawing.background;
    const int rows = int(legend.swatches.size()) + (legend.scale ? 2 : 0), top = image.height - margin - rows * row;
    double widest = legend.scale ? scale_width : 0;
    for (const PrintLegend::Swatch& s : legend.swatches)
        widest = std::max(widest, swatch + 6 + width_of(s.text));
    if (legend.empty() || top < margin || int(widest) + 2 * margin > image.width)
        return;
    int y = top;
    if (legend.scale) {
        for (int x = 0; x < scale_width; ++x)
            fill(image, margin + x, y, margin + x + 1, y + swatch, cusp_colour((float(x) + 0.5f) / scale_width));
        const std::string high = fmt::format("{:.3g} {}", legend.high, legend.unit);
        add_left(drawing, margin, y + row + capital, fmt::format("{:.3g}", legend.low));
        add_left(drawing, margin + scale_width - width_of(high), y + row + capital, high);
        y += 2 * row;
    }
    for (const PrintLegend::Swatch& s : legend.swatches) {
        fill(image, margin, y, margin + swatch, y + swatch, s.colour);
        add_left(drawing, margin + swatch + 6, y + swatch - 1, s.text);
        y += row;
    }
}

} // namespace limn
