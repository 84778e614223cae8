#include "limn/pattern/pattern_camera.h"

namespace limn {

PatternCamera::PatternCamera(const Camera& camera, const dvec3& centre, double scale, const PatternFrame& frame)
{
    const double world_per_pixel = 1 / camera.pixels_per_unit(1);
    const double factor = camera.orthographic ? world_per_pixel * double(frame.scale) / scale : world_per_pixel;
    eye_ = {frame.point(vec3((camera.eye - centre) / scale)),
            frame.direction(vec3(camera.forward())),
            frame.direction(vec3(factor * camera.right())),
            frame.direction(vec3(-factor * camera.above())),
            0.5f * vec2(camera.size),
            camera.orthographic ? 1 : 0};
}

bool PatternCamera::on_sphere(const vec3& centre, float radius, bool far_side, const vec2& pixel, vec3& place) const
{
    const vec2 off = pixel - eye_.middle;
    const vec3 origin = orthographic() ? eye_.place + off.x * eye_.right + off.y * eye_.down : eye_.place;
    const vec3 direction = glm::normalize(sight(pixel));
    const float distance = formulas::meet_sphere(direction, centre - origin, radius, far_side);
    place = origin + distance * direction;
    return distance > 0;
}

} // namespace limn
