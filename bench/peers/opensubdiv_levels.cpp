// Uniform Loop subdivision by OpenSubdiv (Debian package libosd-dev) on one thread, for `limn bench subdivision`, which runs this program
// where it finds it. Built with -DLIMN_PEERS=ON only; nothing of limn links it. Prints JSON: milliseconds of each run.

#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/osd/cpuEvaluator.h>

#include "limn/geometry/read_mesh.h"
#include "repeated.h"

namespace {

namespace Far = OpenSubdiv::Far;
namespace Osd = OpenSubdiv::Osd;

/// Three floats: what its own evaluators are made for.
struct Point {
    float x = 0, y = 0, z = 0;
    void Clear() { x = y = z = 0; }
    void AddWithWeight(const Point& other, float weight) { x += weight * other.x, y += weight * other.y, z += weight * other.z; }
};

/// The index buffer as it takes it.
struct Control {
    std::vector<int> sizes, corners;
    std::vector<Point> positions;
};

Control control_of(const limn::Mesh& mesh)
{
    Control control;
    control.sizes.assign(mesh.triangles.size(), 3);
    for (const limn::uvec3& t : mesh.triangles)
        control.corners.insert(control.corners.end(), {int(t.x), int(t.y), int(t.z)});
    for (const limn::dvec3& p : mesh.positions)
        control.positions.push_back({float(p.x), float(p.y), float(p.z)});
    return control;
}

using Refiner = std::unique_ptr<Far::TopologyRefiner>;

/// @param limit  also what limits at the last level ask for
Refiner refined_topology(const Control& control, int levels, bool limit)
{
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = int(control.positions.size());
    descriptor.numFaces = int(control.sizes.size());
    descriptor.numVertsPerFace = control.sizes.data();
    descriptor.vertIndicesPerFace = control.corners.data();
    OpenSubdiv::Sdc::Options options;
    options.SetVtxBoundaryInterpolation(OpenSubdiv::Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    Refiner refiner(Factory::Create(descriptor, Factory::Options(OpenSubdiv::Sdc::SCHEME_LOOP, options)));
    Far::TopologyRefiner::UniformOptions uniform(levels);
    uniform.fullTopologyInLastLevel = limit;
    refiner->RefineUniform(uniform);
    return refiner;
}

std::vector<std::vector<Point>> level_arrays(const Far::TopologyRefiner& refiner, const Control& control)
{
    std::vector<std::vector<Point>> all = {control.positions};
    for (int level = 1; level <= refiner.GetMaxLevel(); ++level)
        all.emplace_back(std::size_t(refiner.GetLevel(level).GetNumVertices()));
    return all;
}

void interpolate(const Far::TopologyRefiner& refiner, std::vector<std::vector<Point>>& points)
{
    const Far::PrimvarRefiner primvar(refiner);
    for (int level = 1; level < int(points.size()); ++level)
        primvar.Interpolate(level, points[std::size_t(level - 1)], points[std::size_t(level)]);
}

std::unique_ptr<const Far::StencilTable> stencils_of(const Far::TopologyRefiner& refiner, bool each_level)
{
    Far::StencilTableFactory::Options options;
    options.generateIntermediateLevels = each_level;
    options.factorizeIntermediateLevels = !each_level;
    options.generateOffsets = true;
    return std::unique_ptr<const Far::StencilTable>(Far::StencilTableFactory::Create(refiner, options));
}

std::vector<double> time_stencils(const Far::TopologyRefiner& refiner, const Control& control, bool each_level, int runs)
{
    const auto stencils = stencils_of(refiner, each_level);
    std::vector<Point> points = control.positions;
    points.resize(control.positions.size() + std::size_t(stencils->GetNumStencils()));
    float* const values = &points[0].x;
    const Osd::BufferDescriptor source(0, 3, 3), target(3 * int(control.positions.size()), 3, 3);
    const int* const sizes = stencils->GetSizes().data();
    return repeated(runs, [&] {
        Osd::CpuEvaluator::EvalStencils(values, source, values, target, sizes, stencils->GetOffsets().data(), stencils->GetControlIndices().data(),
                                        stencils->GetWeights().data(), 0, stencils->GetNumStencils());
    });
}

/// Limit positions and the unit normals there, in place of the last level's.
std::vector<double> time_limit(const Far::TopologyRefiner& refiner, const std::vector<Point>& last, int runs)
{
    std::vector<Point> positions(last.size()), u(last.size()), v(last.size()), normals(last.size());
    return repeated(runs, [&] {
        Far::PrimvarRefiner(refiner).Limit(last, positions, u, v);
        for (std::size_t i = 0; i < last.size(); ++i) {
            const Point &a = u[i], &b = v[i];
            const Point n = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
            const float scale = 1 / std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
            normals[i] = {scale * n.x, scale * n.y, scale * n.z};
        }
    });
}

} // namespace

/// opensubdiv_levels MODEL LEVELS RUNS
int main(int argc, char** argv)
{
    if (argc != 4) {
        fmt::print(stderr, "usage: opensubdiv_levels MODEL LEVELS RUNS\n");
        return 2;
    }
    const Control control = control_of(limn::read_mesh(argv[1]));
    const int levels = std::atoi(argv[2]), runs = std::atoi(argv[3]);
    nlohmann::json json;
    json["cold_ms"] = repeated(runs, [&] {
        const Refiner refiner = refined_topology(control, levels, false);
        std::vector<std::vector<Point>> points = level_arrays(*refiner, control);
        interpolate(*refiner, points);
    });
    const Refiner refiner = refined_topology(control, levels, true);
    std::vector<std::vector<Point>> points = level_arrays(*refiner, control);
    json["refiner_ms"] = repeated(runs, [&] { interpolate(*refiner, points); });
    json["level_stencils_ms"] = time_stencils(*refiner, control, true, runs);
    json["last_stencils_ms"] = time_stencils(*refiner, control, false, runs);
    json["limit_ms"] = time_limit(*refiner, points.back(), runs);
    json["triangles"] = refiner->GetLevel(levels).GetNumFaces();
    fmt::print("{}\n", json.dump());
    return 0;
}
