#pragma once

#include <string>

#include "limn/terrain/terrain_pyramid.h"

/// What a pyramid of 'limn terrain build' holds, from its directory; its tiles are checked when they are read. Both end with a line end.
std::string pyramid_text(const limn::TerrainPyramid& pyramid);
std::string pyramid_json(const limn::TerrainPyramid& pyramid, const std::string& file, double seconds);
