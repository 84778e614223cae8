// Jets of CGAL (GPL, Debian package libcgal-dev) beside limn's on one generated torus: seconds, and the relative rms error
// of the largest curvature. Built with -DLIMN_PEERS=ON only; nothing of limn links it.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "limn/geometry/adjacency.h"
#include "limn/surface/estimate.h"
#include "limn/surface/shapes.h"

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Fit = CGAL::Monge_via_jet_fitting<Kernel>;
using Point = Kernel::Point_3;

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The vertex and those within some rings around it; the vertex comes first.
std::vector<Point> ring_points(const limn::Mesh& mesh, const limn::VertexFaces& around, std::uint32_t vertex, int rings)
{
    std::vector<std::uint32_t> found = {vertex};
    for (std::size_t begin = 0; rings > 0; --rings) {
        const std::size_t end = found.size();
        for (std::size_t i = begin; i < end; ++i)
            for (std::uint32_t k = around.start[found[i]]; k < around.start[found[i] + 1]; ++k)
                for (int corner = 0; corner < 3; ++corner)
                    if (const std::uint32_t v = mesh.triangles[around.face[k]][corner]; std::find(found.begin(), found.end(), v) == found.end())
                        found.push_back(v);
        begin = end;
    }
    std::vector<Point> points;
    for (const std::uint32_t v : found)
        points.emplace_back(mesh.positions[v].x, mesh.positions[v].y, mesh.positions[v].z);
    return points;
}

std::vector<double> largest_curvature_by_cgal(const limn::Mesh& mesh, int rings)
{
    const limn::VertexFaces around = limn::build_vertex_faces(mesh.triangles, mesh.positions.size());
    std::vector<double> result(mesh.positions.size());
    tbb::parallel_for(std::size_t(0), result.size(), [&](std::size_t v) {
        const std::vector<Point> points = ring_points(mesh, around, std::uint32_t(v), rings);
        Fit fit;
        const auto form = fit(points.begin(), points.end(), 4, 3);
        result[v] = std::max(std::abs(form.principal_curvatures(0)), std::abs(form.principal_curvatures(1)));
    });
    return result;
}

template <class Values> double relative_error(const Values& values, const limn::Surface& exact)
{
    double error = 0, size = 0;
    for (std::size_t v = 0; v < exact.k1.size(); ++v) {
        const double truth = std::abs(double(exact.k1[v]));
        error += std::pow(std::abs(double(values[v])) - truth, 2);
        size += truth * truth;
    }
    return std::sqrt(error / size);
}

} // namespace

/// cgal_jets [TRIANGLES]
int main(int argc, char** argv)
{
    limn::ShapeOptions options;
    options.name = "torus";
    options.triangles = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 500000;
    options.jitter = 0.2;
    options.float_positions = false;
    const limn::Shape shape = limn::make_shape(options);
    limn::EstimateReport report;
    auto start = std::chrono::steady_clock::now();
    const limn::Surface ours = limn::estimate_surface(shape.mesh, {}, &report);
    const double our_seconds = seconds_since(start);
    start = std::chrono::steady_clock::now();
    const std::vector<double> theirs = largest_curvature_by_cgal(shape.mesh, report.radius);
    const double their_seconds = seconds_since(start);
    fmt::print("{} triangles, {} rings, degree 4: limn {:.3f} s, error {:.2e}; CGAL {:.2f} s, error {:.2e}; ratio {:.0f}\n", shape.mesh.triangles.size(),
               report.radius, our_seconds, relative_error(ours.k1, shape.exact), their_seconds, relative_error(theirs, shape.exact),
               their_seconds / our_seconds);
    return 0;
}
