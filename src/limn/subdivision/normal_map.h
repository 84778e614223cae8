#pragma once

#include "limn/base/image.h"
#include "limn/base/options.h"
#include "limn/subdivision/atlas.h"
#include "limn/subdivision/limit_shape.h"

namespace limn {

/// What stands around charts, where filtering reaches beyond their border.
enum class MapGutter : std::uint8_t {
    empty,     ///< nothing: for comparison
    nearest,   ///< the nearest texel of the chart
    continued, ///< two texels of what the neighbouring face holds there, unfolded, where the edge is smooth; then the nearest texel
};

/// What the directions in a normal map refer to.
enum class NormalSpace : std::uint8_t {
    object,  ///< the mesh's own axes
    tangent, ///< tangent, bitangent and normal of the mesh that is shaded (tangent_frames.h)
};

struct NormalMapOptions {
    int size = 1024; ///< texels along a side
    NormalSpace space = NormalSpace::object;
    ChartKind charts = ChartKind::pairs;
    int gap = 4;  ///< texels between charts: Atlas
    int bits = 8; ///< of the file's samples: 8 or 16
    bool alpha = false; ///< the file tells which texels lie in charts; without, it is RGB, as programs expect of normal maps
};

/// Rows "map-size", "space", "map-charts", "map-gap", "map-bits", "map-alpha".
const OptionTable<NormalMapOptions>& normal_map_option_table();

/// How the faces of a control mesh lie in a texture. Texture coordinates are interpolated linearly in subdivision, so one layout serves
/// every level.
struct MapLayout {
    std::vector<Chart> charts;
    Atlas atlas;
    std::vector<vec2> uvs;    ///< 3 per face of the control mesh
    std::vector<dvec3> limit; ///< the control mesh's vertices on the limit surface
};

/// @param limit  the control mesh's vertices on the limit surface
/// @throws Error::Input as pack_charts
MapLayout lay_out_map(const LoopTopology& topology, std::vector<dvec3> limit, const NormalMapOptions& options);

/// Normals of the limit surface as a picture (silhouette-loop specification, 2.10 to 2.12): a texel at the parameters (v,w) of a face holds the
/// limit normal there, exactly. Red, green and blue are (x,y,z) / 2 + 1/2; alpha is 1 in the texels whose middle lies in a chart (or the one
/// texel of a chart that is too small for that). The rest of each chart's cell in the atlas is its gutter; nothing of another chart is there.
struct NormalMap {
    Image texels;            ///< RGBA
    std::size_t covered = 0; ///< texels of alpha 1
};

/// Parallel; the same for any number of threads.
NormalMap object_space_map(const MapLayout& layout, const LimitShape& shape, MapGutter gutter = MapGutter::continued);

/// The map as a PNG file. @throws Error::Input for other bits than 8 or 16
std::string normal_map_png(const NormalMap& map, const NormalMapOptions& options);

/// For a mesh with exactly these texture coordinates and corner normals. A shader gets the normal back as
/// normalize(x T + y cross(N, T) + z N) with T and N interpolated linearly and not made unit.
/// @param mesh  the control mesh after `levels` steps, its corners' normals, and the layout's coordinates taken down to it
NormalMap tangent_space_map(const MapLayout& layout, const LimitShape& shape, const Mesh& mesh, int levels,
                           MapGutter gutter = MapGutter::continued);

} // namespace limn
