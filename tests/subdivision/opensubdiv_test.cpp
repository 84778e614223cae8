#include <gtest/gtest.h>

#include <memory>

#include <fmt/format.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include "subdivision/control_meshes.h"

// OpenSubdiv as an independent implementation of the rule that has its name (tests only).

namespace limn::test {
namespace {

namespace Far = OpenSubdiv::Far;

struct Point {
    dvec3 p = dvec3(0);
    void Clear() { p = dvec3(0); }
    void AddWithWeight(const Point& other, double weight) { p += weight * other.p; }
};

/// The vertices of a mesh after some levels by OpenSubdiv, in its order.
std::vector<dvec3> refined_by_opensubdiv(const Mesh& mesh, int levels)
{
    std::vector<int> sizes(mesh.triangles.size(), 3), corners, crease_vertices;
    std::vector<float> crease_sharpness;
    for (const uvec3& t : mesh.triangles)
        corners.insert(corners.end(), {int(t.x), int(t.y), int(t.z)});
    for (const CreaseEdge& crease : mesh.creases) {
        crease_vertices.insert(crease_vertices.end(), {int(crease.a), int(crease.b)});
        crease_sharpness.push_back(crease.sharpness);
    }
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = int(mesh.positions.size());
    descriptor.numFaces = int(mesh.triangles.size());
    descriptor.numVertsPerFace = sizes.data();
    descriptor.vertIndicesPerFace = corners.data();
    descriptor.numCreases = int(mesh.creases.size());
    descriptor.creaseVertexIndexPairs = crease_vertices.data();
    descriptor.creaseWeights = crease_sharpness.data();
    OpenSubdiv::Sdc::Options options;
    options.SetVtxBoundaryInterpolation(OpenSubdiv::Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    const std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(descriptor, Factory::Options(OpenSubdiv::Sdc::SCHEME_LOOP, options)));
    refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(levels));
    std::vector<Point> points(mesh.positions.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i].p = mesh.positions[i];
    for (int level = 1; level <= levels; ++level) {
        std::vector<Point> next(std::size_t(refiner->GetLevel(level).GetNumVertices()));
        Far::PrimvarRefinerReal<double>(*refiner).Interpolate(level, points, next);
        points.swap(next);
    }
    std::vector<dvec3> positions;
    for (const Point& point : points)
        positions.push_back(point.p);
    return positions;
}

double distance_to_nearest(const dvec3& p, const std::vector<dvec3>& points)
{
    double least = 1e300;
    for (const dvec3& q : points)
        least = std::min(least, glm::distance(p, q));
    return least;
}

TEST(OpenSubdiv, AgreesWithItsRuleOnEveryMesh)
{
    double worst = 0;
    for (const auto& [name, mesh] : various_meshes()) {
        const std::vector<dvec3> ours = refined(mesh, 3).positions, theirs = refined_by_opensubdiv(mesh, 3);
        ASSERT_EQ(ours.size(), theirs.size()) << name;
        for (const dvec3& p : ours)
            worst = std::max(worst, distance_to_nearest(p, theirs));
        for (const dvec3& p : theirs)
            worst = std::max(worst, distance_to_nearest(p, ours));
        ASSERT_LT(worst, 1e-6) << name;
    }
    RecordProperty("worst", fmt::format("{:.3g}", worst));
}

} // namespace
} // namespace limn::test
