#include "limn/shadow/depth_layers.h"

#include <algorithm>
#include <cmath>

namespace limn {
namespace {

constexpr int fraction_bits = map_fraction_bits;
constexpr std::int32_t one_texel = 1 << fraction_bits, half_texel = one_texel / 2;

/// A side of a triangle, with the triangle on its left: what it is about a place that moves from middle to middle.
struct Side {
    std::int64_t value;          ///< positive on its left
    std::int64_t step_u, step_v; ///< of the value, from texel to texel
    bool owns;                   ///< whether middles on it belong to the triangle: it is a lower or a right side

    bool covers() const { return value > 0 || (value == 0 && owns); }
};

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

BackCloser::BackCloser(int size, OpenBack back) : back_(back)
{
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const float u = (2 * float(x) + 1) / float(size) - 1, v = (2 * float(y) + 1) / float(size) - 1;
            sphere_exit_.push_back(0.5f + 0.5f * std::sqrt(std::max(0.0f, 1 - u * u - v * v)));
        }
}

void BackCloser::close(DepthLayers& layers) const
{
    for (std::size_t i = 0; i < layers.near.size(); ++i)
        if (layers.far[i] == no_surface && layers.near[i] != no_surface)
            layers.far[i] = back_ == OpenBack::constant ? layers.near[i] + open_thickness : std::max(sphere_exit_[i], layers.near[i] + same_surface);
}

DepthPainter::DepthPainter(const ShadowCaster& caster, int size, OpenBack back)
    : caster_(caster), size_(size), closer_(size, back), vertices_(caster.x.size())
{
}

void DepthPainter::paint(const MapFrame& frame, DepthLayers& layers)
{
    const std::size_t texels = std::size_t(size_) * std::size_t(size_);
    layers.size = size_;
    layers.near.assign(texels, no_surface);
    layers.far.assign(texels, no_surface);
    project(frame);
    find_candidate_triangles(caster_.triangles, vertices_, candidates_);
    for (const std::uint32_t triangle : candidates_)
        paint(caster_.triangles[triangle], layers);
    closer_.close(layers);
}

void DepthPainter::project(const MapFrame& frame)
{
    const float scale = 0.5f * float(size_) * float(one_texel);
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
        const float x = caster_.x[i], y = caster_.y[i], z = caster_.z[i];
        const float u = frame.right.x * x + frame.right.y * y + frame.right.z * z, v = frame.up.x * x + frame.up.y * y + frame.up.z * z;
        const float w = frame.towards.x * x + frame.towards.y * y + frame.towards.z * z;
        // Whole numbers of what is not below 0: to the nearest.
        vertices_[i] = {std::int32_t((u + 1) * scale + 0.5f), std::int32_t((v + 1) * scale + 0.5f), 0.5f - 0.5f * w};
    }
}

void DepthPainter::paint(const uvec3& triangle, DepthLayers& layers) const
{
    const MapVertex *const a = &vertices_[triangle.x], *const b = &vertices_[triangle.y], *const c = &vertices_[triangle.z];
    const int low_x = std::max(0, first_texel(std::min({a->u, b->u, c->u}))), high_x = std::min(size_ - 1, last_texel(std::max({a->u, b->u, c->u})));
    const int low_y = std::max(0, first_texel(std::min({a->v, b->v, c->v}))), high_y = std::min(size_ - 1, last_texel(std::max({a->v, b->v, c->v})));
    if (low_x > high_x || low_y > high_y)
        return;
    // Twice the areas of the triangles that each side makes with the first middle.
    const std::int32_t u = low_x * one_texel + half_texel, v = low_y * one_texel + half_texel;
    const std::int64_t au = a->u - u, av = a->v - v, bu = b->u - u, bv = b->v - v, cu = c->u - u, cv = c->v - v;
    const std::int64_t beside_a = bu * cv - bv * cu, beside_b = cu * av - cv * au, beside_c = au * bv - av * bu;
    const std::int64_t area = beside_a + beside_b + beside_c, sign = area < 0 ? -1 : 1;
    const bool single = low_x == high_x && low_y == high_y;
    if (area == 0 || (single && ((sign * beside_a) | (sign * beside_b) | (sign * beside_c)) < 0))
        return;
    const auto side = [&](std::int64_t value, std::int64_t du, std::int64_t dv) {
        du *= sign, dv *= sign;
        return Side{sign * value, -dv * one_texel, du * one_texel, dv > 0 || (dv == 0 && du > 0)};
    };
    Side sides[3] = {side(beside_a, cu - bu, cv - bv), side(beside_b, au - cu, av - cv), side(beside_c, bu - au, bv - av)};
    const float share = 1 / float(sign * area), to_b = b->z - a->z, to_c = c->z - a->z;
    for (int y = low_y; y <= high_y; ++y) {
        Side at[3] = {sides[0], sides[1], sides[2]};
        for (int x = low_x; x <= high_x; ++x) {
            if (at[0].covers() && at[1].covers() && at[2].covers()) {
                const std::size_t texel = std::size_t(y) * std::size_t(size_) + std::size_t(x);
                add_depth(a->z + (float(at[1].value) * to_b + float(at[2].value) * to_c) * share, layers.near[texel], layers.far[texel]);
            }
            for (Side& s : at)
                s.value += s.step_u;
        }
        for (Side& s : sides)
            s.value += s.step_v;
    }
}

} // namespace limn
