#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "limn/base/error.h"
#include "limn/camera/camera.h"

namespace limn {
namespace {

using Json = nlohmann::ordered_json;

constexpr double farthest_look = 1e15; ///< beyond it single precision squares no distance of the picture

Json array_of(const dvec3& v) { return {v.x, v.y, v.z}; }

[[noreturn]] void refuse(std::string_view key, const Json& value, std::string_view expected)
{
    throw Error::Input(fmt::format("camera: '{}' is {}; expected {}", key, value.dump(), expected));
}

bool is_finite_number(const Json& value) { return value.is_number() && std::isfinite(value.get<double>()); }

void read_vector(const Json& camera, const char* key, dvec3& to)
{
    const auto found = camera.find(key);
    if (found == camera.end())
        return;
    if (!found->is_array() || found->size() != 3 || !std::all_of(found->begin(), found->end(), is_finite_number))
        refuse(key, *found, "[x, y, z]");
    to = {(*found)[0].get<double>(), (*found)[1].get<double>(), (*found)[2].get<double>()};
}

/// A number strictly between the limits.
void read_number(const Json& camera, const char* key, double low, double high, double& to)
{
    const auto found = camera.find(key);
    if (found == camera.end())
        return;
    if (!is_finite_number(*found) || !(found->get<double>() > low && found->get<double>() < high))
        refuse(key, *found, std::isfinite(high) ? fmt::format("a number between {} and {}", low, high) : fmt::format("a number above {}", low));
    to = found->get<double>();
}

void read_size(const Json& camera, ivec2& to)
{
    const auto found = camera.find("size");
    if (found == camera.end())
        return;
    const auto is_side = [](const Json& value) { return value.is_number_integer() && value.get<double>() >= 1 && value.get<double>() <= 1e6; };
    if (!found->is_array() || found->size() != 2 || !std::all_of(found->begin(), found->end(), is_side))
        refuse("size", *found, "[width, height], whole numbers from 1 to 1000000");
    to = {(*found)[0].get<int>(), (*found)[1].get<int>()};
}

void read_projection(const Json& camera, bool& orthographic)
{
    const auto found = camera.find("orthographic");
    if (found == camera.end())
        return;
    if (!found->is_boolean())
        refuse("orthographic", *found, "true or false");
    orthographic = found->get<bool>();
}

void check_keys(const Json& camera)
{
    static constexpr std::array<std::string_view, 7> known = {"eye", "look", "up", "fov_degrees", "orthographic", "ortho_height", "size"};
    for (const auto& [key, value] : camera.items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            throw Error::Input(fmt::format("camera: '{}' is none of {}", key, fmt::join(known, ", ")));
    for (const char* key : {"eye", "look"})
        if (!camera.contains(key))
            throw Error::Input(fmt::format("camera: '{}' is missing", key));
}

Json parse(std::string_view text)
{
    try {
        return Json::parse(text);
    } catch (const Json::parse_error& error) {
        const auto at = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
        throw Error::Input(fmt::format("camera: line {}: no valid JSON at byte {}", 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n'), at));
    } catch (const Json::out_of_range&) {
        throw Error::Input("camera: a number is too large to be read");
    }
}

} // namespace

std::string camera_to_json(const Camera& camera)
{
    Json json;
    json["eye"] = array_of(camera.eye);
    json["look"] = array_of(camera.look);
    json["up"] = array_of(camera.up);
    json["fov_degrees"] = camera.fov_degrees;
    json["orthographic"] = camera.orthographic;
    json["ortho_height"] = camera.ortho_height;
    json["size"] = {camera.size.x, camera.size.y};
    return json.dump();
}

Camera camera_from_json(std::string_view text)
{
    Json json = parse(text);
    if (json.is_object() && json.contains("camera") && !json.contains("eye"))
        json = Json(json["camera"]); // a report or a drawing that holds its camera
    if (!json.is_object())
        throw Error::Input(fmt::format("camera: found {}; expected an object", json.type_name()));
    check_keys(json);
    Camera camera;
    read_vector(json, "eye", camera.eye);
    read_vector(json, "look", camera.look);
    read_vector(json, "up", camera.up);
    read_number(json, "fov_degrees", 0, 180, camera.fov_degrees);
    read_number(json, "ortho_height", 0, INFINITY, camera.ortho_height);
    read_projection(json, camera.orthographic);
    read_size(json, camera.size);
    const double distance = glm::distance(camera.eye, camera.look);
    if (!(distance > 0))
        throw Error::Input("camera: 'look' is where 'eye' is");
    if (!(distance <= farthest_look))
        throw Error::Input(fmt::format("camera: 'eye' is farther than {:.0e} from 'look'", farthest_look));
    if (camera.up == dvec3(0))
        refuse("up", json["up"], "a direction");
    return camera;
}

std::vector<Camera> cameras_from_json(std::string_view text, const std::string& name)
{
    const auto refused = [&](const std::string& why) { return Error::Input(fmt::format("{}: {}", name, why)); };
    Json json;
    try {
        json = parse(text);
    } catch (const Error::Input& error) {
        throw refused(error.what());
    }
    for (const char* key : {"cameras", "views"})
        if (json.is_object() && json.contains(key))
            json = Json(json[key]);
    if (!json.is_array() || json.empty())
        throw refused("found no list of cameras");
    std::vector<Camera> cameras;
    for (const Json& entry : json)
        try {
            cameras.push_back(camera_from_json(entry.dump()));
        } catch (const Error::Input& error) {
            throw refused(fmt::format("entry {}: {}", cameras.size(), error.what()));
        }
    return cameras;
}

} // namespace limn
