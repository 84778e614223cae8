#pragma once

#include <optional>
#include <vector>

#include "limn/drawing/style.h"
#include "limn/lines/regions.h"
#include "limn/raycast/material.h"

/// A shaded picture under the lines.
enum class Shade { none, smooth, flat };

/// What lies under the lines.
struct AreaOptions {
    Shade shade = Shade::none;
    bool fill = false; ///< the silhouette, in the colour of the shape
    // Of the shaded picture, where a scene says it.
    std::optional<limn::dvec3> to_light, lamp;
    std::vector<limn::Material> materials; ///< of its objects; empty: all have shape_material
};

/// What a shape looks like in a shaded picture under lines.
limn::Material shape_material(const limn::Style& style);

/// Adds the areas and the background that options and look ask for. Dark looks always fill the silhouette, since their white
/// highlights show on nothing else.
void add_areas(limn::Drawing& drawing, const limn::SeenScene& scene, const AreaOptions& options, const limn::Style& style);
