#include "limn/surface/model_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "limn/base/error.h"
#include "limn/base/random.h"
#include "limn/surface/shell_builder.h"

namespace limn {
namespace {

// The tree: each branch carries some that are shorter and thinner; the last ones carry leaves.
constexpr int branch_levels = 4, branches_each = 4, leaves_each = 6, tube_sides = 6, tube_rings = 4;
constexpr double trunk_length = 1.0, trunk_radius = 0.06, shorter = 0.62, thinner = 0.55, leaf_length = 0.09;

/// Grows a tree. Where a direction is drawn, it is at some angle from that of what carries it.
class Tree {
public:
    explicit Tree(std::uint64_t seed) : random_(seed) {}
    Mesh grow()
    {
        branch({0, -1, 0}, {0, 1, 0}, trunk_length, trunk_radius, 0);
        return shells_.take();
    }

private:
    dvec3 leaning(const dvec3& along, double angle, double turn)
    {
        const dvec3 u = glm::normalize(glm::cross(along, std::abs(along.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0))), v = glm::cross(along, u);
        return std::cos(angle) * along + std::sin(angle) * (std::cos(turn) * u + std::sin(turn) * v);
    }

    void branch(const dvec3& from, const dvec3& along, double length, double radius, int level)
    {
        const dvec3 bent = leaning(along, random_.uniform(0.05, 0.25), random_.uniform(0, 2 * std::numbers::pi));
        std::vector<TubeStation> stations;
        for (int i = 0; i <= tube_rings; ++i) {
            const double part = double(i) / tube_rings;
            stations.push_back({from + length * part * glm::mix(along, bent, part), radius * (1 - 0.5 * part)});
        }
        shells_.add_tube(stations, tube_sides);
        const auto at = [&](double part) { return from + length * part * glm::mix(along, bent, part); };
        const double turn = random_.uniform(0, 2 * std::numbers::pi);
        const int count = level < branch_levels ? branches_each : leaves_each;
        for (int i = 0; i < count; ++i) {
            const double part = level < branch_levels ? 0.45 + 0.55 * (i + 1) / count : double(i + 1) / count;
            const dvec3 out = leaning(bent, random_.uniform(0.5, 0.9), turn + 2.4 * i + random_.uniform(-0.3, 0.3));
            if (level < branch_levels)
                branch(at(part), out, length * shorter * random_.uniform(0.85, 1.1), radius * thinner, level + 1);
            else
                leaf(at(part), out);
        }
    }

    void leaf(const dvec3& from, const dvec3& along)
    {
        const double length = leaf_length * random_.uniform(0.7, 1.2);
        const dvec3 normal = leaning(along, 0.5 * std::numbers::pi, random_.uniform(0, 2 * std::numbers::pi));
        shells_.add_blade(from, from + length * along, normal, [&](double part) { return 0.28 * length * std::sin(std::numbers::pi * std::pow(part, 0.7)); }, 0.1 * length,
                          0.008 * length, 3);
    }

    Random random_;
    ShellBuilder shells_;
};

Mesh tree(std::uint64_t seed) { return Tree(seed).grow(); }

/// A wing: broad behind its root, and slender at its tip.
void add_wing(ShellBuilder& shells, double side, double from, const dvec3& tip, double width)
{
    const dvec3 root = {side * 0.05, 0.06, from};
    shells.add_blade(root, {side * tip.x, tip.y, tip.z}, {0, 1, 0}, [&](double part) { return width * std::sqrt(std::sin(std::numbers::pi * std::pow(part, 1.2))); }, 0.04,
                     0.008, 24);
}

void add_leg(ShellBuilder& shells, double side, double z)
{
    const TubeStation stations[] = {{{side * 0.04, -0.03, z}, 0.012}, {{side * 0.2, 0.02, z + 0.05}, 0.01}, {{side * 0.3, -0.2, z + 0.1}, 0.008}, {{side * 0.38, -0.23, z + 0.14}, 0.005}};
    shells.add_tube(stations, 6);
}

Mesh dragonfly(std::uint64_t)
{
    ShellBuilder shells;
    std::vector<TubeStation> body;
    for (int i = 0; i <= 60; ++i) { // from the breast to the tail
        const double part = i / 60.0, breast = std::exp(-std::pow((part - 0.12) / 0.12, 2));
        body.push_back({{0, 0.03 * std::sin(3 * part), 0.3 - 1.25 * part}, 0.035 + 0.06 * breast + 0.004 * std::sin(60 * part) * (1 - breast)});
    }
    shells.add_tube(body, 24);
    shells.add_ellipsoid({0, 0.01, 0.37}, {{0.075, 0, 0}, {0, 0.065, 0}, {0, 0, 0.07}}, 24, 15);
    for (const double side : {-1.0, 1.0}) {
        shells.add_ellipsoid({side * 0.055, 0.035, 0.395}, {{0.045, 0, 0}, {0, 0.045, 0}, {0, 0, 0.045}}, 16, 11);
        add_wing(shells, side, 0.2, {0.95, 0.16, 0.32}, 0.1);
        add_wing(shells, side, 0.08, {0.9, 0.1, -0.12}, 0.14);
        for (const double z : {0.05, 0.13, 0.21})
            add_leg(shells, side, z);
    }
    return shells.take();
}

} // namespace

Mesh make_model_sample(const std::string& name, std::uint64_t seed)
{
    if (name == "tree")
        return tree(seed);
    if (name == "dragonfly")
        return dragonfly(seed);
    throw Error::Input(fmt::format("there is no model '{}'; known are {}", name, fmt::join(model_sample_names(), ", ")));
}

const std::vector<std::string>& model_sample_names()
{
    static const std::vector<std::string> names = {"tree", "dragonfly"};
    return names;
}

} // namespace limn
