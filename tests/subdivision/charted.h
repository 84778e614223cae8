#pragma once

#include "limn/subdivision/control_samples.h"
#include "limn/subdivision/loop_limit.h"
#include "limn/subdivision/normal_map.h"

namespace limn::test {

/// A control mesh with its limit surface and the layout of its map.
struct Charted {
    Mesh mesh;
    ControlMesh control;
    std::vector<dvec3> limit;
    PatchTable table;
    LimitShape shape;
    MapLayout layout;

    Charted(const Mesh& from, const NormalMapOptions& options)
        : mesh(from), control(make_control_mesh(from)), limit(limit_positions(control.topology, control.positions)), table(control.topology),
          shape(table, control.positions), layout(lay_out_map(control.topology, limit, options))
    {
    }
};

inline double degrees_between(const dvec3& a, const dvec3& b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

} // namespace limn::test
