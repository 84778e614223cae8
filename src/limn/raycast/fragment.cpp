#include "limn/raycast/fragment.h"

#include <algorithm>
#include <cmath>

namespace limn {
namespace {

double radius_of(const SeenScene& scene)
{
    float squared = 0;
    for (const SeenObject& object : scene.objects)
        for (const vec3& p : object.triangles.positions)
            squared = std::max(squared, glm::dot(p, p));
    return std::sqrt(double(squared));
}

vec3 unit_or(const vec3& v, const vec3& otherwise)
{
    const float length = glm::length(v);
    return length > 0 ? v / length : otherwise;
}

} // namespace

std::uint32_t SeenScene::part_of(std::uint32_t object, std::uint32_t triangle) const
{
    if (first_face.empty())
        return object;
    return std::uint32_t(std::upper_bound(first_face.begin() + 1, first_face.end() - 1, triangle) - first_face.begin() - 1);
}

FragmentTracer::FragmentTracer(const SeenScene& scene, const Camera& camera)
    : scene_(scene), camera_(camera), forward_(camera.forward()), right_(camera.right()), above_(camera.above()),
      world_per_pixel_(1 / camera.pixels_per_unit(1)), radius_(radius_of(scene))
{
}

Camera::Ray FragmentTracer::sight(const dvec2& pixel) const
{
    const dvec2 offset = (pixel - 0.5 * dvec2(camera_.size)) * world_per_pixel_;
    const dvec3 side = right_ * offset.x - above_ * offset.y;
    return {((camera_.orthographic ? camera_.eye + side : camera_.eye) - scene_.centre) / scene_.scale,
            camera_.orthographic ? forward_ : glm::normalize(forward_ + side)};
}

Fragment FragmentTracer::at(const dvec2& pixel) const { return beyond(pixel, nullptr); }
Fragment FragmentTracer::behind(const dvec2& pixel, const Fragment& fragment) const { return beyond(pixel, &fragment); }

Fragment FragmentTracer::beyond(const dvec2& pixel, const Fragment* before) const
{
    const auto [eye, direction] = sight(pixel);
    // The float ray starts close to the objects, so that a far eye costs no precision.
    const double skipped = std::max(0.0, -glm::dot(eye, direction) - 1.001 * radius_);
    const dvec3 start = eye + skipped * direction;

    constexpr double off = 1e-5; // in the frame of the scene, whose objects are about 1 in radius
    Ray ray = {vec3(start), vec3(direction)};
    if (before)
        ray.near = float(glm::dot(dvec3(before->position) - start, direction) + off);
    const Hit hit = scene_.rays->closest(ray);
    Fragment fragment;
    if (!hit)
        return fragment;
    const SeenObject& object = scene_.objects[hit.object];
    const uvec3& t = object.triangles.triangles[hit.triangle];
    const vec3 &a = object.triangles.positions[t.x], &b = object.triangles.positions[t.y], &c = object.triangles.positions[t.z];
    const float weight = 1 - hit.u - hit.v;
    fragment.object = hit.object;
    fragment.triangle = hit.triangle;
    fragment.u = hit.u, fragment.v = hit.v;
    fragment.position = weight * a + hit.u * b + hit.v * c;
    fragment.depth = float(scene_.scale * (skipped + double(hit.distance)) * glm::dot(direction, forward_));
    fragment.to_eye = vec3(-direction);
    fragment.face_normal = unit_or(glm::cross(b - a, c - a), fragment.to_eye);
    fragment.normal = fragment.face_normal;
    if (object.normal_at)
        fragment.normal = object.normal_at(hit.triangle, hit.u, hit.v);
    else if (!object.normals.empty())
        fragment.normal = unit_or(weight * object.normals[t.x] + hit.u * object.normals[t.y] + hit.v * object.normals[t.z], fragment.face_normal);
    return fragment;
}

std::vector<dvec2> sample_pattern(int count)
{
    std::vector<dvec2> pattern;
    pattern.reserve(std::size_t(count));
    // Golden-ratio steps visit the columns in an order without clumps; sorting them gives each its own cell.
    std::vector<std::pair<double, int>> order;
    for (int i = 0; i < count; ++i)
        order.push_back({std::fmod((i + 0.5) * 0.6180339887498949, 1.0), i});
    std::sort(order.begin(), order.end());
    for (int column = 0; column < count; ++column)
        pattern.push_back({(column + 0.5) / count, (order[std::size_t(column)].second + 0.5) / count});
    return pattern;
}

} // namespace limn
