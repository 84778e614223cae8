#include "limn/gpu/clip.h"

namespace limn::gpu {
namespace {

/// Depths between which the model lies, in its frame.
dvec2 depth_range(const Projector& projector)
{
    constexpr double radius = 1.01; // of the sphere around the model, a little more
    const double middle = -glm::dot(projector.eye, projector.forward);
    const double far = middle + radius, near = middle - radius;
    return {projector.orthographic ? near : std::max(near, 1e-3 * std::max(far, 1e-3)), std::max(far, 2e-3)};
}

} // namespace

std::vector<Tile> tiles_of(ivec2 picture, int largest)
{
    std::vector<Tile> tiles;
    for (int y = 0; y < picture.y; y += largest)
        for (int x = 0; x < picture.x; x += largest)
            tiles.push_back({ivec2(x, y), min(ivec2(largest), picture - ivec2(x, y))});
    return tiles;
}

Tile with_border(const Tile& tile, int border, ivec2 picture)
{
    const ivec2 low = max(tile.corner - border, ivec2(0)), high = min(tile.corner + tile.size + border, picture);
    return {low, high - low};
}

void copy_tile(Image& picture, const Image& drawn, const Tile& outer, const Tile& inner)
{
    const ivec2 first = inner.corner - outer.corner;
    for (int y = 0; y < inner.size.y; ++y)
        std::copy_n(drawn.at(first.x, first.y + y), inner.size.x * drawn.channels, picture.at(inner.corner.x, inner.corner.y + y));
}

glm::mat4 clip_matrix(const Projector& p, const Tile& tile, const dvec2& offset)
{
    const dvec2 range = depth_range(p), size = dvec2(tile.size), scale = 2 * p.scale / size;
    // The tile's middle lies beside the picture's, where the eye looks.
    const dvec2 beside = 2.0 * (p.middle - dvec2(tile.corner) - offset) / size - 1.0;
    glm::dmat4 to_eye(1);
    for (int k = 0; k < 3; ++k) {
        to_eye[k] = {p.right[k], p.above[k], p.forward[k], 0};
        to_eye[3][k] = 0;
    }
    to_eye[3] = {-glm::dot(p.eye, p.right), -glm::dot(p.eye, p.above), -glm::dot(p.eye, p.forward), 1};
    glm::dmat4 to_clip(0);
    to_clip[0][0] = scale.x;
    to_clip[1][1] = scale.y;
    const int w = p.orthographic ? 3 : 2; // what becomes the clip position's w
    to_clip[w][0] = beside.x;
    to_clip[w][1] = -beside.y;
    to_clip[w][3] = 1;
    if (p.orthographic) {
        to_clip[2][2] = 2 / (range.y - range.x);
        to_clip[3][2] = -(range.y + range.x) / (range.y - range.x);
    } else {
        to_clip[2][2] = (range.y + range.x) / (range.y - range.x);
        to_clip[3][2] = -2 * range.x * range.y / (range.y - range.x);
    }
    return glm::mat4(to_clip * to_eye);
}

} // namespace limn::gpu
