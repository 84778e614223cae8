#include "limn/shadow/depth_layers.h"

#include <algorithm>
#include <cmath>

namespace limn {
namespace {

constexpr int fraction_bits = 14;
constexpr std::int32_t one_texel = 1 << fraction_bits, half_texel = one_texel / 2;
constexpr float same_surface = 1e-6f;

/// A side of a triangle, from a to b: positive on its left, the inner side.
struct Side {
    std::int64_t step_u, step_v, value;
    bool owns; ///< whether middles on it belong to the triangle: it is a lower or a right side
};

Side side_of(std::int64_t au, std::int64_t av, std::int64_t bu, std::int64_t bv, std::int64_t u, std::int64_t v)
{
    const std::int64_t du = bu - au, dv = bv - av;
    return {-dv, du, du * (v - av) - dv * (u - au), dv > 0 || (dv == 0 && du > 0)};
}

/// The first texel whose middle is at or after a coordinate, and the last at or before it.
int first_texel(std::int32_t c) { return (c - half_texel + one_texel - 1) >> fraction_bits; }
int last_texel(std::int32_t c) { return (c - half_texel) >> fraction_bits; }

void add_depth(float z, float& near, float& far)
{
    if (z < near) {
        if (near > z + same_surface)
            far = near;
        near = z;
    } else if (z > near + same_surface && z < far) {
        far = z;
    }
}

} // namespace

DepthPainter::DepthPainter(const ShadowCaster& caster, int size, OpenBack back) : caster_(caster), back_(back), vertices_(caster.x.size())
{
    const std::size_t texels = std::size_t(size) * std::size_t(size);
    layers_.size = size;
    layers_.near.resize(texels);
    layers_.far.resize(texels);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const float u = (2 * float(x) + 1) / float(size) - 1, v = (2 * float(y) + 1) / float(size) - 1;
            sphere_exit_.push_back(0.5f + 0.5f * std::sqrt(std::max(0.0f, 1 - u * u - v * v)));
        }
}

const DepthLayers& DepthPainter::paint(const MapFrame& frame)
{
    std::fill(layers_.near.begin(), layers_.near.end(), no_surface);
    std::fill(layers_.far.begin(), layers_.far.end(), no_surface);
    project(frame);
    for (const uvec3& triangle : caster_.triangles)
        paint(triangle);
    close_backs();
    return layers_;
}

void DepthPainter::project(const MapFrame& frame)
{
    const float scale = 0.5f * float(layers_.size) * float(one_texel);
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
        const float x = caster_.x[i], y = caster_.y[i], z = caster_.z[i];
        const float u = frame.right.x * x + frame.right.y * y + frame.right.z * z, v = frame.up.x * x + frame.up.y * y + frame.up.z * z;
        const float w = frame.towards.x * x + frame.towards.y * y + frame.towards.z * z;
        vertices_[i] = {std::int32_t(std::floor((u + 1) * scale + 0.5f)), std::int32_t(std::floor((v + 1) * scale + 0.5f)), 0.5f - 0.5f * w};
    }
}

void DepthPainter::paint(const uvec3& triangle)
{
    const Vertex *a = &vertices_[triangle.x], *b = &vertices_[triangle.y], *c = &vertices_[triangle.z];
    const int low_x = std::max(0, first_texel(std::min({a->u, b->u, c->u}))), high_x = std::min(layers_.size - 1, last_texel(std::max({a->u, b->u, c->u})));
    const int low_y = std::max(0, first_texel(std::min({a->v, b->v, c->v}))), high_y = std::min(layers_.size - 1, last_texel(std::max({a->v, b->v, c->v})));
    if (low_x > high_x || low_y > high_y)
        return;
    std::int64_t area = std::int64_t(b->u - a->u) * (c->v - a->v) - std::int64_t(b->v - a->v) * (c->u - a->u);
    if (area == 0)
        return;
    if (area < 0)
        std::swap(b, c), area = -area;
    const std::int64_t u = std::int64_t(low_x) * one_texel + half_texel, v = std::int64_t(low_y) * one_texel + half_texel;
    Side sides[3] = {side_of(b->u, b->v, c->u, c->v, u, v), side_of(c->u, c->v, a->u, a->v, u, v), side_of(a->u, a->v, b->u, b->v, u, v)};
    const float share = 1 / float(area);
    for (int y = low_y; y <= high_y; ++y) {
        std::int64_t value[3] = {sides[0].value, sides[1].value, sides[2].value};
        for (int x = low_x; x <= high_x; ++x) {
            const auto covers = [&](int k) { return value[k] > 0 || (value[k] == 0 && sides[k].owns); };
            if (covers(0) && covers(1) && covers(2)) {
                const std::size_t texel = std::size_t(y) * std::size_t(layers_.size) + std::size_t(x);
                add_depth(a->z + (float(value[1]) * (b->z - a->z) + float(value[2]) * (c->z - a->z)) * share, layers_.near[texel], layers_.far[texel]);
            }
            for (int k = 0; k < 3; ++k)
                value[k] += sides[k].step_u * one_texel;
        }
        for (Side& side : sides)
            side.value += side.step_v * one_texel;
    }
}

void DepthPainter::close_backs()
{
    for (std::size_t i = 0; i < layers_.near.size(); ++i)
        if (layers_.far[i] == no_surface && layers_.near[i] != no_surface)
            layers_.far[i] = back_ == OpenBack::constant ? layers_.near[i] + open_thickness : std::max(sphere_exit_[i], layers_.near[i] + same_surface);
}

} // namespace limn
