#pragma once

#include <optional>
#include <span>

#include "limn/terrain/surface_errors.h"
#include "limn/terrain/terrain_build.h"

namespace limn {

/// A mesh of leaves: vertices are on the surface, row by row, with its normals at the corners; triangles are counter-clockwise seen from above.
Mesh surface_mesh(const SurfaceErrors& errors, std::span<const BisectionTriangle> triangles);

/// The coarsest mesh of the hierarchy with no point of the surface further than `tolerance` metres, along z, from it; where `levels` do not suffice,
/// the finest one. @throws Error::Input for a tolerance that is not above 0
Mesh surface_mesh_within(const SurfaceErrors& errors, double tolerance);

/// The same in the picture: no point of the surface is drawn further than so many pixels from its place.
Mesh surface_mesh_in_view(const SurfaceErrors& errors, const Camera& camera, double pixels);

/// build_terrain() for the surface between the samples, with the same options but `triangles` and with --method strict alone; measured against points
/// of the surface on a lattice up to 8 times finer than the samples, 20 million at most.
/// @throws Error::Input for a bound that is not above 0, and options that do not go with it
BuiltTerrain build_surface_terrain(const HeightSurface& surface, const TerrainBuildOptions& options, const std::optional<Camera>& camera = {});

} // namespace limn
