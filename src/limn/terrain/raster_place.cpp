#include "limn/terrain/raster_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <proj.h>

#include "limn/base/error.h"

namespace limn {
namespace {

constexpr double degree = std::numbers::pi / 180;
/// A projection's stretch below this is that of a good map, and left as it is.
constexpr double small_stretch = 0.01;

/// Affine map from columns and rows to coordinates, of the corners of pixels.
struct GeoTransform {
    std::array<double, 6> c = {0, 1, 0, 0, 0, -1};

    dvec2 at(double column, double row) const { return {c[0] + c[1] * column + c[2] * row, c[3] + c[4] * column + c[5] * row}; }
    dvec2 column_step() const { return {c[1], c[4]}; }
    dvec2 row_step() const { return {c[2], c[5]}; }
    double turn() const { return c[1] * c[5] - c[2] * c[4]; } ///< below 0 where rows run clockwise of columns, as on a map

    void flip_columns(int columns)
    {
        const dvec2 corner = at(columns, 0);
        c = {corner.x, -c[1], c[2], corner.y, -c[4], c[5]};
    }
    void flip_rows(int rows)
    {
        const dvec2 corner = at(0, rows);
        c = {corner.x, c[1], -c[2], corner.y, c[4], -c[5]};
    }
};

bool is_usable(const GeoTransform& transform)
{
    return std::all_of(transform.c.begin(), transform.c.end(), [](double v) { return std::isfinite(v); }) && transform.turn() != 0;
}

/// Turns the transform so that columns run east and rows south.
void turn_north_up(GeoTransform& transform, const ivec2& size, RasterPlace& place)
{
    place.flip_columns = transform.c[1] < 0;
    if (place.flip_columns)
        transform.flip_columns(size.x);
    place.flip_rows = transform.c[5] > 0;
    if (place.flip_rows)
        transform.flip_rows(size.y);
    if (transform.turn() > 0) { // mirrored, and turned by so much that the signs do not show it
        place.flip_rows = !place.flip_rows;
        transform.flip_rows(size.y);
    }
    const double angle = std::atan2(transform.c[4], transform.c[1]) / degree;
    if (transform.c[2] != 0 || transform.c[4] != 0)
        place.notes.push_back(
            fmt::format("the raster is turned by {:.2f} degrees in its system; its columns are taken as running east", angle));
}

void take_height_unit(const OGRSpatialReference& system, RasterPlace& place)
{
    if (!system.IsCompound() && !system.IsVertical())
        return;
    const char* name = nullptr;
    place.height_unit = system.GetTargetLinearUnits("VERT_CS", &name);
    place.height_unit_name = name ? name : "";
}

void check_latitudes(const GeoTransform& transform, const ivec2& size, double unit, const std::string& file)
{
    constexpr double most = 90.001; // global rasters place the poles' pixels a rounding beyond them
    for (const dvec2& corner : {transform.at(0, 0), transform.at(size.x, 0), transform.at(0, size.y), transform.at(size.x, size.y)})
        if (std::abs(corner.y * unit / degree) > most)
            throw Error::Read(fmt::format("{}: its coordinate system is in degrees, but a corner lies at latitude {:.6g}; say --crs", file,
                                          corner.y * unit / degree));
}

std::string spacing_text(const dvec2& spacing) { return fmt::format("{:.6g} x {:.6g} m", spacing.x, spacing.y); }

void note_conversion(const GroundMeasure& measure, const GeoTransform& transform, const dvec2& middle, RasterPlace& place)
{
    const dvec2 steps = {glm::length(transform.column_step()), glm::length(transform.row_step())};
    const std::string of = fmt::format("steps of {:.8g} x {:.8g} {}", steps.x, steps.y, measure.unit_name());
    if (measure.in_angles())
        place.notes.push_back(fmt::format("{} converted to {}, at latitude {:.4f} degrees", of, spacing_text(place.spacing),
                                          middle.y * measure.unit() / degree));
    else if (const double stretch = measure.stretch(middle, transform.column_step()); stretch != 1)
        place.notes.push_back(fmt::format("{} converted to {}: {} stretches lengths there by {:.3f}", of, spacing_text(place.spacing),
                                          place.system, stretch));
    else if (measure.unit() != 1)
        place.notes.push_back(fmt::format("{} converted to {}", of, spacing_text(place.spacing)));
}

/// Coordinates without a system are taken as metres; where they could be degrees the note says how to tell.
std::string note_no_system(const GeoTransform& transform, const ivec2& size)
{
    const dvec2 a = transform.at(0, 0), b = transform.at(size.x, size.y);
    const double longest_step = std::max(glm::length(transform.column_step()), glm::length(transform.row_step()));
    const bool could_be_degrees =
        std::max(std::abs(a.x), std::abs(b.x)) <= 360 && std::max(std::abs(a.y), std::abs(b.y)) <= 90 && longest_step < 0.1;
    return std::string("no coordinate system: its units are taken as metres") +
           (could_be_degrees ? "; if they are degrees, say --crs EPSG:4326" : "");
}

/// The definition, as WKT, of the system that PROJ's database has under exactly this name; GDAL does not look for names. "" where there is none.
std::string definition_of(const std::string& name)
{
    const std::unique_ptr<PJ_CONTEXT, decltype(&proj_context_destroy)> context(proj_context_create(), proj_context_destroy);
    proj_log_level(context.get(), PJ_LOG_NONE);
    const std::unique_ptr<PJ, decltype(&proj_destroy)> found(proj_create(context.get(), name.c_str()), proj_destroy);
    if (!found || !proj_is_crs(found.get()) || proj_get_name(found.get()) != name) // PROJ takes parts of names, too
        return "";
    const char* const text = proj_as_wkt(context.get(), found.get(), PJ_WKT2_2019, nullptr);
    return text ? text : "";
}

} // namespace

GroundMeasure::GroundMeasure(const OGRSpatialReference& system)
{
    if (system.IsEmpty())
        return;
    const char* name = nullptr;
    in_angles_ = system.IsGeographic();
    unit_ = in_angles_ ? system.GetAngularUnits(&name) : system.GetLinearUnits(&name);
    unit_name_ = name ? name : "";
    semi_major_ = system.GetSemiMajor();
    const double flattening = system.GetInvFlattening() > 0 ? 1 / system.GetInvFlattening() : 0;
    eccentricity_squared_ = flattening * (2 - flattening);
    if (!system.IsProjected())
        return;
    OGRSpatialReference flat = system;
    flat.StripVertical();
    const std::unique_ptr<OGRSpatialReference> geographic(flat.CloneGeogCS());
    if (!geographic)
        return;
    flat.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    geographic->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    geographic_unit_ = geographic->GetAngularUnits();
    to_geographic_ = OGRCreateCoordinateTransformation(&flat, geographic.get());
}

GroundMeasure::~GroundMeasure() { OGRCoordinateTransformation::DestroyCT(to_geographic_); }

double GroundMeasure::metres_of_angles(const dvec2& middle, const dvec2& step, double radians) const
{
    const double sine = std::sin(middle.y * radians), w = 1 - eccentricity_squared_ * sine * sine;
    const double prime_vertical = semi_major_ / std::sqrt(w), meridian = prime_vertical * (1 - eccentricity_squared_) / w;
    return radians * std::hypot(prime_vertical * std::cos(middle.y * radians) * step.x, meridian * step.y);
}

double GroundMeasure::stretch(const dvec2& middle, const dvec2& step) const
{
    constexpr double steps = 32; // long enough that rounding of the angles does not show
    if (!to_geographic_)
        return 1;
    std::array<double, 2> x = {middle.x - steps * step.x, middle.x + steps * step.x},
                          y = {middle.y - steps * step.y, middle.y + steps * step.y};
    if (!to_geographic_->Transform(2, x.data(), y.data()))
        return 1;
    const dvec2 between = {0.5 * (x[0] + x[1]), 0.5 * (y[0] + y[1])};
    const double ground = metres_of_angles(between, {x[1] - x[0], y[1] - y[0]}, geographic_unit_);
    const double found = 2 * steps * unit_ * glm::length(step) / ground;
    return std::isfinite(found) && std::abs(found - 1) > small_stretch ? found : 1;
}

double GroundMeasure::metres(const dvec2& middle, const dvec2& step) const
{
    return in_angles_ ? metres_of_angles(middle, step, unit_) : unit_ * glm::length(step) / stretch(middle, step);
}

OGRSpatialReference raster_system(GDALDataset& dataset, const std::string& crs)
{
    OGRSpatialReference system;
    if (!crs.empty()) {
        if (!find_system(crs, system))
            throw Error::Input(fmt::format("--crs: '{}' is no coordinate system that PROJ knows; say for example EPSG:32611", crs));
    } else if (const OGRSpatialReference* own = dataset.GetSpatialRef()) {
        system = *own;
    }
    system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return system;
}

RasterPlace place_raster(GDALDataset& dataset, const std::string& crs, const std::string& file)
{
    const gdal::Reports reports;
    const ivec2 size = {dataset.GetRasterXSize(), dataset.GetRasterYSize()};
    OGRSpatialReference system = raster_system(dataset, crs);
    RasterPlace place;
    take_height_unit(system, place);
    place.height_unit_was_asked = !crs.empty() && place.height_unit > 0;
    GeoTransform transform;
    if (dataset.GetGeoTransform(transform.c.data()) != CE_None) {
        place.notes.push_back("no georeference: the spacing is taken as 1 m");
        return place;
    }
    if (!is_usable(transform))
        throw Error::Read(fmt::format("{}: its georeference has steps that are zero, parallel or no numbers", file));
    turn_north_up(transform, size, place);
    place.system = system_name(system);
    if (system.IsEmpty())
        place.notes.push_back(note_no_system(transform, size));
    const GroundMeasure measure(system);
    if (measure.in_angles())
        check_latitudes(transform, size, measure.unit(), file);
    const dvec2 middle = transform.at(0.5 * size.x, 0.5 * size.y);
    place.spacing = {measure.metres(middle, transform.column_step()), measure.metres(middle, transform.row_step())};
    if (!(place.spacing.x > 0 && place.spacing.y > 0 && std::isfinite(place.spacing.x + place.spacing.y)))
        throw Error::Read(fmt::format("{}: its steps are {} long on the ground; say --crs", file, spacing_text(place.spacing)));
    place.origin = transform.at(0.5, size.y - 0.5); // GDAL's transforms place corners, a sample is at its pixel's centre
    place.in_metres_or_angles = measure.in_angles() || measure.unit() == 1;
    note_conversion(measure, transform, middle, place);
    return place;
}

bool find_system(const std::string& text, OGRSpatialReference& system)
{
    const gdal::Reports quiet;
    const char* const only_text[] = {"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr};
    const std::string named = definition_of(text);
    return system.SetFromUserInput((named.empty() ? text : named).c_str(), only_text) == OGRERR_NONE;
}

std::string system_name(const OGRSpatialReference& system)
{
    if (system.IsEmpty() || system.IsLocal())
        return "";
    const std::string name = system.GetName() ? system.GetName() : "";
    const char* const datum = system.GetAttrValue("GEOGCS");
    int north = 0;
    const int zone = system.GetUTMZone(&north);
    if (!name.empty() && name != "unnamed" && name != "unknown")
        return name;
    if (zone > 0)
        return fmt::format("{} / UTM zone {}{}", datum ? datum : "unknown", zone, north ? "N" : "S");
    const char* const projection = system.GetAttrValue("PROJECTION");
    return fmt::format("{}{}{}", datum ? datum : "unknown", projection ? " / " : "", projection ? projection : "");
}

} // namespace limn
