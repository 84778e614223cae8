#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "limn/base/options.h"
#include "limn/drawing/drawing.h"
#include "limn/geometry/mesh.h"
#include "limn/lines/draw.h"
#include "limn/lines/options.h"
#include "limn/terrain/height_map.h"

namespace limn {

/// The distance in height from one iso line to the next.
struct IsoStep {
    double value = 0;     ///< 0: no iso lines
    bool in_feet = false; ///< of 0.3048 m
    double metres() const { return in_feet ? 0.3048 * value : value; }
};
/// "50m", "200ft", "50" (metres), "0" (none). @throws Error::Input naming --iso, the text and what can be
IsoStep iso_step_from_text(std::string_view text);
std::string iso_step_text(const IsoStep& step);

/// How a terrain is drawn in lines.
struct TerrainLineOptions {
    LineOptions lines;      ///< the lines of its shape
    /// Pixels: what is narrower is left out before lines are drawn (generalised_for); 0: nothing is. None: 4, or 1 where the camera looks
    /// straight down on iso lines alone.
    std::optional<double> generalise;
    IsoStep iso;            ///< iso lines, if any
    int iso_heavy = 5;      ///< every so many of them are heavier, counted from height 0; 0: none
    double iso_text = 8;    ///< pixels: height of the figures in heavy iso lines (iso_labels.h), in metres or feet as the step is; 0: none
    double exaggerate = 1;  ///< by which the map's heights are multiplied; iso lines are of true heights

    TerrainLineOptions();
};

/// The options as data, but for the lines' own.
const OptionTable<TerrainLineOptions>& terrain_line_option_table();

/// The rows of line_option_table() that a terrain's drawing reads.
const OptionTable<LineOptions>& terrain_shape_line_table();

/// Whether a camera looks straight down on a map, without perspective: its picture is a plan, and differences of height do not show.
bool is_plan(const Camera& camera);

/// A map without what a camera shows narrower than some pixels, as illustrators draw it: smoothed by Gaussians whose deviation is as wide as
/// `options.generalise` at each place (smooth_heights). Where lines are drawn that need curvature it is at least two samples: below that,
/// curvature is the raster's noise. 0 pixels: the map itself.
HeightMap generalised_for(const HeightMap& map, const Camera& camera, const TerrainLineOptions& options);

/// How far heights were moved, metres, over all samples with data.
struct TerrainMove {
    double maximum = 0, rms = 0;
};
TerrainMove how_moved(const HeightMap& from, const HeightMap& to);

/// The longest hypotenuse, in metres, that triangles of a drawing should have, so that lines through them are smooth: one and a half
/// deviations of generalised_for() in the middle of the map, and no less than three samples.
double drawn_edge(const HeightMap& map, const Camera& camera, const TerrainLineOptions& options);

/// A line drawing of a terrain: its contours and other lines of shape with the map's own normals and curvatures (terrain_surface), and iso
/// lines of the map (iso_lines), hidden lines removed. Iso lines are hidden where the mesh under or above them is.
/// @param map   generalised_for() already
/// @param mesh  over that map, as terrain_mesh() makes it
/// @throws Error::Input for a step of iso lines that makes too many of them
Drawing draw_terrain(const HeightMap& map, const Mesh& mesh, const Camera& camera, const TerrainLineOptions& options, DrawReport* report = nullptr);

} // namespace limn
