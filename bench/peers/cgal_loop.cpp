// Loop subdivision by CGAL (GPL, Debian package libcgal-dev) on one thread, for `limn bench subdivision`, which runs this program where it
// finds it. Built with -DLIMN_PEERS=ON only; nothing of limn links it. Prints JSON: milliseconds of each run.

#include <cstdlib>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "limn/geometry/read_mesh.h"
#include "repeated.h"

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

SurfaceMesh connected(const limn::Mesh& mesh)
{
    SurfaceMesh out;
    out.reserve(SurfaceMesh::size_type(mesh.positions.size()), SurfaceMesh::size_type(3 * mesh.triangles.size() / 2), SurfaceMesh::size_type(mesh.triangles.size()));
    for (const limn::dvec3& p : mesh.positions)
        out.add_vertex({p.x, p.y, p.z});
    for (const limn::uvec3& t : mesh.triangles)
        out.add_face(SurfaceMesh::Vertex_index(t.x), SurfaceMesh::Vertex_index(t.y), SurfaceMesh::Vertex_index(t.z));
    return out;
}

} // namespace

/// cgal_loop MODEL LEVELS RUNS
int main(int argc, char** argv)
{
    if (argc != 4) {
        fmt::print(stderr, "usage: cgal_loop MODEL LEVELS RUNS\n");
        return 2;
    }
    const limn::Mesh mesh = limn::read_mesh(argv[1]);
    const unsigned levels = unsigned(std::atoi(argv[2]));
    const int runs = std::atoi(argv[3]);
    nlohmann::json json;
    std::size_t triangles = 0;
    json["cold_ms"] = repeated(runs, [&] {
        SurfaceMesh fine = connected(mesh);
        CGAL::Subdivision_method_3::Loop_subdivision(fine, CGAL::parameters::number_of_iterations(levels));
        triangles = fine.number_of_faces();
    });
    json["connect_ms"] = repeated(runs, [&] { connected(mesh); });
    json["triangles"] = triangles;
    fmt::print("{}\n", json.dump());
    return 0;
}
