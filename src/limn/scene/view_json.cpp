#include "limn/scene/view_json.h"

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

constexpr int largest_side = 1 << 15; ///< of a picture, pixels

const std::vector<std::string> camera_keys = {"eye", "look", "up", "fov_degrees", "orthographic", "ortho_height", "size"};
const std::vector<std::string> framing_keys = {"view", "up_axis", "fov_degrees", "orthographic", "size"};

ivec2 read_size(const JsonPlace& place)
{
    const std::string wish = fmt::format("[width, height], whole numbers in 1..{}", largest_side);
    if (!place.value().is_array() || place.value().size() != 2)
        place.expected(wish);
    ivec2 size;
    for (int k = 0; k < 2; ++k) {
        const JsonPlace side = place.at(std::size_t(k));
        if (!side.value().is_number_integer() || side.value().get<double>() < 1 || side.value().get<double>() > largest_side)
            side.expected(fmt::format("a whole number in 1..{}", largest_side));
        size[k] = side.value().get<int>();
    }
    return size;
}

/// A whole camera, as the reports of --json have it.
Camera read_camera(const JsonPlace& place)
{
    place.check_keys(camera_keys);
    if (place.has("size"))
        read_size(place.at("size"));
    try {
        return camera_from_json(place.value().dump());
    } catch (const Error::Input& error) {
        std::string_view message = error.what();
        message.remove_prefix(message.starts_with("camera: ") ? 8 : 0); // the way says it
        place.refuse(message);
    }
}

std::string read_side(const JsonPlace& place)
{
    const std::string view = place.text();
    try {
        Camera::framing(Bounds(), {.view = view});
    } catch (const Error::Input&) {
        place.expected("one of front|back|left|right|top|bottom|iso or \"AZ,EL\" in degrees");
    }
    return view;
}

char read_up_axis(const JsonPlace& place)
{
    if (place.value() != "y" && place.value() != "z")
        place.expected("\"y\" or \"z\"");
    return place.text()[0];
}

} // namespace

SceneView read_view(const JsonPlace& place)
{
    SceneView view;
    if (place.has("eye") || place.has("look")) {
        view.camera = read_camera(place);
        return view;
    }
    place.check_keys(framing_keys);
    if (place.has("view"))
        view.view = read_side(place.at("view"));
    if (place.has("up_axis"))
        view.up_axis = read_up_axis(place.at("up_axis"));
    if (place.has("size"))
        view.size = read_size(place.at("size"));
    if (place.has("fov_degrees"))
        view.fov_degrees = place.at("fov_degrees").number(0.1, 170);
    if (place.has("orthographic"))
        view.orthographic = place.at("orthographic").yes_no();
    return view;
}

Json view_json(const SceneView& view)
{
    if (view.camera)
        return Json::parse(camera_to_json(*view.camera));
    Json json = Json::object();
    if (!view.view.empty())
        json["view"] = view.view;
    if (view.up_axis != 0)
        json["up_axis"] = std::string(1, view.up_axis);
    if (view.size)
        json["size"] = {view.size->x, view.size->y};
    if (view.fov_degrees != SceneView().fov_degrees)
        json["fov_degrees"] = view.fov_degrees;
    if (view.orthographic)
        json["orthographic"] = true;
    return json;
}

} // namespace limn
