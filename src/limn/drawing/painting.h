#pragma once

#include <string>
#include <vector>

#include "limn/drawing/fit.h"
#include "limn/drawing/page.h"

namespace limn {

/// A line of straight and cubic pieces, in page units.
struct Path {
    dvec2 start;
    std::vector<CurveSpan> spans; ///< `last` has no meaning here
    bool closed = false;
};

/// One thing to paint in its layer's colour: a stroke, a piece of one, or a filled area (several rings).
struct Mark {
    std::vector<Path> paths;
    double opacity = 1;
    bool butt_caps = false; ///< a piece of a fading stroke: round ends would overlap its neighbours and show as beads
};

/// Marks with the same look.
struct Layer {
    std::string id, label;      ///< "suggestive", "Suggestive contours"
    vec3 colour = vec3(0);
    double opacity = 1;         ///< of the layer as a whole
    double width = 0;           ///< of its strokes, page units; 0: areas filled
    bool even_odd = false;      ///< fill rule; otherwise non-zero winding
    double dash = 0, gap = 0;   ///< page units; 0: not dashed
    std::vector<Mark> marks;
};

/// What lies on the page, bottom first: the one description that SVG, PDF and PNG writers put into their formats.
struct Painting {
    PageLayout page;
    vec3 paper = vec3(1);
    const Image* background = nullptr; ///< lies where the picture lies, or null; belongs to the drawing
    std::vector<Layer> layers;
};

/// Turns a drawing into layers: fills, then hidden strokes, then visible ones (types in the order of LineType), then
/// captions. Strokes of a layer are in pen order (pen_order.h). The drawing must outlive the result.
Painting compose(const Drawing& drawing, const Style& style = {});

/// The visible title of a type: "Suggestive contours".
std::string_view line_type_label(LineType type);

} // namespace limn
