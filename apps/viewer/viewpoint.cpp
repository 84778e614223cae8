#include "viewpoint.h"

#include <cmath>

using namespace limn;

Viewpoint turned(const Viewpoint& from, const dvec2& pixels)
{
    constexpr double degrees_across = 180; // of a drag over the whole height
    const double degrees = degrees_across / from.lens.size.y;
    return {from.table.turned(-pixels.x * degrees, pixels.y * degrees), from.lens};
}

Viewpoint panned(const Viewpoint& from, const dvec2& pixels, std::optional<double> depth)
{
    const double unit = 1 / from.camera().pixels_per_unit(depth.value_or(from.table.distance));
    return {from.table.moved((-pixels.x * from.table.right() + pixels.y * from.table.above()) * unit), from.lens};
}

Viewpoint zoomed(const Viewpoint& from, double steps, const dvec2& cursor, std::optional<double> depth)
{
    const double factor = std::pow(5.0 / 6, steps), along = depth.value_or(from.table.distance);
    const Camera camera = from.camera();
    const Camera::Ray ray = camera.ray(cursor);
    const dvec3 place = ray.origin + ray.direction * (along / glm::dot(ray.direction, camera.forward()));
    Viewpoint to = {from.table.zoomed(factor, place), from.lens};
    if (!from.lens.orthographic)
        return to;
    to.table.distance = from.table.distance; // a parallel view grows by its scale alone
    to.lens.ortho_height *= factor;
    return to;
}

Viewpoint flown(const Viewpoint& from, const dvec3& direction, double seconds)
{
    const dvec3 right = from.table.right(), up = from.table.up(), ahead = glm::cross(up, right);
    return {from.table.moved((direction.x * right + direction.y * ahead + direction.z * up) * (from.table.distance * seconds)), from.lens};
}
