#pragma once

#include <array>
#include <string>
#include <string_view>

#include "limn/base/options.h"
#include "limn/drawing/drawing.h"

namespace limn {

/// The ready-made looks (contour-lines specification 2.11).
enum class Look : std::uint8_t {
    plain,    ///< black lines on white, highlights light grey
    coloured, ///< a colour for each line type
    dark,     ///< a dark shape with black lines and white highlights
    toon      ///< black and white areas: suggestive contours show on white, highlights on black
};

enum class StrokeMode : std::uint8_t {
    line,   ///< one path of constant width for each stroke; ink as opacity in steps
    outline ///< a filled outline for each stroke, whose width follows the ink and tapers at free ends
};

/// How lines of one type are drawn.
struct LineStyle {
    double width_mm = 0.35;
    vec3 colour = vec3(0); ///< encoded (sRGB) RGB in [0,1]
    double opacity = 1;
};

/// Black lines with the widths that suit an A4 page: contours 0.5 mm, suggestive contours 0.35 mm.
std::array<LineStyle, line_type_count> default_lines();

/// A sheet of paper. Without one the page is the picture, at 96 pixels to the inch.
struct Page {
    double width_mm = 0, height_mm = 0; ///< 0: no page
    bool turns = true;                  ///< portrait or landscape, as the picture needs it
    bool empty() const { return width_mm == 0; }
};

/// "none", "A5", "A4", "A3", "A2", "Letter", "Legal" (any case; with "-portrait" or "-landscape" they do not turn) or "WxHmm".
/// @throws Error::Input naming the text and the known ones.
Page page_from_text(std::string_view text);
std::string page_text(const Page& page);

/// An encoded colour from "#rrggbb". @throws Error::Input naming the option and the text.
vec3 colour_from_text(std::string_view option, std::string_view text);
std::string colour_text(const vec3& colour);

/// Everything about paper, pens and colours. Widths are in mm on the page.
struct Style {
    Style() { set_look(Look::plain); }
    explicit Style(Look wanted) { set_look(wanted); }

    Look look = Look::plain;
    StrokeMode stroke = StrokeMode::line;
    bool curves = true;            ///< strokes as cubic Béziers; otherwise polylines
    double curve_tolerance = 0.25; ///< px, between a stroke and its curve
    double taper_mm = 4;           ///< StrokeMode::outline: length over which a free end swells to its width
    std::array<LineStyle, line_type_count> lines = default_lines();
    vec3 paper = vec3(1);
    vec3 shape = vec3(1);          ///< fill of the silhouette, and the base colour for a shaded background
    double hidden_width = 0.5;     ///< of the width of the type, for hidden strokes
    double hidden_opacity = 0.7;
    double dash_mm = 1.4, dash_gap_mm = 1.0; ///< of hidden strokes; dash 0: not dashed
    Page page;
    double margin_mm = 10;         ///< free border of a page

    LineStyle& line(LineType type) { return lines[std::size_t(type)]; }
    const LineStyle& line(LineType type) const { return lines[std::size_t(type)]; }

    /// Sets the colours of all types, of the paper and the shape; widths stay.
    void set_look(Look wanted);
    /// Sets widths from "contour=0.5mm,suggestive=0.3"; "0.4mm" sets them all. @throws Error::Input naming the part.
    void set_widths(std::string_view text);
    /// Sets colours from "contour=#1a2b3c,crease=#888888"; "#000000" sets them all. @throws Error::Input naming the part.
    void set_colours(std::string_view text);
};

/// The options above as data, for the command line, help and scene files.
const OptionTable<Style>& style_option_table();

} // namespace limn
