#include "limn/raycast/light_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "limn/base/error.h"
#include "limn/surface/tangent.h"

namespace limn {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double tiny_angle = 1e-5; ///< below it directions are even over the area
constexpr std::size_t turns = 2048;

/// The unit circle in even steps: places of a ball keep to them, which saves most of their time.
std::vector<vec2> make_circle()
{
    std::vector<vec2> circle;
    for (std::size_t i = 0; i < turns; ++i)
        circle.push_back(vec2(dvec2(std::cos(2 * pi * double(i) / turns), std::sin(2 * pi * double(i) / turns))));
    return circle;
}

/// @param u  in [0, 1]
const vec2& on_circle(float u)
{
    static const std::vector<vec2> circle = make_circle();
    return circle[std::size_t(u * float(turns)) % turns];
}

} // namespace

BallShape shape_of(const SphereLight& light, const dvec3& centre, double scale)
{
    if (!(light.radius > 0))
        throw Error::Input("a light that is a sphere needs a radius above 0");
    return {vec3((light.centre - centre) / scale), float(light.radius / scale)};
}

RectangleShape shape_of(const RectangleLight& light, const dvec3& centre, double scale, const dvec3& up)
{
    if (!(light.size.x > 0 && light.size.y > 0))
        throw Error::Input("a light that is a rectangle needs sides above 0");
    const dvec3 way = light.towards.value_or(centre) - light.centre;
    const dvec3 facing = glm::length(way) > 0 ? glm::normalize(way) : up;
    const dvec3 across = glm::cross(up, facing);
    const dvec3 level = glm::length(across) > 1e-9 ? glm::normalize(across) : glm::normalize(glm::cross(dvec3(up.y, up.z, up.x), facing));
    const dvec3 side = light.size.x * level, other = light.size.y * glm::cross(facing, level);
    return {vec3((light.centre - 0.5 * (side + other) - centre) / scale), vec3(side / scale), vec3(other / scale)};
}

Ball ball_around(const LightShape& shape)
{
    if (const auto* ball = std::get_if<BallShape>(&shape))
        return {ball->centre, ball->radius};
    const RectangleShape& r = std::get<RectangleShape>(shape);
    return {r.corner + 0.5f * (r.side + r.other), 0.5001f * glm::length(r.side + r.other)};
}

LightView::LightView(const LightShape& shape, const vec3& from) : shape_(shape), from_(from)
{
    std::visit([&](const auto& one) { see(one); }, shape_);
}

void LightView::see(const BallShape& ball)
{
    const vec3 way = ball.centre - from_;
    cap_.distance = glm::length(way);
    if (cap_.distance <= ball.radius)
        return;
    cap_.axis = way / cap_.distance;
    const TangentFrame around = any_frame(dvec3(cap_.axis));
    cap_.x = vec3(around.u), cap_.y = vec3(around.v);
    const float sine = ball.radius / cap_.distance;
    cap_.depth = sine * sine / (1 + std::sqrt(1 - sine * sine));
}

void LightView::see(const RectangleShape& rectangle)
{
    Rectangle& s = seen_;
    const double width = double(glm::length(rectangle.side)), height = double(glm::length(rectangle.other));
    s.x = rectangle.side / float(width), s.y = rectangle.other / float(height), s.z = glm::cross(s.x, s.y);
    const vec3 d = rectangle.corner - from_;
    s.z0 = double(glm::dot(d, s.z));
    if (s.z0 > 0)
        s.z = -s.z, s.z0 = -s.z0;
    s.x0 = double(glm::dot(d, s.x)), s.y0 = double(glm::dot(d, s.y)), s.x1 = s.x0 + width, s.y1 = s.y0 + height;
    const auto plane = [&](const dvec3& a, const dvec3& b) {
        const dvec3 n = glm::cross(a, b);
        return n / std::max(glm::length(n), 1e-300);
    };
    const dvec3 a(s.x0, s.y0, s.z0), b(s.x0, s.y1, s.z0), c(s.x1, s.y0, s.z0), e(s.x1, s.y1, s.z0);
    const dvec3 n[4] = {plane(a, c), plane(c, e), plane(e, b), plane(b, a)};
    double g[4];
    for (int i = 0; i < 4; ++i)
        g[i] = std::acos(std::clamp(-glm::dot(n[i], n[(i + 1) % 4]), -1.0, 1.0));
    s.b0 = n[0].z, s.b1 = n[2].z;
    s.k = 2 * pi - g[2] - g[3];
    s.angle = g[0] + g[1] - s.k;
}

vec3 LightView::place(const vec2& u) const
{
    return std::visit([&](const auto& shape) { return place_on(shape, u); }, shape_);
}

vec3 LightView::place_on(const BallShape& ball, const vec2& u) const
{
    const vec2& turn = on_circle(u.y);
    if (cap_.depth == 0) { // within it light comes from all sides
        const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
        return ball.centre + ball.radius * vec3(r * turn.x, r * turn.y, z);
    }
    const float away = u.x * cap_.depth, cosine = 1 - away, off = std::sqrt(std::max(0.0f, away * (2 - away)));
    const float nearest = cap_.distance * cosine - std::sqrt(std::max(0.0f, ball.radius * ball.radius - cap_.distance * cap_.distance * off * off));
    return from_ + nearest * (cosine * cap_.axis + off * (turn.x * cap_.x + turn.y * cap_.y));
}

vec3 LightView::place_on(const RectangleShape& rectangle, const vec2& u) const
{
    const Rectangle& s = seen_;
    if (!(s.angle > tiny_angle) || s.z0 > -1e-12)
        return rectangle.corner + u.x * rectangle.side + u.y * rectangle.other;
    const double turn = double(u.x) * s.angle + s.k, f = (std::cos(turn) * s.b0 - s.b1) / std::sin(turn);
    const double c = std::clamp((f > 0 ? 1.0 : -1.0) / std::sqrt(f * f + s.b0 * s.b0), -1.0, 1.0);
    const double x = std::clamp(-(c * s.z0) / std::sqrt(std::max(1 - c * c, 1e-300)), s.x0, s.x1);
    const double d = std::sqrt(x * x + s.z0 * s.z0), h0 = s.y0 / std::hypot(d, s.y0), h1 = s.y1 / std::hypot(d, s.y1);
    const double h = h0 + double(u.y) * (h1 - h0), y = h * h < 1 - 1e-12 ? h * d / std::sqrt(1 - h * h) : s.y1;
    return from_ + float(x) * s.x + float(std::clamp(y, s.y0, s.y1)) * s.y + float(s.z0) * s.z;
}

} // namespace limn
