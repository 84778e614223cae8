#pragma once

#include <string>
#include <vector>

#include "limn/scene/terrain_picture.h"
#include "status.h"

/// What a user sets in the panel of a terrain's window.
struct TerrainSettings {
    double pixels = 1;                   ///< the bound, 0 or more
    double exaggerate = 1;               ///< above 0
    limn::TerrainPictureOptions picture; ///< colours, sun, background
    bool marks = true, mesh_lines = false;
};

/// What the panel tells.
struct PanelFacts {
    BoundStatus bound;
    std::vector<std::string> lines; ///< more of it
    bool can_retry = false;
};

/// Shows the panel, and changes the settings as its user says.
/// @return whether what could not be read is to be tried again
bool show_panel(TerrainSettings& settings, const PanelFacts& facts);
