#include "limn/scene/light_json.h"

#include <fmt/format.h>

#include "limn/scene/transform_json.h"

namespace limn {
namespace {

constexpr double largest_side = 1e15; ///< world units

Json vector_json(const dvec3& v) { return {v.x, v.y, v.z}; }

double read_length(const JsonPlace& place)
{
    const double length = place.number(0, largest_side);
    if (!(length > 0))
        place.expected("a number above 0");
    return length;
}

SphereLight read_sphere(const JsonPlace& place)
{
    place.check_keys({"kind", "place", "radius"});
    place.need({"place", "radius"});
    return {read_point(place.at("place")), read_length(place.at("radius"))};
}

RectangleLight read_rectangle(const JsonPlace& place)
{
    place.check_keys({"kind", "place", "size", "towards"});
    place.need({"place", "size"});
    RectangleLight light;
    light.centre = read_point(place.at("place"));
    const std::vector<double> size = place.at("size").numbers(2);
    if (!(size[0] > 0 && size[1] > 0))
        place.at("size").expected("[width, height], both above 0");
    light.size = {size[0], size[1]};
    if (place.has("towards"))
        light.towards = read_point(place.at("towards"));
    return light;
}

Light read_light(const JsonPlace& place, const std::filesystem::path& folder)
{
    if (!place.value().is_object())
        place.expected("an object");
    place.need({"kind"});
    const std::string kind = place.at("kind").text();
    if (kind == "headlight") {
        place.check_keys({"kind"});
        return Headlight();
    }
    if (kind == "distant") {
        place.check_keys({"kind", "direction"});
        place.need({"direction"});
        return DistantLight{read_direction(place.at("direction"))};
    }
    if (kind == "lamp") {
        place.check_keys({"kind", "place"});
        place.need({"place"});
        return Lamp{read_point(place.at("place"))};
    }
    if (kind == "sphere")
        return read_sphere(place);
    if (kind == "rectangle")
        return read_rectangle(place);
    if (kind == "environment") {
        place.check_keys({"kind", "file"});
        place.need({"file"});
        return EnvironmentFile{read_path(place.at("file"), folder), nullptr};
    }
    place.at("kind").expected("one of headlight|distant|lamp|sphere|rectangle|environment");
}

} // namespace

std::vector<Light> read_lights(const JsonPlace& place, const std::filesystem::path& folder)
{
    std::vector<Light> lights;
    for (const JsonPlace& light : place.entries())
        lights.push_back(read_light(light, folder));
    if (lights.size() > 1)
        place.expected("one light, which is all a picture is lit by so far");
    return lights;
}

Json light_json(const Light& light, const std::filesystem::path& folder)
{
    if (const auto* distant = std::get_if<DistantLight>(&light))
        return {{"kind", "distant"}, {"direction", vector_json(distant->direction)}};
    if (const auto* lamp = std::get_if<Lamp>(&light))
        return {{"kind", "lamp"}, {"place", vector_json(lamp->place)}};
    if (const auto* ball = std::get_if<SphereLight>(&light))
        return {{"kind", "sphere"}, {"place", vector_json(ball->centre)}, {"radius", ball->radius}};
    if (const auto* rectangle = std::get_if<RectangleLight>(&light)) {
        Json json = {{"kind", "rectangle"}, {"place", vector_json(rectangle->centre)}, {"size", {rectangle->size.x, rectangle->size.y}}};
        if (rectangle->towards)
            json["towards"] = vector_json(*rectangle->towards);
        return json;
    }
    if (const auto* environment = std::get_if<EnvironmentFile>(&light))
        return {{"kind", "environment"}, {"file", path_from(environment->file, folder)}};
    return {{"kind", "headlight"}};
}

std::vector<Light> all_lights(const Scene& scene)
{
    if (!scene.lights.empty())
        return scene.lights;
    if (scene.render.wide)
        return {std::visit([](const auto& light) { return Light(light); }, *scene.render.wide)};
    if (scene.render.lamp)
        return {Lamp{*scene.render.lamp}};
    if (scene.render.light)
        return {DistantLight{*scene.render.light}};
    return {};
}

std::filesystem::path read_path(const JsonPlace& place, const std::filesystem::path& folder)
{
    const std::string name = place.text();
    if (name.empty())
        place.expected("the name of a file");
    if (name.find('\0') != std::string::npos)
        place.refuse("a file's name holds no zero byte");
    const std::filesystem::path path = folder / name;
    std::error_code failure;
    if (!std::filesystem::exists(path, failure))
        place.refuse(fmt::format("there is no file {}", quoted(name)));
    return path;
}

std::string path_from(const std::filesystem::path& file, const std::filesystem::path& folder)
{
    return (folder.empty() ? file : std::filesystem::proximate(file, folder)).generic_string();
}

} // namespace limn
