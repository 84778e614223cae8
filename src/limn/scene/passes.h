#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limn/base/image.h"
#include "limn/drawing/drawing.h"
#include "limn/drawing/style.h"
#include "limn/lines/line_model.h"
#include "limn/raycast/gbuffer.h"

namespace limn {

/// The ingredient images of line drawings: one quantity at the centre of every pixel that shows the model.
enum class Pass : std::uint8_t {
    ndotv,    ///< cosine between normal and view, in [-1,1]
    kr,       ///< radial curvature, 1/world unit
    dwkr,     ///< its derivative along the projected view direction, 1/world unit^2
    k1, k2,   ///< principal curvatures, |k1| >= |k2|, 1/world unit
    depth,    ///< along the viewing direction, world units
    normal,   ///< unit vector in the world
    position, ///< in the world, world units
    id,       ///< number of the model, in the order in which they were given, counted from 1
    lines,    ///< how much of the pixel the drawn lines cover, in [0,1], whatever their colour; everywhere in the picture
};

/// "ndotv". Unit: "1/length" and so on, "" for pure numbers.
std::string_view pass_name(Pass pass);
std::string_view pass_unit(Pass pass);
/// Passes from "ndotv,kr,depth" or "all". @throws Error::Input naming the word and the known ones.
std::vector<Pass> passes_from_text(std::string_view text);
/// What of a surface the passes look at.
Need pass_need(std::span<const Pass> passes);

/// One pass of one picture. Pixels that show nothing are NaN (id: 0).
struct PassImage {
    Pass pass;
    Image values;               ///< 1 channel, or 3 for normal and position
    double low = 0, high = 0;   ///< the range that a file of whole numbers spreads over: fixed for ndotv and normal, else of the picture
};

/// The pass of lines: what a drawing's strokes cover.
PassImage lines_pass(const Drawing& drawing, const Style& style = {});

/// Every other pass. Quantities of curvature are computed at the corners and mixed within each face, as lines are extracted.
/// @throws Error::Input when the model has not what the pass needs.
PassImage make_pass(const LineModel& model, const GBuffer& seen, const Camera& camera, Pass pass);

/// The values as shares of the range for a 16-bit file: 0 is background, 1/65535 the low end and 1 the high one; ids as id/65535.
/// @throws Error::Input for an id above 65,535.
Image pass_for_whole_numbers(const PassImage& pass);

} // namespace limn
