#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "limn/geometry/write_mesh.h"
#include "limn/terrain/read_drape.h"

/// --drape.
void add_drape_option(CLI::App& app, std::string& file);

/// Gives a mesh over a map the drape's colours: glb a texture with its coordinates, ply and obj a colour for each vertex. Other formats have none.
void drape_mesh(limn::Mesh& mesh, const limn::HeightMap& map, const limn::Drape& drape, limn::WriteMeshOptions& options);
