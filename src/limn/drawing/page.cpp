#include "limn/drawing/page.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

constexpr double mm_per_css_pixel = 25.4 / 96;

/// Corners of what is drawn, in pixels.
std::pair<dvec2, dvec2> drawn_bounds(const Drawing& drawing)
{
    dvec2 low(1e300), high(-1e300);
    const auto see = [&](const dvec2& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    };
    for (const Stroke& stroke : drawing.strokes)
        std::for_each(stroke.points.begin(), stroke.points.end(), see);
    for (const Region& region : drawing.regions)
        for (const auto& ring : region.rings)
            std::for_each(ring.begin(), ring.end(), see);
    return {low, high};
}

void check_fits(const Drawing& drawing, const PageLayout& layout)
{
    const auto [low, high] = drawn_bounds(drawing);
    if (low.x > high.x)
        return;
    const dvec2 from = layout.on_page(low), to = layout.on_page(high);
    if (from.x < 0 || from.y < 0 || to.x > layout.width || to.y > layout.height)
        throw Error::Input(fmt::format("--page: the drawing is {:.1f} x {:.1f} mm at its true scale and does not lie on the page of {:g} x {:g} mm",
                                       to.x - from.x, to.y - from.y, layout.width, layout.height));
}

} // namespace

PageLayout lay_out(const Drawing& drawing, const Style& style)
{
    const dvec2 size = drawing.camera.size;
    PageLayout layout;
    if (style.page.empty() && drawing.mm_per_pixel <= 0) {
        layout = {size.x, size.y, mm_per_css_pixel, 1, dvec2(0)};
        return layout;
    }
    layout.scale = drawing.mm_per_pixel;
    if (style.page.empty()) {
        layout.width = size.x * layout.scale;
        layout.height = size.y * layout.scale;
        return layout;
    }
    dvec2 page(style.page.width_mm, style.page.height_mm);
    if (style.page.turns && (size.x > size.y) != (page.x > page.y))
        std::swap(page.x, page.y);
    layout.width = page.x;
    layout.height = page.y;
    const dvec2 room = page - 2 * style.margin_mm;
    if (!(room.x > 0 && room.y > 0))
        throw Error::Input(fmt::format("--margin: {} mm leave no room on a page of {:g} x {:g} mm", style.margin_mm, page.x, page.y));
    if (layout.scale <= 0)
        layout.scale = std::min(room.x / size.x, room.y / size.y);
    layout.corner = (page - layout.scale * size) / 2.0;
    if (drawing.mm_per_pixel > 0)
        check_fits(drawing, layout);
    return layout;
}

} // namespace limn
