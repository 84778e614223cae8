#include "views.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "fit_camera.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/options.h"
#include "limn/scene/scene.h"

using namespace limn;

namespace {

constexpr double css_mm_per_pixel = 25.4 / 96; // the pixel of SVG and CSS
constexpr ivec2 default_size = {1600, 1200};
constexpr double sheet_margin = 0.11; // leaves room for a caption
constexpr int largest_side = 1 << 15;
constexpr double farthest_look = 1e15; // model units; beyond it single precision squares no distance of the picture

ivec2 parse_size(const std::string& text)
{
    const std::size_t x = text.find('x');
    if (x == std::string::npos)
        throw Error::Input(fmt::format("--size: '{}' is not WIDTHxHEIGHT", text));
    const double width = parse_number("size", text.substr(0, x)), height = parse_number("size", text.substr(x + 1));
    if (!(width >= 1 && height >= 1 && width <= largest_side && height <= largest_side) || width != std::floor(width) ||
        height != std::floor(height))
        throw Error::Input(fmt::format("--size: '{}' is outside 1x1..{}x{}", text, largest_side, largest_side));
    return {int(width), int(height)};
}

dvec3 parse_point(const std::string& name, const std::string& text)
{
    const std::size_t first = text.find(','), second = first == std::string::npos ? first : text.find(',', first + 1);
    if (second == std::string::npos)
        throw Error::Input(fmt::format("--{}: '{}' is not x,y,z", name, text));
    return {parse_number(name, text.substr(0, first)), parse_number(name, text.substr(first + 1, second - first - 1)),
            parse_number(name, text.substr(second + 1))};
}

/// World units of the model that one millimetre on paper shows.
double units_per_paper_mm(const ViewOptions& options)
{
    static constexpr std::pair<std::string_view, double> units[] = {{"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}, {"ft", 304.8}};
    if (options.scale.rfind("1:", 0) != 0 || !(parse_number("scale", options.scale.substr(2)) > 0))
        throw Error::Input(fmt::format("--scale: '{}' is not 1:N with N above 0", options.scale));
    for (const auto& [name, mm] : units)
        if (name == options.unit)
            return parse_number("scale", options.scale.substr(2)) / mm;
    throw Error::Input(fmt::format("--unit: '{}' is none of mm|cm|m|in|ft", options.unit));
}

/// All corners of a box, through a camera.
template <class F> void each_corner(const Bounds& box, F&& f)
{
    for (int c = 0; c < 8; ++c)
        f(dvec3(c & 1 ? box.high.x : box.low.x, c & 2 ? box.high.y : box.low.y, c & 4 ? box.high.z : box.low.z));
}

/// World units that an orthographic picture's height must show to hold the box.
double height_for(const Camera& camera, const Bounds& bounds)
{
    double height = 0;
    each_corner(bounds, [&](const dvec3& p) {
        const dvec3 d = p - camera.eye;
        const double x = std::abs(dot(d, camera.right())), y = std::abs(dot(d, camera.above()));
        height = std::max({height, 2 * y, 2 * x * camera.size.y / camera.size.x});
    });
    return height > 0 ? height / (1 - 2 * Framing().margin) : 1;
}

Camera placed_camera(const ViewOptions& options, const Bounds& bounds, char up_axis, ivec2 size)
{
    Camera camera;
    camera.size = size;
    camera.fov_degrees = options.fov_degrees;
    camera.orthographic = options.orthographic || !options.scale.empty();
    camera.eye = parse_point("eye", options.eye);
    camera.look = options.look.empty() ? bounds.centre() : parse_point("look", options.look);
    camera.up = options.up.empty() ? up_vector(up_axis) : parse_point("up", options.up);
    const double distance = glm::distance(camera.eye, camera.look);
    if (!(distance > 0))
        throw Error::Input("--eye: the eye is where it looks; move --eye or --look");
    if (!(distance <= farthest_look))
        throw Error::Input(fmt::format("--eye: the eye is farther than {:.0e} from where it looks; move --eye or --look", farthest_look));
    if (camera.up == dvec3(0))
        throw Error::Input("--up: 0,0,0 is no direction");
    camera.ortho_height = height_for(camera, bounds);
    return camera;
}

Camera read_camera(const std::string& file)
{
    try {
        return camera_from_json(read_file(file));
    } catch (const Error::Input& error) {
        throw Error::Read(fmt::format("{}: {}", file, error.what()));
    }
}

/// Whether the options hold a whole camera.
bool is_whole(const ViewOptions& options) { return options.camera || !options.camera_file.empty(); }

Camera whole_camera(const ViewOptions& options)
{
    Camera camera = options.camera ? *options.camera : read_camera(options.camera_file);
    if (!options.size.empty())
        camera.size = parse_size(options.size);
    return camera;
}

/// Columns and rows of a sheet: as many of the one as of the other, or one more.
ivec2 grid_of(std::size_t pictures)
{
    const int columns = int(std::ceil(std::sqrt(double(pictures))));
    return {columns, (int(pictures) + columns - 1) / columns};
}

/// Puts pictures of equal size in rows.
void lay_out(Sheet& sheet)
{
    const ivec2 grid = grid_of(sheet.cameras.size()), picture = sheet.cameras.front().size;
    for (int i = 0; i < int(sheet.cameras.size()); ++i)
        sheet.corners.push_back(picture * ivec2(i % grid.x, i / grid.x));
    sheet.size = picture * grid;
}

std::vector<Camera> framed_cameras(const ViewOptions& options, const Subject& subject, char up_axis, ivec2 picture)
{
    std::vector<Camera> cameras;
    const std::vector<std::string> views = options.views.empty() ? std::vector<std::string>{Framing().view} : options.views;
    for (const std::string& view : views)
        cameras.push_back(Camera::framing(subject.bounds, {.view = view,
                                                           .up_axis = up_axis,
                                                           .size = picture,
                                                           .fov_degrees = options.fov_degrees,
                                                           .orthographic = options.orthographic || !options.scale.empty()}));
    fit_cameras(cameras, subject.model, options.views.size() > 1 ? sheet_margin : Framing().margin);
    return cameras;
}

/// Sets the height of orthographic cameras so that the paper shows 1:N; without --size the pictures grow to hold the model.
void apply_scale(const ViewOptions& options, const Bounds& bounds, Sheet& sheet)
{
    const double units_per_pixel = units_per_paper_mm(options) * css_mm_per_pixel;
    sheet.mm_per_pixel = css_mm_per_pixel;
    if (options.size.empty()) {
        dvec2 need(1);
        for (Camera& camera : sheet.cameras) {
            camera.size = {1, 1};
            need = glm::max(need, dvec2(height_for(camera, bounds) / units_per_pixel));
        }
        need = glm::ceil(need);
        if (need.x > largest_side)
            throw Error::Input(fmt::format("--scale {}: the picture would be {:.0f} mm wide; take a larger N or another --unit",
                                           options.scale, need.x * css_mm_per_pixel));
        const ivec2 picture(need);
        for (Camera& camera : sheet.cameras)
            camera.size = picture;
    }
    for (Camera& camera : sheet.cameras)
        camera.ortho_height = camera.size.y * units_per_pixel;
}

/// A camera turned around the middle of the model's box.
std::vector<Camera> turned_around(const Camera& camera, const Bounds& bounds, char up_axis, int count)
{
    const dvec3 axis = up_vector(up_axis), middle = bounds.centre();
    std::vector<Camera> cameras(std::size_t(count), camera);
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        const auto turned = [&](const dvec3& v) {
            return v * std::cos(angle) + cross(axis, v) * std::sin(angle) + axis * dot(axis, v) * (1 - std::cos(angle));
        };
        Camera& next = cameras[std::size_t(i)];
        next.eye = middle + turned(camera.eye - middle);
        next.look = middle + turned(camera.look - middle);
        next.up = turned(camera.up);
    }
    return cameras;
}

/// Views at the camera's elevation from all around, framed so that the model fits in every one.
std::vector<Camera> framed_around(ViewOptions options, const Camera& camera, const Subject& subject, char up_axis, int count)
{
    const dvec3 towards = -camera.forward();
    const dvec3 y_up = up_axis == 'z' ? dvec3(towards.x, towards.z, -towards.y) : towards;
    const double azimuth = glm::degrees(std::atan2(y_up.x, y_up.z)), elevation = glm::degrees(std::asin(std::clamp(y_up.y, -1.0, 1.0)));
    options.views.clear();
    for (int i = 0; i < count; ++i)
        options.views.push_back(fmt::format("{},{}", azimuth + 360.0 * i / count, elevation));
    return framed_cameras(options, subject, up_axis, camera.size);
}

} // namespace

void add_view_options(CLI::App& app, ViewOptions& options)
{
    const std::string group = "Camera";
    const auto text = [&](const char* name, std::string& value, const char* type, const std::string& help) {
        app.add_option(name, value, help)->type_name(type)->group(group);
    };
    text("--size", options.size, "WxH", fmt::format("pixels of the picture, or of the whole sheet (default {})", options.size.empty() ? "1600x1200" : options.size));
    app.add_option("--view", options.views,
                   fmt::format("front|back|left|right|top|bottom|iso or AZ,EL in degrees (default {}); several make one sheet", options.usual_view))
        ->type_name("VIEW")
        ->expected(1)
        ->take_all()
        ->group(group);
    text("--eye", options.eye, "X,Y,Z", "where the eye is, instead of --view");
    text("--look", options.look, "X,Y,Z", "the point it looks at (default: the middle of the model)");
    text("--up", options.up, "X,Y,Z", "the direction that points up in the picture");
    app.add_option("--fov", options.fov_degrees, "vertical opening angle of the camera (default 30)")->type_name("DEGREES")->group(group);
    app.add_flag("--ortho", options.orthographic, "parallel projection")->group(group);
    text("--scale", options.scale, "1:N", "parallel projection at this scale on paper");
    text("--unit", options.unit, "UNIT", fmt::format("mm|cm|m|in|ft: what 1 in the model means; for --scale (default {})", options.unit).c_str());
    text("--camera", options.camera_file, "FILE", "a camera as it stands in a report of --json");
    text("--up-axis", options.up_axis, "AXIS", "y|z: the axis of the model that points up (default z for STL and 3MF, y otherwise)");
}

void check_view_options(const ViewOptions& options)
{
    const bool placed = !options.eye.empty();
    if (!options.camera_file.empty() && (placed || !options.views.empty() || !options.scale.empty()))
        throw Error::Input("--camera holds the whole camera; leave --view, --eye and --scale out");
    if (placed && !options.views.empty())
        throw Error::Input("--eye and --view both place the camera; leave one out");
    if (!placed && (!options.look.empty() || !options.up.empty()))
        throw Error::Input("--look and --up need --eye");
    if (!(options.fov_degrees >= 0.1 && options.fov_degrees <= 170))
        throw Error::Input(fmt::format("--fov: {} is outside 0.1..170 degrees", options.fov_degrees));
    if (options.up_axis != "" && options.up_axis != "y" && options.up_axis != "z")
        throw Error::Input(fmt::format("--up-axis: '{}' is neither y nor z", options.up_axis));
    if (!options.size.empty())
        parse_size(options.size);
    if (!options.scale.empty())
        units_per_paper_mm(options);
    for (const auto& [name, text] : {std::pair{"eye", &options.eye}, {"look", &options.look}, {"up", &options.up}})
        if (!text->empty())
            parse_point(name, *text);
    for (const std::string& view : options.views)
        Camera::framing(Bounds(), {.view = view});
}

char up_axis_of(const ViewOptions& options, const std::string& format)
{
    if (!options.up_axis.empty())
        return options.up_axis[0];
    return usual_up_axis(format);
}

Sheet place_cameras(const ViewOptions& options, const Subject& subject, char up_axis)
{
    Sheet sheet;
    if (is_whole(options)) {
        sheet.cameras = {whole_camera(options)};
        lay_out(sheet);
        return sheet;
    }
    const ivec2 grid = grid_of(std::max<std::size_t>(1, options.views.size()));
    const ivec2 picture = max((options.size.empty() ? default_size : parse_size(options.size)) / grid, ivec2(1));
    if (options.eye.empty())
        sheet.cameras = framed_cameras(options, subject, up_axis, picture);
    else
        sheet.cameras = {placed_camera(options, subject.bounds, up_axis, picture)};
    if (!options.scale.empty())
        apply_scale(options, subject.bounds, sheet);
    lay_out(sheet);
    return sheet;
}

std::vector<Sheet> turntable(const ViewOptions& options, const Subject& subject, char up_axis, int count)
{
    const Sheet still = place_cameras(options, subject, up_axis);
    const bool framed = options.eye.empty() && !is_whole(options);
    std::vector<Camera> cameras = framed ? framed_around(options, still.cameras[0], subject, up_axis, count)
                                         : turned_around(still.cameras[0], subject.bounds, up_axis, count);
    std::vector<Sheet> sheets(std::size_t(count), still);
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        if (!options.scale.empty())
            cameras[i].ortho_height = still.cameras[0].ortho_height;
        sheets[i].cameras = {cameras[i]};
    }
    return sheets;
}
