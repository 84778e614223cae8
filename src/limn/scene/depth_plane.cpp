#include "limn/scene/depth_plane.h"

#include <array>
#include <cmath>
#include <optional>

namespace limn {
namespace {

constexpr int sample_count = 28;

/// Evenly over the unit disc: steps of the golden angle.
const std::array<vec2, sample_count>& disc_samples()
{
    static const std::array<vec2, sample_count> samples = [] {
        std::array<vec2, sample_count> s;
        for (int k = 0; k < sample_count; ++k) {
            const double r = std::sqrt((k + 0.5) / sample_count), a = 2.399963229728653 * k;
            s[std::size_t(k)] = vec2(dvec2(r * std::cos(a), r * std::sin(a)));
        }
        return s;
    }();
    return samples;
}

struct Sample {
    double x, y; ///< pixels from the middle one
    double depth;
    double value; ///< what is affine over a plane: 1 / depth, or depth
    double weight;
};

/// value = a + b x + c y by least squares.
std::optional<dvec3> affine_fit(const std::array<Sample, sample_count + 1>& samples, int count)
{
    double w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, v = 0, xv = 0, yv = 0;
    for (int k = 0; k < count; ++k) {
        const Sample& s = samples[std::size_t(k)];
        w += s.weight, x += s.weight * s.x, y += s.weight * s.y;
        xx += s.weight * s.x * s.x, xy += s.weight * s.x * s.y, yy += s.weight * s.y * s.y;
        v += s.weight * s.value, xv += s.weight * s.x * s.value, yv += s.weight * s.y * s.value;
    }
    if (!(w > 0))
        return std::nullopt;
    const double mx = x / w, my = y / w, mv = v / w;
    const double cxx = xx - w * mx * mx, cxy = xy - w * mx * my, cyy = yy - w * my * my, cxv = xv - w * mx * mv, cyv = yv - w * my * mv;
    const double det = cxx * cyy - cxy * cxy;
    if (!(det > 1e-3 * cxx * cyy) || !(cxx * cyy > 1e-3))
        return std::nullopt;
    const double b = (cxv * cyy - cyv * cxy) / det, c = (cyv * cxx - cxv * cxy) / det;
    return dvec3(mv - b * mx - c * my, b, c);
}

} // namespace

DepthPicture::DepthPicture(const Camera& camera, double scale)
    : size_(camera.size), orthographic_(camera.orthographic), forward_(camera.forward()),
      depths_(std::size_t(size_.x) * std::size_t(size_.y))
{
    const double pixel = 1 / camera.pixels_per_unit(1), factor = orthographic_ ? pixel / scale : pixel;
    right_ = factor * camera.right();
    down_ = -factor * camera.above();
}

vec3 DepthPicture::normal_at(int px, int py, int radius, float thick) const
{
    const double middle = double(depth(px, py));
    if (!(middle > 0))
        return vec3(0);
    std::array<Sample, sample_count + 1> samples;
    int count = 0;
    const auto add = [&](int x, int y, double weight) {
        if (x < 0 || y < 0 || x >= size_.x || y >= size_.y)
            return;
        const double d = double(depth(x, y));
        if (d > 0)
            samples[std::size_t(count++)] = {double(x - px), double(y - py), d, orthographic_ ? d : 1 / d, weight};
    };
    add(px, py, 3);
    for (const vec2& s : disc_samples())
        add(px + int(std::lround(s.x * float(radius))), py + int(std::lround(s.y * float(radius))), 1);
    if (count < sample_count / 4)
        return vec3(0);
    const dvec2 from_middle = dvec2(px + 0.5, py + 0.5) - 0.5 * dvec2(size_);
    const double r2 = glm::dot(right_, right_), d2 = glm::dot(down_, down_);
    dvec3 normal(0);
    double kept = 0;
    for (const double slack : {6.0, 3.0, 1.5, 1.0}) { // what is far off goes first
        const std::optional<dvec3> fit = affine_fit(samples, count);
        if (!fit)
            return vec3(0);
        const double a = fit->x - fit->y * from_middle.x - fit->z * from_middle.y; // at the middle of the picture
        normal = orthographic_ ? forward_ - (fit->y / r2) * right_ - (fit->z / d2) * down_
                               : a * forward_ + (fit->y / r2) * right_ + (fit->z / d2) * down_;
        normal = -glm::normalize(normal);
        kept = 0;
        for (int k = 0; k < count; ++k) {
            Sample& s = samples[std::size_t(k)];
            const double value = fit->x + fit->y * s.x + fit->z * s.y, plane = orthographic_ ? value : 1 / value;
            const dvec2 at = from_middle + dvec2(s.x, s.y);
            const dvec3 sight = orthographic_ ? forward_ : forward_ + at.x * right_ + at.y * down_;
            const double off = std::abs((s.depth - plane) * glm::dot(normal, sight)) / (slack * double(thick));
            s.weight = off < 1 ? (1 - off * off) * (1 - off * off) : 0; // Tukey's
            kept += s.weight > 0;
        }
    }
    const bool fits = samples[0].weight > 0 && kept > 0.4 * count;
    const dvec3 sight = orthographic_ ? forward_ : forward_ + from_middle.x * right_ + from_middle.y * down_;
    if (!fits || glm::dot(normal, sight) > -0.02 * glm::length(sight))
        return vec3(0);
    return vec3(normal);
}

} // namespace limn
