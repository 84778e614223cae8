#include "limn/subdivision/turned_triangle.h"

#include <algorithm>

namespace limn {
namespace {

/// How far the side from corner k to the next is from the surface between them, in the picture.
double side_error(const SilhouetteView& view, const DrawnTriangle& triangle, std::size_t k, const std::array<dvec2, 3>& pixels)
{
    const dvec2 &from = triangle.at[k], &to = triangle.at[(k + 1) % 3];
    double most = 0;
    for (const double t : {0.25, 0.5, 0.75}) { // the middle alone tells nothing of a curve in the form of an S
        const dvec2 at = glm::mix(from, to, t);
        most = std::max(most, distance_to_line(view.plane.pixel(view.pose.shape.position({triangle.face, at.x, at.y})), pixels[k], pixels[(k + 1) % 3]));
    }
    return most;
}

} // namespace

bool shows_side(const SilhouetteView& view, const std::array<dvec3, 3>& p, bool front)
{
    const dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    return (glm::dot(view.eye.from(p[0]), normal) >= 0) == front;
}

double turned_beyond(const SilhouetteView& view, const DrawnTriangle& triangle, bool front)
{
    if (shows_side(view, triangle.positions, front))
        return 0;
    std::array<dvec2, 3> pixels;
    for (std::size_t k = 0; k < 3; ++k)
        pixels[k] = view.plane.pixel(triangle.positions[k]);
    if (!view.plane.is_in_picture(pixels))
        return 0;
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k)
        if (!triangle.on_contour[k])
            most = std::max(most, side_error(view, triangle, k, pixels));
    return most;
}

double pixels_around(const SilhouetteView& view, const DrawnTriangle& triangle)
{
    constexpr double least = 0.1; // of what is allowed elsewhere: faces are cut in four for it, which costs more than points on arcs
    const std::array<dvec3, 3>& p = triangle.positions;
    return std::max(least * view.pixels, std::min({view.pixels_along(p[0], p[1]), view.pixels_along(p[1], p[2]), view.pixels_along(p[2], p[0])}));
}

} // namespace limn
