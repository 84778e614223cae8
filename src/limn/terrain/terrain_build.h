#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "limn/base/options.h"
#include "limn/camera/camera.h"
#include "limn/geometry/mesh.h"
#include "limn/terrain/height_map.h"
#include "limn/terrain/measure_terrain.h"

namespace limn {

/// How far a mesh may be from its height map: metres, or pixels of a picture.
struct TerrainBound {
    double value = 0;
    bool in_pixels = false;
};
/// "5m", "0.5 px" or "5" (metres). @throws Error::Input naming --max-error, the text and what can be
TerrainBound parse_terrain_bound(std::string_view text);

enum class TerrainMethod {
    strict,   ///< bisection with nested errors: the bound holds at every sample, in metres or pixels
    delaunay, ///< the fewest triangles for a bound in metres, which holds at every sample too
    par,      ///< the seed's parallel refinement, whose bound holds in the middles of edges only
};

struct TerrainBuildOptions {
    TerrainMethod method = TerrainMethod::strict;
    std::optional<TerrainBound> bound = {}; ///< none: a 500th of the relief
    std::size_t triangles = 0;         ///< strict only: the smallest bound in metres with at most so many; 0: `bound`
    double max_edge = 0;               ///< metres, in the plane: no hypotenuse (delaunay: edge) is longer, as far as samples allow; 0: any length
    double exaggerate = 1;             ///< heights are multiplied by it; bounds and what is measured stay true metres
};

/// The options as data, but for the bound.
const OptionTable<TerrainBuildOptions>& terrain_build_option_table();

struct BuiltTerrain {
    Mesh mesh;               ///< in the map's coordinates, heights exaggerated
    TerrainBound asked;      ///< the bound it was made for
    MeasuredTerrain measured; ///< against every sample, in the bound's unit (metres are true ones)
};

/// A 500th of the relief.
/// @param map  exaggerated() by the factor
TerrainBound usual_bound(const HeightMap& map, double exaggerate);

/// Heights times a factor. @throws Error::Input for a factor that is not above 0
HeightMap exaggerated(HeightMap map, double factor);

/// A mesh of a height map with a bound, and how far it really is from every sample.
/// @param map     exaggerated() already by the options' factor
/// @param camera  for bounds in pixels; in the exaggerated map's coordinates
/// @throws Error::Input for options that contradict each other or are out of range
BuiltTerrain build_terrain(const HeightMap& map, const TerrainBuildOptions& options, const std::optional<Camera>& camera = {});

/// Fills `measured` of a mesh in place: how far it is from every sample of the map, in the unit of the bound that was asked for.
/// @param map, exaggerate, camera  as for build_terrain()
void measure_built(const HeightMap& map, BuiltTerrain& built, double exaggerate, const std::optional<Camera>& camera = {});

} // namespace limn
