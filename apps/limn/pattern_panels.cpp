#include "pattern_panels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit_camera.h"
#include "limn/surface/shapes.h"

using namespace limn;

namespace {

/// Upright, on z = 0.
Mesh cone(double radius, double height, int sides)
{
    Mesh mesh;
    for (int i = 0; i < sides; ++i) {
        const double turn = 2 * std::numbers::pi * i / sides;
        mesh.positions.emplace_back(radius * std::cos(turn), radius * std::sin(turn), 0);
    }
    const std::uint32_t n = std::uint32_t(sides);
    mesh.positions.emplace_back(0, 0, 0);
    mesh.positions.emplace_back(0, 0, height);
    for (std::uint32_t i = 0; i < n; ++i) {
        mesh.triangles.push_back({i, (i + 1) % n, n + 1});
        mesh.triangles.push_back({(i + 1) % n, i, n});
    }
    return mesh;
}

/// A block whose top falls along x.
Mesh wedge(const dvec3& size, double low)
{
    Mesh mesh;
    for (int k = 0; k < 8; ++k) {
        const bool far = k & 1;
        mesh.positions.emplace_back(far ? size.x : 0, k & 2 ? size.y : 0, k & 4 ? (far ? low : size.z) : 0);
    }
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
    };
    quad(0, 2, 3, 1);
    quad(4, 5, 7, 6);
    quad(0, 1, 5, 4);
    quad(2, 6, 7, 3);
    quad(0, 4, 6, 2);
    quad(1, 3, 7, 5);
    return mesh;
}

} // namespace

Image in_rows(const std::vector<std::vector<Image>>& rows, int gap)
{
    ivec2 size(0);
    for (const std::vector<Image>& row : rows) {
        int width = 0, height = 0;
        for (const Image& image : row) {
            width += image.width + (width > 0 ? gap : 0);
            height = std::max(height, image.height);
        }
        size.x = std::max(size.x, width);
        size.y += height + (size.y > 0 ? gap : 0);
    }
    Image whole(size, 3);
    std::fill(whole.samples.begin(), whole.samples.end(), 1.0f);
    int y = 0;
    for (const std::vector<Image>& row : rows) {
        int x = 0, height = 0;
        for (const Image& image : row) {
            for (int line = 0; line < image.height; ++line)
                std::copy_n(image.at(0, line), 3 * image.width, whole.at(x, y + line));
            x += image.width + gap;
            height = std::max(height, image.height);
        }
        y += height + gap;
    }
    return whole;
}

std::vector<NamedMesh> print_shapes()
{
    return {{"sphere", make_shape({.name = "sphere", .triangles = 40000}).mesh},
            {"cone", cone(1, 1.5, 180)},
            {"wedge", wedge({2.2, 1.3, 1}, 0.15)},
            {"blob", make_shape({.name = "blob", .triangles = 40000}).mesh}};
}

Camera filling_camera(const SceneModel& model, const std::string& view, const ivec2& size)
{
    std::vector<Camera> camera = {Camera::framing(model.bounds, {.view = view, .up_axis = 'z', .size = size})};
    fit_cameras(camera, model.lines, 0.05);
    centre_in_picture(camera.front(), model.lines);
    return camera.front();
}
