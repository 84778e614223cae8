#include "limn/scene/transform_json.h"

#include <cmath>

#include <fmt/format.h>

#include "limn/scene/scene.h"

namespace limn {
namespace {

constexpr double farthest = 1e15; ///< coordinates of things in a scene
constexpr double most_degrees = 1e6;

dmat4 moved(const dvec3& by)
{
    dmat4 m(1);
    m[3] = dvec4(by, 1);
    return m;
}

/// Rodrigues' rotation, counter-clockwise seen from the tip of the axis.
dmat4 turned(const dvec3& axis, double degrees)
{
    const double angle = glm::radians(degrees), c = std::cos(angle), s = std::sin(angle);
    const dvec3 a = glm::normalize(axis);
    dmat4 m(1);
    for (int k = 0; k < 3; ++k) {
        dvec3 e(0);
        e[k] = 1;
        m[k] = dvec4(e * c + glm::cross(a, e) * s + a * glm::dot(a, e) * (1 - c), 0);
    }
    return m;
}

/// [x, y, z]: degrees around the x axis, then y, then z of the world; {"axis": …, "degrees": …}: around one axis.
dmat4 read_rotation(const JsonPlace& place)
{
    if (place.value().is_object()) {
        place.check_keys({"axis", "degrees"});
        place.need({"axis", "degrees"});
        return turned(read_direction(place.at("axis")), place.at("degrees").number(-most_degrees, most_degrees));
    }
    if (!place.value().is_array() || place.value().size() != 3)
        place.expected("[x, y, z] in degrees or {\"axis\": [x, y, z], \"degrees\": d}");
    dmat4 rotation(1);
    const std::vector<JsonPlace> angles = place.entries();
    for (int k = 0; k < 3; ++k) {
        dvec3 axis(0);
        axis[k] = 1;
        rotation = turned(axis, angles[std::size_t(k)].number(-most_degrees, most_degrees)) * rotation;
    }
    return rotation;
}

/// 16 numbers, row by row.
dmat4 read_matrix(const JsonPlace& place)
{
    const std::vector<double> numbers = place.numbers(16);
    dmat4 m;
    for (int i = 0; i < 16; ++i)
        m[i % 4][i / 4] = numbers[std::size_t(i)];
    if (const std::string fault = transform_fault(m); !fault.empty())
        place.refuse("expected a rotation, a uniform scale and a translation; the matrix " + fault);
    return m;
}

} // namespace

dvec3 read_point(const JsonPlace& place)
{
    const dvec3 p = place.vector();
    if (!(glm::length(p) <= farthest))
        place.refuse(fmt::format("is farther than {:.0e} from the origin", farthest));
    return p;
}

dvec3 read_direction(const JsonPlace& place)
{
    const dvec3 direction = place.vector();
    if (!(glm::length(direction) > 0) || !std::isfinite(glm::length(direction)))
        place.expected("a direction");
    return direction;
}

dmat4 read_transform(const JsonPlace& object)
{
    if (object.has("matrix")) {
        for (const char* key : {"translate", "rotate", "scale"})
            if (object.has(key))
                object.refuse(fmt::format("'matrix' holds the whole transform; leave '{}' out", key));
        return read_matrix(object.at("matrix"));
    }
    dmat4 m(1);
    if (object.has("scale")) {
        const double scale = object.at("scale").number(1e-9, 1e9);
        m[0][0] = m[1][1] = m[2][2] = scale;
    }
    if (object.has("rotate"))
        m = read_rotation(object.at("rotate")) * m;
    if (object.has("translate"))
        m = moved(read_point(object.at("translate"))) * m;
    return m;
}

Json matrix_json(const dmat4& m)
{
    Json numbers = Json::array();
    for (int i = 0; i < 16; ++i)
        numbers.push_back(m[i % 4][i / 4]);
    return numbers;
}

} // namespace limn
