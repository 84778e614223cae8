#pragma once

#include <functional>

#include "limn/base/image.h"
#include "limn/base/options.h"
#include "limn/camera/camera.h"
#include "limn/geometry/mesh.h"
#include "limn/terrain/height_map.h"

namespace limn {

/// The upward unit normal of the ground at a place on a mesh in the map's own coordinates; asked for by many threads at once.
using GroundNormal = std::function<dvec3(const dvec3&)>;
/// Its colour there, RGBA: encoded (sRGB), and how much of it is over the usual one.
using GroundColour = std::function<vec4(const dvec3&)>;

/// How a picture of a terrain is coloured.
struct TerrainPictureOptions {
    enum class Colours {
        tint, ///< by height: green lowlands, brown slopes, white summits
        plain ///< one light grey
    } colours = Colours::tint;
    double sun_azimuth = 315;  ///< degrees from north, clockwise, where the light comes from
    double sun_height = 45;    ///< degrees above the horizon, 0 to 90
    int samples = 3;           ///< rays along each side of a pixel, 1 to 16
    vec3 background = vec3(1); ///< encoded (sRGB)
};

/// The colour of ground that is coloured plainly, encoded.
constexpr vec3 plain_ground = vec3(0.9f);

/// The unit vector towards the sun.
vec3 sun_direction(const TerrainPictureOptions& options);

/// The options as data: colours, sun and samples.
const OptionTable<TerrainPictureOptions>& terrain_picture_option_table();

/// A shaded picture, RGB, of the camera's size: the mesh as it is, with the light of the map's own slopes (central differences of the samples,
/// interpolated between them), so that triangles do not show. Multi-threaded; same bytes for any number of threads.
/// @param mesh  over the map, as terrain_mesh() makes it
/// @param drape  RGBA over the map's rectangle (read_drape), which takes the place of the ground's colour as far as its alpha says; or null
/// @throws Error::Input for a number out of its range, Error::Device when Embree cannot build the scene
Image paint_terrain(const HeightMap& map, const Mesh& mesh, const Camera& camera, const TerrainPictureOptions& options = {}, const Image* drape = nullptr);

/// The same with normals of the ground that come from elsewhere, and as it may be with its colours.
/// @param colour  RGBA; empty: those of the options
Image paint_terrain(const GroundNormal& normal, const Mesh& mesh, const Camera& camera, const TerrainPictureOptions& options = {}, const GroundColour& colour = {});

/// Where a place in the map's own coordinates is on a drape: 0 to 1 from its western to its eastern border, and from its northern to its southern.
dvec2 drape_place(const HeightMap& map, const dvec2& place);
/// The drape's colour there (RGBA), linear between the middles of its pixels.
vec4 draped_at(const HeightMap& map, const Image& drape, const dvec2& place);

/// The upward unit normal of the map at a place in its own coordinates, which is moved onto the map where it is outside.
/// Straight up where nothing around has data.
dvec3 terrain_normal(const HeightMap& map, const dvec2& place);

} // namespace limn
