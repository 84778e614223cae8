#include "limn/scene/scene.h"

#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"

namespace limn {
namespace {

constexpr double unevenness = 1e-6; ///< of a similarity's axes, as a part of its scale: numbers written with seven digits pass
constexpr double smallest = 1e-9, largest = 1e9, farthest = 1e15;

bool is_finite(const dmat4& m)
{
    for (int i = 0; i < 16; ++i)
        if (!std::isfinite(m[i / 4][i % 4]))
            return false;
    return true;
}

/// Whether the columns have one length and stand at right angles.
bool is_even(const dmat3& m, double scale)
{
    const dmat3 product = glm::transpose(m) * m / (scale * scale);
    for (int i = 0; i < 9; ++i)
        if (std::abs(product[i / 3][i % 3] - (i % 4 == 0 ? 1 : 0)) > unevenness)
            return false;
    return true;
}

} // namespace

LineOptions no_lines()
{
    LineOptions options;
    options.lines.clear();
    return options;
}

char usual_up_axis(std::string_view format) { return format == "stl" || format == "3mf" ? 'z' : 'y'; }

dvec3 up_vector(char up_axis) { return up_axis == 'z' ? dvec3(0, 0, 1) : dvec3(0, 1, 0); }

std::vector<Material> object_materials(const Scene& scene, const Material& usual)
{
    std::vector<Material> materials;
    for (const SceneObject& object : scene.objects) {
        const std::string* name = std::get_if<std::string>(&object.material);
        if (name == nullptr) {
            materials.push_back(std::get<Material>(object.material));
        } else if (name->empty()) {
            materials.push_back(usual);
        } else {
            const auto found = scene.materials.find(*name);
            if (found == scene.materials.end())
                throw Error::Input(fmt::format("objects[{}]: the scene has no material '{}'", materials.size(), *name));
            materials.push_back(found->second);
        }
    }
    return materials;
}

RenderOptions lit_by(const std::vector<Light>& lights, RenderOptions options)
{
    if (lights.empty())
        return options;
    if (lights.size() > 1)
        throw Error::Input(fmt::format("{} lights; a picture is lit by one so far", lights.size()));
    options.light.reset();
    options.lamp.reset();
    options.wide.reset();
    if (const auto* distant = std::get_if<DistantLight>(&lights.front()))
        options.light = distant->direction;
    if (const auto* lamp = std::get_if<Lamp>(&lights.front()))
        options.lamp = lamp->place;
    if (const auto* ball = std::get_if<SphereLight>(&lights.front()))
        options.wide = *ball;
    if (const auto* rectangle = std::get_if<RectangleLight>(&lights.front()))
        options.wide = *rectangle;
    if (const auto* environment = std::get_if<EnvironmentFile>(&lights.front()))
        options.wide = *environment;
    return options;
}

char up_axis_of(const Scene& scene)
{
    if (scene.view.up_axis != 0 || scene.objects.empty())
        return scene.view.up_axis == 'z' ? 'z' : 'y';
    const SceneObject& first = scene.objects.front();
    return usual_up_axis(first.format.empty() ? file_ending(first.file) : first.format);
}

std::string transform_fault(const dmat4& transform)
{
    if (!is_finite(transform))
        return "holds a number that is not finite";
    if (transform[0][3] != 0 || transform[1][3] != 0 || transform[2][3] != 0 || transform[3][3] != 1)
        return "does not end with the row 0, 0, 0, 1";
    const dmat3 linear(transform);
    const double scale = glm::length(linear[0]);
    if (!(scale >= smallest && scale <= largest))
        return fmt::format("scales by {}, outside {}..{}", scale, smallest, largest);
    if (!is_even(linear, scale))
        return "shears or scales unevenly";
    if (glm::determinant(linear) < 0)
        return "mirrors";
    if (!(glm::length(dvec3(transform[3])) <= farthest))
        return fmt::format("moves farther than {:.0e}", farthest);
    return "";
}

std::vector<std::size_t> first_of_same_model(const std::vector<SceneObject>& objects)
{
    std::map<std::tuple<std::filesystem::path, std::string, const Mesh*>, std::size_t> first;
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const SceneObject& object = objects[i];
        result.push_back(first.emplace(std::tuple(object.mesh ? std::filesystem::path() : object.file, object.format, object.mesh.get()), i).first->second);
    }
    return result;
}

} // namespace limn
