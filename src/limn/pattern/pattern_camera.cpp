#include "limn/pattern/pattern_camera.h"

namespace limn {

PatternCamera::PatternCamera(const Camera& camera, const dvec3& centre, double scale, const PatternFrame& frame)
    : eye_(frame.point(vec3((camera.eye - centre) / scale))), forward_(frame.direction(vec3(camera.forward()))), middle_(0.5f * vec2(camera.size)),
      orthographic_(camera.orthographic)
{
    const double world_per_pixel = 1 / camera.pixels_per_unit(1);
    const double factor = orthographic_ ? world_per_pixel * double(frame.scale) / scale : world_per_pixel;
    right_ = frame.direction(vec3(factor * camera.right()));
    down_ = frame.direction(vec3(-factor * camera.above()));
}

vec3 PatternCamera::sight(const vec2& pixel) const
{
    if (orthographic_)
        return forward_;
    const vec2 off = pixel - middle_;
    return forward_ + off.x * right_ + off.y * down_;
}

vec3 PatternCamera::to_eye(const vec3& position) const { return orthographic_ ? -forward_ : glm::normalize(eye_ - position); }

formulas::PatternPoint PatternCamera::point(const PatternSpot& spot) const
{
    const float depth = orthographic_ ? 1.0f : glm::dot(spot.position - eye_, forward_);
    const vec3 line = orthographic_ ? forward_ : spot.position - eye_;
    return {spot.position, spot.normal, spot.to_eye, formulas::step_on_plane(depth * right_, line, spot.face_normal),
            formulas::step_on_plane(depth * down_, line, spot.face_normal)};
}

vec3 PatternCamera::on_plane(const PatternSpot& spot, const vec2& pixel, const vec2& other) const
{
    if (!orthographic_)
        return eye_ + formulas::meet_plane(glm::normalize(sight(other)), spot.position - eye_, spot.face_normal);
    const vec2 off = other - pixel;
    return spot.position + formulas::step_on_plane(off.x * right_ + off.y * down_, forward_, spot.face_normal);
}

bool PatternCamera::on_sphere(const vec3& centre, float radius, bool far_side, const vec2& pixel, vec3& place) const
{
    const vec2 off = pixel - middle_;
    const vec3 origin = orthographic_ ? eye_ + off.x * right_ + off.y * down_ : eye_;
    const vec3 direction = glm::normalize(sight(pixel));
    const float distance = formulas::meet_sphere(direction, centre - origin, radius, far_side);
    place = origin + distance * direction;
    return distance > 0;
}

} // namespace limn
