#pragma once

#include <string>

#include "limn/terrain/terrain_build.h"
#include "views.h"

/// The camera of the options, or of their usual view, around a coarse mesh: in the middle of the picture where nothing else is said.
Sheet place_terrain_camera(ViewOptions view, const limn::Mesh& coarse);

/// A mesh as it is written: millimetres for a print, metres else.
/// @param print_size  of its longer side, mm; 0: metres
/// @param base        how far under its lowest point a floor is, mm or metres; 0: none
limn::Mesh for_file(limn::Mesh mesh, double print_size, double base);

std::string unit_of(const limn::TerrainBound& bound);

/// What --error-report prints.
std::string error_lines(const limn::BuiltTerrain& terrain);
