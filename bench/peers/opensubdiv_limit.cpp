// How far from the limit surface OpenSubdiv's evaluators (Debian package libosd-dev) and limn's are, at places inside faces, for `limn bench
// subdivision`, which runs this program where it finds it. Built with -DLIMN_PEERS=ON only; nothing of limn links it. Prints JSON.

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include "limit_truth.h"

namespace {

namespace Far = OpenSubdiv::Far;
namespace Bfr = OpenSubdiv::Bfr;

using limn::dvec3;

struct Point {
    dvec3 p = dvec3(0);
    void Clear() { p = dvec3(0); }
    void AddWithWeight(const Point& other, double weight) { p += weight * other.p; }
};

using Refiner = std::unique_ptr<Far::TopologyRefiner>;

Refiner control_topology(const limn::Mesh& mesh)
{
    std::vector<int> sizes(mesh.triangles.size(), 3), corners, crease_vertices;
    std::vector<float> crease_sharpness;
    for (const limn::uvec3& t : mesh.triangles)
        corners.insert(corners.end(), {int(t.x), int(t.y), int(t.z)});
    for (const limn::CreaseEdge& crease : mesh.creases) {
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
    return Refiner(Factory::Create(descriptor, Factory::Options(OpenSubdiv::Sdc::SCHEME_LOOP, options)));
}

struct Found {
    dvec3 position = dvec3(0), u = dvec3(0), v = dvec3(0); ///< u x v points outside
};

/// Far::PatchTable with its default end caps and depth (10), and with its patches for sharp edges (without them normals at creases are off by up
/// to 70 degrees), in double.
class FarSurface {
public:
    explicit FarSurface(const limn::Mesh& mesh) : refiner_(control_topology(mesh))
    {
        Far::PatchTableFactory::Options options;
        options.SetPatchPrecision<double>();
        options.useInfSharpPatch = true;
        refiner_->RefineAdaptive(options.GetRefineAdaptiveOptions());
        patches_.reset(Far::PatchTableFactory::Create(*refiner_, options));
        map_ = std::make_unique<Far::PatchMap>(*patches_);
        for (const dvec3& p : mesh.positions)
            points_.push_back({p});
        points_.resize(std::size_t(refiner_->GetNumVerticesTotal() + patches_->GetNumLocalPoints()));
        const Far::PrimvarRefinerReal<double> primvar(*refiner_);
        Point* source = points_.data();
        for (int level = 1; level <= refiner_->GetMaxLevel(); ++level) {
            Point* const target = source + refiner_->GetLevel(level - 1).GetNumVertices();
            primvar.Interpolate(level, source, target);
            source = target;
        }
        if (patches_->GetNumLocalPoints() > 0)
            patches_->GetLocalPointStencilTable<double>()->UpdateValues(points_.data(), points_.data() + refiner_->GetNumVerticesTotal());
    }
    Found at(const limn::PatchPoint& place) const
    {
        const Far::PatchTable::PatchHandle* const handle = map_->FindPatch(int(place.face), place.v, place.w);
        double weights[20], along_u[20], along_v[20];
        patches_->EvaluateBasis(*handle, place.v, place.w, weights, along_u, along_v);
        const Far::ConstIndexArray vertices = patches_->GetPatchVertices(*handle);
        Found found;
        for (int i = 0; i < vertices.size(); ++i) {
            const dvec3& p = points_[std::size_t(vertices[i])].p;
            found.position += weights[i] * p;
            found.u += along_u[i] * p;
            found.v += along_v[i] * p;
        }
        return found;
    }

private:
    Refiner refiner_;
    std::unique_ptr<Far::PatchTable> patches_;
    std::unique_ptr<Far::PatchMap> map_;
    std::vector<Point> points_;
};

/// Bfr::Surface with its default options, in double.
class BfrSurface {
public:
    explicit BfrSurface(const limn::Mesh& mesh) : refiner_(control_topology(mesh)), factory_(*refiner_, Bfr::SurfaceFactory::Options()), faces_(mesh.triangles.size())
    {
        const Bfr::Surface<double>::PointDescriptor xyz(3);
        for (std::size_t f = 0; f < faces_.size(); ++f) {
            Face& face = faces_[f];
            factory_.InitVertexSurface(int(f), &face.surface);
            face.points.resize(3 * std::size_t(face.surface.GetNumPatchPoints()));
            face.surface.PreparePatchPoints(&mesh.positions[0].x, xyz, face.points.data(), xyz);
        }
    }
    Found at(const limn::PatchPoint& place) const
    {
        const Face& face = faces_[place.face];
        const double uv[2] = {place.v, place.w};
        Found found;
        face.surface.Evaluate(uv, face.points.data(), Bfr::Surface<double>::PointDescriptor(3), &found.position.x, &found.u.x, &found.v.x);
        return found;
    }

private:
    struct Face {
        Bfr::Surface<double> surface;
        std::vector<double> points;
    };
    Refiner refiner_;
    Bfr::RefinerSurfaceFactory<> factory_;
    std::vector<Face> faces_;
};

class OwnSurface {
public:
    explicit OwnSurface(const limn::Mesh& mesh) : control_(limn::make_control_mesh(mesh)), table_(control_.topology), shape_(table_, control_.positions) {}
    Found at(const limn::PatchPoint& place) const
    {
        const dvec3 n = shape_.normal(place), side = std::abs(n.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
        const dvec3 u = glm::normalize(glm::cross(side, n)); // any two directions whose cross product is the normal
        return {shape_.position(place), u, glm::cross(n, u)};
    }

private:
    limn::ControlMesh control_;
    limn::PatchTable table_;
    limn::LimitShape shape_;
};

double degrees_between(const dvec3& a, const dvec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi; }

double mean_edge(const limn::Mesh& mesh)
{
    double sum = 0;
    for (const limn::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            sum += glm::distance(mesh.positions[t[k]], mesh.positions[t[(k + 1) % 3]]);
    return sum / double(3 * mesh.triangles.size());
}

/// The greatest distance to the true position, in mean edges of the control mesh, and angle to the true normal, in degrees.
template <class Surface> nlohmann::json errors_of(const limn::Mesh& mesh, const std::vector<LimitSample>& truth)
{
    const Surface surface(mesh);
    double distance = 0, angle = 0;
    for (const LimitSample& sample : truth) {
        const Found found = surface.at(sample.at);
        distance = std::max(distance, glm::distance(found.position, sample.position));
        angle = std::max(angle, degrees_between(glm::cross(found.u, found.v), sample.normal));
    }
    return {{"edges", distance / mean_edge(mesh)}, {"degrees", angle}};
}

} // namespace

int main()
{
    nlohmann::json rows = nlohmann::json::array();
    for (const LimitSubject& subject : limit_subjects()) {
        const std::vector<LimitSample> truth = limit_truth(subject.mesh);
        rows.push_back({{"name", subject.name},
                        {"places", truth.size()},
                        {"limn", errors_of<OwnSurface>(subject.mesh, truth)},
                        {"bfr", errors_of<BfrSurface>(subject.mesh, truth)},
                        {"far", errors_of<FarSurface>(subject.mesh, truth)}});
    }
    fmt::print("{}\n", nlohmann::json{{"rows", rows}}.dump());
    return 0;
}
