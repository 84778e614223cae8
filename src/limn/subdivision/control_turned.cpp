#include <array>
#include <cmath>
#include <numbers>

#include "limn/subdivision/cage_builder.h"
#include "limn/subdivision/control_shapes.h"

namespace limn {
namespace {

using Row = CageBuilder::Row;

constexpr double turn = 2 * std::numbers::pi;

/// A level ring around the y axis, counter-clockwise from above.
Row level_ring(CageBuilder& cage, std::size_t count, double radius, double y, double shift = 0)
{
    Row ring;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = turn * (double(i) + shift) / double(count);
        ring.push_back(cage.vertex({radius * std::cos(angle), y, -radius * std::sin(angle)}));
    }
    return ring;
}

/// A ring of a turned profile.
struct Turned {
    double radius, y;
    float sharpness = 0;
};

std::vector<Row> turned_rings(CageBuilder& cage, std::size_t count, std::span<const Turned> profile)
{
    std::vector<Row> rings;
    for (const Turned& t : profile) {
        rings.push_back(level_ring(cage, count, t.radius, t.y));
        if (t.sharpness > 0)
            cage.crease_ring(rings.back(), t.sharpness);
        if (rings.size() > 1)
            cage.closed_band(rings[rings.size() - 2], rings.back());
    }
    return rings;
}

/// Closes a ring at the bottom, or at the top: half as many vertices, then a fan.
void close_ring(CageBuilder& cage, const Row& ring, double radius, double y, bool bottom)
{
    const Row half = level_ring(cage, ring.size() / 2, radius, y, 0.25);
    cage.halving_band(ring, half, !bottom);
    cage.fan(bottom ? Row(half.rbegin(), half.rend()) : half, {0, y, 0});
}

} // namespace

Mesh rook_cage()
{
    constexpr std::size_t count = 12;
    const Turned profile[] = {{0.62, 0, 10}, {0.62, 0.16, 2}, {0.5, 0.27, 2}, {0.52, 0.36}, {0.36, 0.6}, {0.31, 1.0}, {0.36, 1.22},
                              {0.5, 1.3, 3}, {0.5, 1.38, 3}, {0.44, 1.42, 2}, {0.46, 1.68, 4}, {0.32, 1.68, 4}, {0.3, 1.56, 2}};
    CageBuilder cage;
    const std::vector<Row> rings = turned_rings(cage, count, profile);
    close_ring(cage, rings.front(), 0.34, 0, true);
    close_ring(cage, rings.back(), 0.16, 1.55, false);
    const Row &outer = rings[10], &inner = rings[11];
    for (std::size_t i = 0; i < count; i += 2) {
        const Row base = {outer[i], outer[i + 1], inner[i + 1], inner[i]};
        const Row top = cage.extrude(base, [](const dvec3& p) { return p + dvec3(0, 0.2, 0); });
        cage.crease_ring(top, 4);
        for (std::size_t k = 0; k < 4; ++k)
            cage.crease(base[k], top[k], 4);
        cage.crease(outer[i], inner[i], 4);
        cage.crease(outer[i + 1], inner[i + 1], 4);
    }
    return cage.mesh();
}

Mesh mug_cage()
{
    constexpr std::size_t count = 12;
    const Turned profile[] = {{0.54, 0, 10}, {0.62, 0.07, 2}, {0.64, 0.4}, {0.63, 0.7}, {0.63, 1.02}, {0.64, 1.32}, {0.66, 1.5, 4},
                              {0.58, 1.5, 4}, {0.56, 1.2}, {0.55, 0.8}, {0.54, 0.4}, {0.42, 0.14}};
    CageBuilder cage;
    const std::vector<Row> rings = turned_rings(cage, count, profile);
    close_ring(cage, rings.front(), 0.3, 0.03, true);
    close_ring(cage, rings.back(), 0.22, 0.1, false);

    // The handle runs from a face of the wall through four sections to a face further down. The faces' middle is half a step from the x axis.
    const auto wall_face = [&](std::size_t ring) { return Row{rings[ring][0], rings[ring][1], rings[ring + 1][1], rings[ring + 1][0]}; };
    const double half_step = turn / double(count) / 2;
    const dvec3 out(std::cos(half_step), 0, -std::sin(half_step)), along(-std::sin(half_step), 0, -std::cos(half_step));
    // A section's corners in the order of those of the wall's face. At angle 0 the handle leaves the wall, at half a turn it comes back.
    const auto section = [&](double distance, double y, double angle, double half_width, double half_height) {
        const dvec3 normal = std::cos(angle) * dvec3(0, 1, 0) + std::sin(angle) * out;
        const dvec3 middle = distance * out + dvec3(0, y, 0);
        const dvec3 side = half_width * along, up = half_height * normal;
        return std::array<dvec3, 4>{middle - side - up, middle + side - up, middle + side + up, middle - side + up};
    };
    const std::array<dvec3, 4> path[] = {section(0.86, 1.21, 0.2, 0.11, 0.085), section(1.06, 1.02, turn / 6, 0.1, 0.07), section(1.08, 0.76, turn * 0.3, 0.1, 0.065),
                                         section(0.9, 0.56, turn * 0.42, 0.1, 0.075)};
    const Row high = wall_face(4);
    Row end = high;
    for (const std::array<dvec3, 4>& corners : path) {
        const Row before = end;
        std::size_t next = 0;
        end = cage.extrude(end, [&](const dvec3&) { return corners[next++]; });
        for (std::size_t k = 0; k < 4 && before != high; ++k)
            cage.crease(before[k], end[k], 1);
    }
    const Row low = wall_face(2);
    cage.remove_face(end);
    cage.remove_face(low);
    cage.closed_band(end, {low[3], low[2], low[1], low[0]});
    return cage.mesh();
}

Mesh bent_cylinder_cage()
{
    constexpr std::size_t sides = 8, steps = 9;
    constexpr double big = 1, small = 0.34, angle = turn * 3 / 8;
    CageBuilder cage;
    // Counter-clockwise seen from ahead, where the path runs counter-clockwise around the z axis.
    const auto ring = [&](double at, double beyond, double radius) {
        const dvec3 out(std::cos(at), std::sin(at), 0), ahead(-std::sin(at), std::cos(at), 0);
        Row row;
        for (std::size_t i = 0; i < sides; ++i) {
            const double a = -turn * double(i) / sides;
            row.push_back(cage.vertex(big * out + beyond * ahead + radius * (std::cos(a) * out + std::sin(a) * dvec3(0, 0, 1))));
        }
        return row;
    };
    const double first = turn / 4 - angle / 2;
    std::vector<Row> rings = {ring(first, -0.28, 0.22)};
    for (std::size_t i = 0; i < steps; ++i)
        rings.push_back(ring(first + angle * double(i) / (steps - 1), 0, small));
    rings.push_back(ring(first + angle, 0.28, 0.22));
    for (std::size_t i = 0; i + 1 < rings.size(); ++i)
        cage.closed_band(rings[i], rings[i + 1]);
    const auto end = [&](double at, double beyond) { return dvec3(big * std::cos(at) - beyond * std::sin(at), big * std::sin(at) + beyond * std::cos(at), 0); };
    cage.fan(Row(rings.front().rbegin(), rings.front().rend()), end(first, -0.36));
    cage.fan(rings.back(), end(first + angle, 0.36));
    return cage.mesh();
}

} // namespace limn
