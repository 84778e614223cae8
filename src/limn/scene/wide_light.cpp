#include "limn/scene/wide_light.h"

#include <vector>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/options.h"
#include "limn/drawing/hdr.h"

namespace limn {
namespace {

/// As many numbers as one of two counts says.
std::vector<double> numbers_of(std::string_view name, std::string_view text, std::string_view form, std::size_t count, std::size_t or_count)
{
    std::vector<double> numbers;
    for (std::string_view rest = text;;) {
        const std::size_t comma = rest.find(',');
        numbers.push_back(parse_number(name, rest.substr(0, comma)));
        if (comma == std::string_view::npos)
            break;
        rest.remove_prefix(comma + 1);
    }
    if (numbers.size() != count && numbers.size() != or_count)
        throw Error::Input(fmt::format("--{}: {} numbers are not {}", name, numbers.size(), form));
    return numbers;
}

} // namespace

std::optional<WantedWideLight> wide_light_from_text(std::string_view name, std::string_view text)
{
    const std::size_t colon = text.find(':');
    const std::string_view kind = text.substr(0, colon), rest = colon == std::string_view::npos ? "" : text.substr(colon + 1);
    if (kind == "sphere") {
        const std::vector<double> n = numbers_of(name, rest, "sphere:x,y,z,radius", 4, 4);
        if (!(n[3] > 0))
            throw Error::Input(fmt::format("--{}: the radius {} of a sphere is not above 0", name, n[3]));
        return SphereLight{{n[0], n[1], n[2]}, n[3]};
    }
    if (kind == "rect") {
        const std::vector<double> n = numbers_of(name, rest, "rect:x,y,z,width,height or rect:x,y,z,width,height,x,y,z", 5, 8);
        if (!(n[3] > 0 && n[4] > 0))
            throw Error::Input(fmt::format("--{}: the sides {} and {} of a rectangle are not above 0", name, n[3], n[4]));
        RectangleLight light = {{n[0], n[1], n[2]}, {n[3], n[4]}, std::nullopt};
        if (n.size() == 8)
            light.towards = dvec3(n[5], n[6], n[7]);
        return light;
    }
    if (kind == "env") {
        if (rest.empty())
            throw Error::Input(fmt::format("--{}: env:FILE needs the name of a Radiance picture (.hdr)", name));
        return EnvironmentFile{std::string(rest), nullptr};
    }
    return std::nullopt;
}

std::optional<dvec3> middle_of(const WantedWideLight& light)
{
    if (const auto* ball = std::get_if<SphereLight>(&light))
        return ball->centre;
    if (const auto* rectangle = std::get_if<RectangleLight>(&light))
        return rectangle->centre;
    return std::nullopt;
}

std::string wide_light_text(const WantedWideLight& light)
{
    if (const auto* ball = std::get_if<SphereLight>(&light))
        return fmt::format("sphere:{},{},{},{}", ball->centre.x, ball->centre.y, ball->centre.z, ball->radius);
    if (const auto* r = std::get_if<RectangleLight>(&light)) {
        const std::string towards = r->towards ? fmt::format(",{},{},{}", r->towards->x, r->towards->y, r->towards->z) : "";
        return fmt::format("rect:{},{},{},{},{}{}", r->centre.x, r->centre.y, r->centre.z, r->size.x, r->size.y, towards);
    }
    return "env:" + std::get<EnvironmentFile>(light).file.string();
}

void load(WantedWideLight& light)
{
    auto* environment = std::get_if<EnvironmentFile>(&light);
    if (!environment || environment->map)
        return;
    const Image picture = read_hdr(environment->file);
    try {
        environment->map = std::make_shared<const EnvironmentMap>(picture);
    } catch (const Error::Input& error) {
        throw Error::Read(fmt::format("{}: {}", environment->file.string(), error.what()));
    }
}

WideLight loaded(const WantedWideLight& light)
{
    if (const auto* ball = std::get_if<SphereLight>(&light))
        return *ball;
    if (const auto* rectangle = std::get_if<RectangleLight>(&light))
        return *rectangle;
    WantedWideLight copy = light;
    load(copy);
    return EnvironmentLight{std::get<EnvironmentFile>(copy).map};
}

} // namespace limn
