#pragma once

#include "limn/drawing/drawing.h"
#include "limn/drawing/style.h"

namespace limn {

/// How the picture lies on the page. Page units are mm with a page or at true scale, and pixels of 1/96 inch otherwise.
struct PageLayout {
    double width = 0, height = 0; ///< of the page, page units
    double mm_per_unit = 1;
    double scale = 1;             ///< page units per pixel of the picture
    dvec2 corner = dvec2(0);      ///< upper left corner of the picture on the page

    dvec2 on_page(const dvec2& pixel) const { return corner + scale * pixel; }
    double units(double mm) const { return mm / mm_per_unit; }
};

/// Fits the picture into the page's margins, or puts it in its middle at true scale.
/// @throws Error::Input when the margins leave no room or, at true scale, the drawing is larger than the page.
PageLayout lay_out(const Drawing& drawing, const Style& style);

} // namespace limn
