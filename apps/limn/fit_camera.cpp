#include "fit_camera.h"

#include <algorithm>
#include <cmath>

#include "limn/base/parallel.h"
#include "limn/lines/projector.h"

using namespace limn;

namespace {

/// How far a model reaches to the four sides of a camera's picture. A plane of the frustum through the point at distance
/// c from the middle holds the model on its inner side when c * slope is at least the reach; slope 0 is orthographic.
struct Reach {
    double right = 0, left = 0, above = 0, below = 0;

    void add(const Reach& other)
    {
        right = std::max(right, other.right);
        left = std::max(left, other.left);
        above = std::max(above, other.above);
        below = std::max(below, other.below);
    }
};

/// The slopes of the frustum's sides without the margin.
dvec2 slopes(const Camera& camera, double margin)
{
    if (camera.orthographic)
        return dvec2(0);
    const double y = std::tan(glm::radians(camera.fov_degrees) / 2) * (1 - 2 * margin);
    return {y * camera.size.x / camera.size.y, y};
}

Reach reach_of(const LineModel& model, const Camera& camera, double margin)
{
    const vec3 right(camera.right()), above(camera.above()), towards(-camera.forward());
    const vec3 middle = model.from_world(camera.look);
    const vec2 slope(slopes(camera, margin));
    const auto reach_of_block = [&](std::size_t begin, std::size_t end, std::vector<Reach>& out) {
        vec4 most(-std::numeric_limits<float>::infinity());
        for (std::size_t i = begin; i < end; ++i) {
            const vec3 p = model.positions[i] - middle;
            const float x = dot(p, right), y = dot(p, above), z = dot(p, towards);
            most = max(most, vec4(x + slope.x * z, -x + slope.x * z, y + slope.y * z, -y + slope.y * z));
        }
        out.push_back(
            {model.scale * double(most.x), model.scale * double(most.y), model.scale * double(most.z), model.scale * double(most.w)});
    };
    const std::vector<Reach> parts = parallel_collect<Reach>(model.vertex_count(), 1 << 15, reach_of_block);
    Reach all = parts.empty() ? Reach() : parts.front();
    for (const Reach& part : parts)
        all.add(part);
    return all;
}

/// Shifts the camera so that it reaches as far to the left as to the right, and as far up as down.
void centre(Camera& camera, Reach& reach)
{
    const dvec3 shift = camera.right() * ((reach.right - reach.left) / 2) + camera.above() * ((reach.above - reach.below) / 2);
    camera.eye += shift;
    camera.look += shift;
    reach.right = reach.left = (reach.right + reach.left) / 2;
    reach.above = reach.below = (reach.above + reach.below) / 2;
}

} // namespace

void fit_cameras(std::vector<Camera>& cameras, const LineModel& model, double margin)
{
    constexpr double least = 1e-3; // of the model's radius: a point or a line still gets a picture
    double distance = least * model.scale, height = 2 * least * model.scale;
    for (Camera& camera : cameras) {
        Reach reach = reach_of(model, camera, margin);
        if (cameras.size() == 1)
            centre(camera, reach);
        const double x = std::max(reach.right, reach.left), y = std::max(reach.above, reach.below);
        const dvec2 slope = slopes(camera, margin);
        if (!camera.orthographic)
            distance = std::max({distance, x / slope.x, y / slope.y});
        height = std::max({height, 2 * y / (1 - 2 * margin), 2 * x * camera.size.y / (camera.size.x * (1 - 2 * margin))});
    }
    for (Camera& camera : cameras) {
        if (!camera.orthographic)
            camera.eye = camera.look - distance * camera.forward();
        camera.ortho_height = height;
    }
}

void centre_in_picture(Camera& camera, const LineModel& model)
{
    constexpr int rounds = 8; // each leaves a small part of what the last one did
    for (int round = 0; round < rounds; ++round) {
        const Projector projector(model, camera);
        const std::vector<dvec4> parts = parallel_collect<dvec4>(model.vertex_count(), 1 << 15, [&](std::size_t begin, std::size_t end, std::vector<dvec4>& out) {
            dvec4 most(-std::numeric_limits<double>::infinity());
            for (std::size_t i = begin; i < end; ++i) {
                const dvec3 p = projector.project(model.positions[i]);
                most = glm::max(most, dvec4(p.x, -p.x, p.y, -p.y));
            }
            out.push_back(most);
        });
        dvec4 all(-std::numeric_limits<double>::infinity());
        for (const dvec4& part : parts)
            all = glm::max(all, part);
        const dvec2 off = (dvec2(all.x - all.y, all.z - all.w) - dvec2(camera.size)) / 2.0; // of the box's middle, pixels
        const double unit = 1 / camera.pixels_per_unit(glm::distance(camera.eye, camera.look));
        const dvec3 shift = unit * (off.x * camera.right() - off.y * camera.above());
        camera.eye += shift;
        camera.look += shift;
    }
}
