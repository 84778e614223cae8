#include "limn/surface/shell_builder.h"

#include <cmath>
#include <numbers>

namespace limn {
namespace {

/// Two directions at right angles to one and to each other, which makes three right-handed ones with it.
void sides_of(const dvec3& along, dvec3& u, dvec3& v)
{
    u = glm::normalize(glm::cross(along, std::abs(along.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0)));
    v = glm::cross(along, u);
}

} // namespace

std::uint32_t ShellBuilder::add_vertex(const dvec3& p)
{
    mesh_.positions.push_back(p);
    return std::uint32_t(mesh_.positions.size() - 1);
}

void ShellBuilder::close_rings(std::uint32_t first, int rings, int sides, std::uint32_t start, std::uint32_t end)
{
    const auto at = [&](int ring, int side) { return first + std::uint32_t(ring * sides + side % sides); };
    for (int side = 0; side < sides; ++side) {
        mesh_.triangles.push_back({start, at(0, side + 1), at(0, side)});
        for (int ring = 0; ring + 1 < rings; ++ring) {
            mesh_.triangles.push_back({at(ring, side), at(ring, side + 1), at(ring + 1, side + 1)});
            mesh_.triangles.push_back({at(ring, side), at(ring + 1, side + 1), at(ring + 1, side)});
        }
        mesh_.triangles.push_back({end, at(rings - 1, side), at(rings - 1, side + 1)});
    }
}

void ShellBuilder::add_tube(std::span<const TubeStation> stations, int sides)
{
    const auto first = std::uint32_t(mesh_.positions.size());
    const int rings = int(stations.size());
    dvec3 u(0), v(0);
    for (std::size_t i = 0; i < stations.size(); ++i) {
        const dvec3 along = glm::normalize(stations[std::min(i + 1, stations.size() - 1)].at - stations[i > 0 ? i - 1 : 0].at);
        if (i == 0) {
            sides_of(along, u, v);
        } else { // without a twist: the last ring's side, made square
            u = glm::normalize(u - glm::dot(u, along) * along);
            v = glm::cross(along, u);
        }
        for (int side = 0; side < sides; ++side) {
            const double turn = 2 * std::numbers::pi * side / sides;
            add_vertex(stations[i].at + stations[i].radius * (std::cos(turn) * u + std::sin(turn) * v));
        }
    }
    const TubeStation &front = stations.front(), &back = stations.back();
    const std::uint32_t start = add_vertex(front.at - 0.5 * front.radius * glm::normalize(stations[1].at - front.at));
    const std::uint32_t end = add_vertex(back.at + 0.5 * back.radius * glm::normalize(back.at - stations[stations.size() - 2].at));
    close_rings(first, rings, sides, start, end);
}

void ShellBuilder::add_ellipsoid(const dvec3& centre, const dvec3 (&axes)[3], int sides, int rings)
{
    const auto first = std::uint32_t(mesh_.positions.size());
    for (int ring = 1; ring <= rings; ++ring) {
        const double polar = std::numbers::pi * ring / (rings + 1);
        for (int side = 0; side < sides; ++side) {
            const double turn = 2 * std::numbers::pi * side / sides;
            add_vertex(centre + std::sin(polar) * (std::cos(turn) * axes[0] + std::sin(turn) * axes[1]) - std::cos(polar) * axes[2]);
        }
    }
    const std::uint32_t start = add_vertex(centre - axes[2]), end = add_vertex(centre + axes[2]);
    close_rings(first, rings, sides, start, end);
}

void ShellBuilder::add_blade(const dvec3& root, const dvec3& tip, const dvec3& normal, const std::function<double(double)>& half_width, double bend, double thickness,
                             int segments)
{
    const dvec3 along = tip - root, up = glm::normalize(normal - glm::dot(normal, along) / glm::dot(along, along) * along), across = glm::normalize(glm::cross(up, along));
    const auto first = std::uint32_t(mesh_.positions.size());
    for (int i = 1; i < segments; ++i) {
        const double part = double(i) / segments, thick = 0.5 * thickness * std::sin(std::numbers::pi * part);
        const dvec3 middle = root + part * along + bend * std::sin(std::numbers::pi * part) * up;
        const double width = half_width(part);
        for (const dvec3& corner : {middle + width * across, middle + thick * up, middle - width * across, middle - thick * up})
            add_vertex(corner);
    }
    const std::uint32_t start = add_vertex(root), end = add_vertex(tip);
    close_rings(first, segments - 1, 4, start, end);
}

} // namespace limn
