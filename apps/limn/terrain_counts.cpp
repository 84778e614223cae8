#include "terrain_counts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "bench_peers.h"
#include "limn/base/file.h"
#include "limn/base/parallel.h"
#include "limn/geometry/read_mesh.h"
#include "limn/terrain/delaunay_mesh.h"
#include "limn/terrain/measure_terrain.h"
#include "limn/terrain/terrain_mesh.h"
#include "scratch_folder.h"
#include "timed.h"

using namespace limn;

namespace {

template <class F> CountedMesh counted_mesh(const HeightMap& map, double bound, int runs, F&& make)
{
    CountedMesh counted;
    Mesh mesh;
    counted.ms = median_ms(runs, [&] { mesh = make(); });
    counted.triangles = mesh.triangles.size();
    counted.maximum = measure_terrain(map, mesh, bound).maximum;
    return counted;
}

/// A peer's mesh, whose x is the column and y the row, in the map's own coordinates.
Mesh read_grid_mesh(const HeightMap& map, const std::string& path)
{
    Mesh mesh = read_mesh(path);
    for (dvec3& p : mesh.positions)
        p = {p.x * map.spacing.x, (map.rows - 1 - p.y) * map.spacing.y, p.z};
    return mesh;
}

std::string list_of(const std::vector<double>& numbers)
{
    std::string text;
    for (const double number : numbers)
        text += fmt::format(" {}", number);
    return text;
}

/// A map as the peers read it.
class GridFile {
public:
    explicit GridFile(const HeightMap& map) : map_(map)
    {
        std::string bytes(map.heights.size() * sizeof(float), '\0');
        std::memcpy(bytes.data(), map.heights.data(), bytes.size());
        write_file(path(), bytes);
    }
    std::string path() const { return (folder_ / "heights").string(); }

    struct Meshes {
        double setup_ms = 0;
        std::vector<CountedMesh> each;
    };
    /// By a method of grid_meshes.
    Meshes run(const std::string& peer, const std::string& method, const std::vector<double>& parameters, int runs) const
    {
        const std::string prefix = (folder_ / "mesh").string();
        const nlohmann::json result = result_of_peer(peer, fmt::format("{} '{}' {} {} '{}'{}", method, path(), map_.columns, runs, prefix, list_of(parameters)));
        Meshes meshes{result["setup_ms"], {}};
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            const Mesh mesh = read_grid_mesh(map_, fmt::format("{}.{}.ply", prefix, i));
            meshes.each.push_back({mesh.triangles.size(), measure_terrain(map_, mesh, parameters[i]).maximum, median(result["rows"][i]["ms"].get<std::vector<double>>())});
        }
        return meshes;
    }

private:
    const HeightMap& map_;
    ScratchFolder folder_;
};

/// The coarsest of martini's meshes that holds a bound: its parameter is searched for in steps of an eighth of an octave, then in eighths of these.
std::optional<CountedMesh> tuned_martini(const GridFile& grid, const std::string& peer, double bound, int runs)
{
    constexpr int coarse = 40, fine = 8;
    const auto parameters = [&](double first, int count, double step) {
        std::vector<double> all;
        for (int i = 0; i < count; ++i)
            all.push_back(first * std::exp2(-i * step));
        return all;
    };
    const auto first_that_holds = [&](const std::vector<CountedMesh>& meshes) {
        return std::find_if(meshes.begin(), meshes.end(), [&](const CountedMesh& mesh) { return mesh.maximum <= bound; });
    };
    const std::vector<double> tries = parameters(bound, coarse, 1.0 / fine);
    const std::vector<CountedMesh> meshes = grid.run(peer, "martini", tries, 1).each;
    const auto found = first_that_holds(meshes);
    if (found == meshes.end())
        return std::nullopt;
    const double above = tries[std::size_t(found - meshes.begin())] * std::exp2(1.0 / fine);
    const std::vector<CountedMesh> nearer = grid.run(peer, "martini", parameters(above, fine + 1, 1.0 / (fine * fine)), runs).each;
    const auto nearest = first_that_holds(nearer);
    return nearest == nearer.end() ? *found : *nearest;
}

bool peers_can_have(const HeightMap& map)
{
    return map.columns == map.rows && std::has_single_bit(unsigned(map.columns - 1)) && std::none_of(map.heights.begin(), map.heights.end(), [](float h) { return std::isnan(h); });
}

void add_peers(const HeightMap& map, const std::vector<double>& bounds, int runs, const TerrainPeers& peers, TerrainCounts& counts)
{
    const GridFile grid(map);
    if (peers.rtin) {
        const nlohmann::json result = result_of_peer(*peers.rtin, fmt::format("'{}' {}{}", grid.path(), map.columns, list_of(bounds)));
        counts.rtin_errors_ms = result["errors_ms"];
        for (std::size_t i = 0; i < bounds.size(); ++i)
            counts.bounds[i].rtin = result["triangles"][i];
    }
    if (!peers.grid_meshes)
        return;
    const GridFile::Meshes delatin = grid.run(*peers.grid_meshes, "delatin", bounds, runs), martini = grid.run(*peers.grid_meshes, "martini", bounds, runs);
    counts.martini_setup_ms = martini.setup_ms;
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        counts.bounds[i].delatin = delatin.each[i];
        counts.bounds[i].martini = martini.each[i];
        counts.bounds[i].tuned = tuned_martini(grid, *peers.grid_meshes, bounds[i], runs);
    }
}

} // namespace

TerrainPeers find_terrain_peers() { return {find_peer("conservative_rtin"), find_peer("grid_meshes")}; }

TerrainCounts count_triangles(const HeightMap& map, const std::vector<double>& bounds, int runs, const TerrainPeers& peers)
{
    return with_threads(1, [&] {
        TerrainCounts counts;
        NestedErrors errors;
        counts.errors_ms = median_ms(runs, [&] { errors = nest_errors(map); });
        for (const double bound : bounds) {
            BoundCounts& of = counts.bounds.emplace_back();
            of.bound = bound;
            of.strict = counted_mesh(map, bound, runs, [&] { return terrain_mesh(map, errors.lattice, triangles_within(errors, bound)); });
            of.delaunay = counted_mesh(map, bound, runs, [&] { return delaunay_mesh_within(map, bound); });
            of.inserted = counted_mesh(map, bound, runs, [&] { return delaunay_mesh_within(map, bound, {.simplify = false}); });
        }
        if (peers_can_have(map))
            add_peers(map, bounds, runs, peers, counts);
        return counts;
    });
}
