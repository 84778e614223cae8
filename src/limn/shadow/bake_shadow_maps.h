#pragma once

#include <functional>

#include "limn/base/options.h"
#include "limn/shadow/map_painter.h"
#include "limn/shadow/shadow_maps.h"

namespace limn {

struct BakeOptions {
    int maps = 4096;        ///< about so many, 1 to most_maps; what the grid has in the end is nearest to it
    ivec2 cells = {0, 0};   ///< of the grid of directions, 1 to most_cells along each side; 0: as `maps` tells
    int resolution = 128;   ///< texels along a side of a map, 1 to largest_map
    DirectionSpread spread = DirectionSpread::even;
    MapOrder order = MapOrder::theta_zigzag; ///< of the codec `segments`; bricks have none
    ShadowCodec codec = ShadowCodec::bricks;
    double margin = 0.05;   ///< 0 to below 0.5: the part of the way between both surfaces that depths keep from each; 0 compresses best, more
                            ///< shades the object itself better
    OpenBack back = OpenBack::sphere;
};

/// Makes what draws an object's maps, as processor_painter().
using MakePainter = std::function<std::unique_ptr<MapPainter>(const ShadowCaster& caster, int size, OpenBack back)>;

/// The options as data.
const OptionTable<BakeOptions>& bake_option_table();

/// The grid that the options ask for: of `maps`, as a square; for bricks on a sphere with poles up to four times as many along theta, in which maps
/// change less from one to the next, but 32 along phi at least where there are as many. @throws Error::Input for options out of range
DirectionGrid bake_grid(const BakeOptions& options);

/// Draws an object from every direction and compresses that, map by map: no more than a few maps are in memory beside what is compressed.
/// The same bytes for any number of threads.
/// @param painter   makes what draws the maps of an object; else the processor does
/// @param progress  is told which part is done, in [0, 1]; baking is given up when it throws
/// @throws Error::Input for options out of range, a mesh without triangles, or one whose vertices are all in one place or too far from each other
ShadowMaps bake_shadow_maps(const Mesh& mesh, const BakeOptions& options, const std::function<void(double)>& progress = {}, const MakePainter& painter = {});

} // namespace limn
