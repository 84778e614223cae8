#pragma once

// Where a raster lies and how long its steps are on the ground. Not for users of the library: it speaks of GDAL's types.

#include <string>
#include <vector>

#include <ogr_spatialref.h>

#include "limn/base/vec.h"
#include "limn/terrain/gdal.h"

namespace limn {

/// Measures steps of a coordinate system in metres on the ground.
class GroundMeasure {
public:
    /// @param system  geographic (degrees or another angle), projected or local (any linear unit), or empty: metres
    explicit GroundMeasure(const OGRSpatialReference& system);
    ~GroundMeasure();
    GroundMeasure(const GroundMeasure&) = delete;
    GroundMeasure& operator=(const GroundMeasure&) = delete;

    /// Metres that `step` is long about `middle`, both in the system's own units: in angles by the ellipsoid's radii of the meridian and of
    /// the prime vertical at that latitude (Snyder 1987, equations 4-18 to 4-20); in a projection by its linear unit, and where the
    /// projection stretches lengths there by more than 1 % (Web Mercator, far from the equator) without that stretch.
    double metres(const dvec2& middle, const dvec2& step) const;
    bool in_angles() const { return in_angles_; }
    double unit() const { return unit_; } ///< radians or metres
    const std::string& unit_name() const { return unit_name_; }
    /// How much longer `step` is in the projection than on the ground; 1 where that is not known, or less than 1 % off.
    double stretch(const dvec2& middle, const dvec2& step) const;

private:
    double metres_of_angles(const dvec2& middle, const dvec2& step, double radians) const;

    bool in_angles_ = false;
    double unit_ = 1, semi_major_ = 0, eccentricity_squared_ = 0, geographic_unit_ = 1;
    std::string unit_name_ = "metre";
    OGRCoordinateTransformation* to_geographic_ = nullptr; ///< of a projection
};

/// A raster's place as a HeightMap has it, and what a reader must do for it.
struct RasterPlace {
    dvec2 spacing = {1, 1}, origin = {0, 0};
    std::string system;
    bool flip_columns = false, flip_rows = false; ///< the file's columns run west, its rows north
    double height_unit = 0;                       ///< metres of the system's vertical unit; 0: it has none
    std::string height_unit_name;
    bool height_unit_was_asked = false; ///< `crs` names it, whatever the file says
    bool in_metres_or_angles = true;
    std::vector<std::string> notes; ///< what was converted or assumed, one line each
};

/// @param crs   overrides the file's own coordinate system, as OGRSpatialReference::SetFromUserInput takes it; "" leaves it
/// @throws Error::Input for a crs that is none; Error::Read for a place that makes no sense, naming `file`.
RasterPlace place_raster(GDALDataset& dataset, const std::string& crs, const std::string& file);

/// The system that `crs` names, or the raster's own one; empty where it has none. Coordinates are easting and northing, or longitude and latitude.
/// @throws Error::Input for a crs that is none
OGRSpatialReference raster_system(GDALDataset& dataset, const std::string& crs);

/// The coordinate system that a text names ("EPSG:32611", a PROJ string, "NAD27 / UTM zone 10N"); false where it names none.
bool find_system(const std::string& text, OGRSpatialReference& system);

/// The name of a system: "" of an empty or a local one.
std::string system_name(const OGRSpatialReference& system);

} // namespace limn
