#pragma once

#include <string>

#include "limn/lines/line_model.h"
#include "limn/terrain/terrain_build.h"

/// The places of a coarse mesh, for a camera to be fitted around.
limn::LineModel places_of(const limn::Mesh& mesh);

/// A mesh as it is written: millimetres for a print, metres else.
/// @param print_size  of its longer side, mm; 0: metres
/// @param base        how far under its lowest point a floor is, mm or metres; 0: none
limn::Mesh for_file(limn::Mesh mesh, double print_size, double base);

std::string unit_of(const limn::TerrainBound& bound);

/// What --error-report prints.
std::string error_lines(const limn::BuiltTerrain& terrain);
