#include <cmath>
#include <numbers>

#include "limn/subdivision/cage_builder.h"
#include "limn/subdivision/control_shapes.h"

namespace limn {
namespace {

using Row = CageBuilder::Row;

/// A cross-section of the animal: its centre in the plane z = 0, how far its plane is tilted from upright, half its height and width.
struct Section {
    double x, y, tilt; ///< degrees; 90: the animal runs straight up there
    double height, width;
};

/// From the tip of the tail to the nose.
constexpr Section sections[] = {{-1.63, 1.16, -62, 0.02, 0.018}, {-1.50, 0.93, -56, 0.13, 0.12}, {-1.27, 0.73, -24, 0.165, 0.145},
                                {-1.00, 0.71, 12, 0.125, 0.11}, {-0.78, 0.79, 24, 0.08, 0.075}, {-0.64, 0.82, 10, 0.17, 0.15},
                                {-0.46, 0.80, 4, 0.25, 0.22}, {-0.18, 0.78, 0, 0.24, 0.215}, {0.08, 0.77, 0, 0.21, 0.19},
                                {0.28, 0.77, 0, 0.24, 0.21}, {0.50, 0.80, 12, 0.25, 0.2}, {0.67, 0.95, 42, 0.19, 0.15},
                                {0.78, 1.12, 48, 0.16, 0.14}, {0.86, 1.27, 26, 0.19, 0.2}, {1.01, 1.32, 2, 0.19, 0.22},
                                {1.08, 1.305, -5, 0.175, 0.195}, {1.19, 1.265, -14, 0.135, 0.14}, {1.32, 1.215, -14, 0.085, 0.08},
                                {1.42, 1.19, -10, 0.062, 0.06}, {1.45, 1.185, 0, 0.036, 0.036}};
constexpr std::size_t hip = 6, shoulder = 9, head = 13, brow = 14;
/// Half a section's vertices, from the back to the belly.
constexpr double angles[] = {90, 58, 18, -26, -62, -90};

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180; }

Row half_section(CageBuilder& cage, const Section& s)
{
    const dvec3 up(-std::sin(radians(s.tilt)), std::cos(radians(s.tilt)), 0);
    Row row;
    for (const double angle : angles) {
        const bool middle = std::abs(angle) == 90;
        const dvec3 p = dvec3(s.x, s.y, 0) + s.height * std::sin(radians(angle)) * up;
        row.push_back(cage.vertex({p.x, p.y, middle ? 0 : s.width * std::cos(radians(angle))}));
    }
    return row;
}

/// A level rectangle that a leg runs through.
struct LegSection {
    double x, y, z;
    double half_length, half_width;
};

/// Pulls a leg out of the face between two sections, flank and belly, and makes its sole flat.
void add_leg(CageBuilder& cage, const Row& back, const Row& front, std::span<const LegSection> leg)
{
    Row face = {back[3], back[4], front[4], front[3]};
    const double middle = (cage.position(back[3]).x + cage.position(front[3]).x) / 2;
    const dvec3 outer = (cage.position(back[3]) + cage.position(front[3])) / 2.0, inner = (cage.position(back[4]) + cage.position(front[4])) / 2.0;
    double x = middle, z = (outer.z + inner.z) / 2;
    for (const LegSection& to : leg) {
        face = cage.extrude(face, [&](const dvec3& p) {
            return dvec3(to.x + (p.x > x ? 1 : -1) * to.half_length, to.y, to.z + (p.z > z ? 1 : -1) * to.half_width);
        });
        x = to.x;
        z = to.z;
    }
    cage.crease_ring(face, 3);
}

/// Flatter than the head's face that it grows from, hollow in front.
void add_ear(CageBuilder& cage, const Row& back, const Row& front)
{
    const Row base = {back[1], back[2], front[2], front[1]};
    dvec3 middle(0);
    for (const std::uint32_t v : base)
        middle += cage.position(v) / 4.0;
    const auto section = [&](const dvec3& offset, double scale) {
        return [=](const dvec3& p) { return middle + offset + scale * (p - middle) * dvec3(0.4, 1, 1); };
    };
    const Row half = cage.extrude(base, section({-0.05, 0.15, 0.035}, 1.05));
    middle += dvec3(-0.05, 0.15, 0.035);
    const Row tip = cage.extrude(half, [&](const dvec3& p) { return middle + dvec3(-0.02, 0.17, 0.02) + 0.3 * (p - middle); });
    for (std::size_t k = 0; k < 4; ++k)
        cage.crease(half[k], tip[k], 1.5f);
    cage.crease_ring(tip, 1.5f);
}

/// A round bulge with a crease around it.
void add_eye(CageBuilder& cage, const Row& back, const Row& front)
{
    const Row face = {back[1], back[2], front[2], front[1]};
    const dvec3 a = cage.position(face[0]), b = cage.position(face[1]), c = cage.position(face[2]), d = cage.position(face[3]);
    const dvec3 middle = (a + b + c + d) / 4.0, out = glm::normalize(glm::cross(b - d, c - a));
    const Row rim = cage.extrude(face, [&](const dvec3& p) { return middle + 0.6 * (p - middle) + 0.004 * out; });
    cage.crease_ring(rim, 4);
    cage.extrude(rim, [&](const dvec3& p) { return middle + 0.55 * (p - middle) + 0.045 * out; });
}

} // namespace

Mesh creature_cage()
{
    CageBuilder cage;
    std::vector<Row> rows;
    for (const Section& s : sections) {
        rows.push_back(half_section(cage, s));
        if (rows.size() > 1)
            cage.band(rows[rows.size() - 2], rows.back());
    }
    cage.ladder(Row(rows.front().rbegin(), rows.front().rend()));
    cage.ladder(rows.back());
    cage.crease_row(rows[rows.size() - 2], 1);
    const LegSection hind[] = {{-0.33, 0.43, 0.17, 0.11, 0.07}, {-0.42, 0.26, 0.17, 0.06, 0.05}, {-0.41, 0.1, 0.17, 0.05, 0.045}, {-0.37, 0, 0.17, 0.095, 0.06}};
    const LegSection fore[] = {{0.41, 0.45, 0.16, 0.08, 0.06}, {0.41, 0.25, 0.16, 0.055, 0.05}, {0.4, 0.09, 0.16, 0.048, 0.045}, {0.44, 0, 0.16, 0.09, 0.06}};
    add_leg(cage, rows[hip], rows[hip + 1], hind);
    add_leg(cage, rows[shoulder], rows[shoulder + 1], fore);
    add_ear(cage, rows[head], rows[brow]);
    add_eye(cage, rows[brow + 1], rows[brow + 2]);
    cage.mirror();
    return cage.mesh();
}

} // namespace limn
