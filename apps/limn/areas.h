#pragma once

#include "limn/drawing/style.h"
#include "limn/lines/regions.h"

/// A shaded picture under the lines.
enum class Shade { none, smooth, flat };

/// What lies under the lines.
struct AreaOptions {
    Shade shade = Shade::none;
    bool fill = false; ///< the silhouette, in the colour of the shape
};

/// Adds the areas and the background that options and look ask for. Dark looks always fill the silhouette, since their white
/// highlights show on nothing else.
void add_areas(limn::Drawing& drawing, const limn::SeenScene& scene, const AreaOptions& options, const limn::Style& style);
