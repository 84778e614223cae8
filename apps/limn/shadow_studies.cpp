#include "shadow_studies.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "console.h"
#include "limn/base/error.h"
#include "limn/geometry/read_mesh.h"
#include "limn/shadow/bake_maps.h"
#include "limn/shadow/cube_codec.h"
#include "limn/shadow/haar_layers.h"
#include "limn/shadow/map_clusters.h"
#include "limn/shadow/map_codec.h"
#include "limn/shadow/map_quality.h"
#include "limn/shadow/place_look_up.h"
#include "limn/shadow/shadow_error.h"
#include "limn/surface/model_samples.h"
#include "limn/surface/shapes.h"
#include "shadow_times.h"
#include "timed.h"

using namespace limn;

namespace {

constexpr const char* bunny_file = "/usr/share/glmark2/models/bunny.obj";
constexpr MapOrder orders[] = {MapOrder::theta_zigzag, MapOrder::theta_linear, MapOrder::hilbert, MapOrder::phi_linear, MapOrder::phi_zigzag};

bool is_among(const std::vector<std::string>& names, const std::string& name) { return std::find(names.begin(), names.end(), name) != names.end(); }

double megabytes(std::size_t bytes) { return double(bytes) / (1 << 20); } // as the seed's tables have it

std::string size_text(std::size_t bytes) { return fmt::format("{:.3f}", megabytes(bytes)); }

std::string ratio_text(const ShadowMaps& maps) { return fmt::format("{:.1f}", double(maps.info().uncompressed_bytes()) / double(maps.bytes().size())); }

template <class Look> AskShadows asking(const Look& look)
{
    return [&look](std::span<const ShadowQuery> queries, std::span<Verdict> verdicts) { look.at(queries, verdicts); };
}

/// % of places that face the light.
double error_on_object(const CasterRays& rays, const ShadowMaps& maps)
{
    const LookUp<ShadowMaps> look(maps.layout(), maps);
    return object_shadow_error(rays, asking(look)).of_facing();
}

/// The seed's maps on the largest square grid whose file is no larger.
ShadowMaps seed_maps_within(const Mesh& mesh, std::size_t bytes, int resolution)
{
    int fits = 1;
    for (int step = 64; step > 0; step /= 2)
        if (bake_shadow_maps(mesh, seed_options((fits + step) * (fits + step), resolution)).bytes().size() <= bytes)
            fits += step;
    return bake_shadow_maps(mesh, seed_options(fits * fits, resolution));
}

std::string error_text(double error) { return fmt::format("{:.2f}", error); }

std::vector<DepthLayers> all_maps(const ShadowCaster& caster, int maps, int resolution)
{
    std::vector<DepthLayers> all;
    const BakeOptions options = seed_options(maps, resolution);
    bake_maps(caster, bake_grid(options), options.order, resolution, [&](std::uint32_t, const DepthLayers& layers) { all.push_back(layers); });
    return all;
}

/// One of the six ways to lay the poles: on x, y or z, and turned over.
Mesh turned(Mesh mesh, int axis, bool over)
{
    for (dvec3& p : mesh.positions) {
        p = axis == 0 ? dvec3(p.z, p.x, p.y) : axis == 1 ? p : dvec3(p.y, p.z, p.x);
        if (over)
            p = {p.x, -p.y, -p.z};
    }
    return mesh;
}

} // namespace

ShadowSubject shadow_subject(const std::string& name, std::size_t triangles)
{
    if (is_among(model_sample_names(), name))
        return {name, make_model_sample(name)};
    if (is_among(shape_names(), name))
        return {name, make_shape({.name = name, .triangles = triangles}).mesh};
    return {std::filesystem::path(name).stem().string(), read_mesh(name)};
}

std::vector<std::string> shadow_subject_names()
{
    std::vector<std::string> names = {"sphere", "blob", "knot", "dragonfly", "tree"};
    if (std::filesystem::exists(bunny_file))
        names.insert(names.begin() + 1, bunny_file);
    return names;
}

BakeOptions seed_options(int maps, int resolution)
{
    BakeOptions options;
    options.maps = maps, options.resolution = resolution;
    options.codec = ShadowCodec::segments;
    options.margin = 0;
    return options;
}

void add_sizes(const ShadowSubject& subject, const std::vector<int>& counts, int resolution, MarkdownTable& table)
{
    const CasterRays rays(make_shadow_caster(subject.mesh));
    for (const int count : counts) {
        BakeOptions options;
        options.maps = count, options.resolution = resolution;
        const ShadowMaps seed = bake_shadow_maps(subject.mesh, seed_options(count, resolution));
        Stopwatch watch;
        const ShadowMaps bricks = bake_shadow_maps(subject.mesh, options);
        const double seconds = watch.total();
        table.add({subject.name, with_thousands(std::size_t(count)), size_text(seed.bytes().size()), ratio_text(seed), error_text(error_on_object(rays, seed)),
                   size_text(bricks.bytes().size()), ratio_text(bricks), error_text(error_on_object(rays, bricks)),
                   fmt::format("{:.1f}", double(seed.bytes().size()) / double(bricks.bytes().size())), fmt::format("{:.1f}", seconds)});
    }
}

void add_orders(const ShadowSubject& subject, int maps, int resolution, MarkdownTable& table)
{
    std::vector<std::string> row = {subject.name};
    double zigzag = 0;
    for (const MapOrder order : orders) {
        BakeOptions options = seed_options(maps, resolution);
        options.order = order;
        const std::size_t bytes = bake_shadow_maps(subject.mesh, options).bytes().size();
        if (zigzag == 0)
            zigzag = double(bytes);
        row.push_back(fmt::format("{} ({:.2f})", size_text(bytes), double(bytes) / zigzag));
    }
    table.add(row);
}

void add_resolutions(const ShadowSubject& subject, const std::vector<int>& counts, const std::vector<int>& resolutions, MarkdownTable& table)
{
    for (const int count : counts)
        for (const int resolution : resolutions) {
            BakeOptions options;
            options.maps = count, options.resolution = resolution;
            const ShadowMaps seed = bake_shadow_maps(subject.mesh, seed_options(count, resolution)), bricks = bake_shadow_maps(subject.mesh, options);
            table.add({subject.name, with_thousands(std::size_t(count)), std::to_string(resolution), size_text(seed.bytes().size()), ratio_text(seed),
                       size_text(bricks.bytes().size()), ratio_text(bricks)});
        }
}

void add_spreads(const ShadowSubject& subject, const std::vector<int>& counts, int resolution, MarkdownTable& table)
{
    const CasterRays rays(make_shadow_caster(subject.mesh));
    for (const int count : counts) {
        std::vector<std::string> row = {subject.name, with_thousands(std::size_t(count))};
        for (const DirectionSpread spread : {DirectionSpread::even, DirectionSpread::polar, DirectionSpread::octahedral}) {
            BakeOptions options = seed_options(count, resolution);
            options.spread = spread;
            const ShadowMaps maps = bake_shadow_maps(subject.mesh, options);
            row.push_back(fmt::format("{} / {}", size_text(maps.bytes().size()), error_text(error_on_object(rays, maps))));
        }
        table.add(row);
    }
}

void add_orientations(const ShadowSubject& subject, int maps, int resolution, MarkdownTable& table)
{
    std::vector<std::string> row = {subject.name};
    for (const int axis : {0, 1, 2})
        for (const bool over : {false, true}) {
            const Mesh mesh = turned(subject.mesh, axis, over);
            const ShadowMaps baked = bake_shadow_maps(mesh, seed_options(maps, resolution));
            row.push_back(fmt::format("{} / {}", size_text(baked.bytes().size()), error_text(error_on_object(CasterRays(make_shadow_caster(mesh)), baked))));
        }
    table.add(row);
}

void add_compressors(const ShadowSubject& subject, int count, int resolution, MarkdownTable& table)
{
    const std::vector<DepthLayers> maps = all_maps(make_shadow_caster(subject.mesh), count, resolution);
    PixelCodec pixels(maps[0].near.size());
    MapLists by_map(resolution, MapOrder::hilbert);
    CubeLists cubes(resolution);
    for (const DepthLayers& map : maps)
        pixels.add(map), by_map.add(map), cubes.add(map);
    cubes.finish();
    const SegmentLists lists = pixels.finish();
    const double whole = double(lists.bytes());
    const auto compared = [&](std::size_t bytes) { return fmt::format("{:.2f}", double(bytes) / whole); };
    std::vector<std::string> row = {subject.name, with_thousands(std::size_t(count)), size_text(lists.bytes()), compared(by_map.bytes()), compared(cubes.bytes())};
    for (const HyperReading reading : {HyperReading::cells, HyperReading::sequence})
        row.push_back(count == resolution * resolution ? compared(HyperList(maps, resolution, reading, MapOrder::theta_zigzag).bytes()) : "-");
    const RepairedLists clusters(maps, cluster_maps(maps, std::size_t(count) / 4, 1, 8));
    row.push_back(fmt::format("{} / {}", compared(clusters.lists().bytes()), compared(clusters.bytes())));
    const HaarLayers haar = transform_lists(lists, std::size_t(resolution));
    row.push_back(fmt::format("{:.0f} %", 100 * haar.zero_share()));
    row.push_back(fmt::format("{} / {} / {}", compared(haar.expanded_bytes), compared(haar.seed_bytes()), compared(haar.bytes)));
    BakeOptions options;
    options.maps = count, options.resolution = resolution, options.margin = 0;
    row.push_back(compared(bake_shadow_maps(subject.mesh, options).bytes().size()));
    table.add(row);
}

void add_look_ups(const ShadowSubject& subject, const std::vector<int>& counts, int resolution, MarkdownTable& table)
{
    const CasterRays rays(make_shadow_caster(subject.mesh));
    const std::vector<ShadowQuery> queries = shuffled_queries(rays);
    for (const int count : counts) {
        BakeOptions options;
        options.maps = count, options.resolution = resolution;
        const ShadowMaps seed = bake_shadow_maps(subject.mesh, seed_options(count, resolution)), bricks = bake_shadow_maps(subject.mesh, options);
        const LookUpTimes times = time_look_ups(rays, seed, bricks, queries);
        table.add({subject.name, with_thousands(subject.mesh.triangles.size()), with_thousands(std::size_t(count)), fmt::format("{:.0f}", times.rays),
                   fmt::format("{:.0f}", times.seed), fmt::format("{:.0f}", times.bricks), fmt::format("{:.0f}", times.bricks_alone),
                   fmt::format("{:.2f}", times.bricks / times.rays)});
    }
}

void add_qualities(const ShadowSubject& subject, const std::vector<int>& counts, const std::vector<int>& resolutions, MarkdownTable& table, MarkdownTable& smallest)
{
    const CasterRays rays(make_shadow_caster(subject.mesh));
    std::vector<MapQuality> all;
    for (const int count : counts) {
        std::vector<std::string> row = {subject.name, with_thousands(std::size_t(count))};
        for (const int resolution : resolutions) {
            BakeOptions options;
            options.maps = count, options.resolution = resolution;
            const ShadowMaps maps = bake_shadow_maps(subject.mesh, options);
            all.push_back({count, resolution, maps.bytes().size(), error_on_object(rays, maps)});
            row.push_back(fmt::format("{} / {}", error_text(all.back().error), size_text(all.back().bytes)));
        }
        table.add(row);
    }
    const MapQuality best = smallest_of_plateau(all);
    smallest.add({subject.name, with_thousands(std::size_t(best.maps)), std::to_string(best.resolution), size_text(best.bytes), error_text(best.error)});
}

void add_floors(const ShadowSubject& subject, int count, int resolution, MarkdownTable& table)
{
    const CasterRays rays(make_shadow_caster(subject.mesh));
    BakeOptions options;
    options.maps = count, options.resolution = resolution;
    const ShadowMaps bricks = bake_shadow_maps(subject.mesh, options), seed = seed_maps_within(subject.mesh, bricks.bytes().size(), resolution);
    const LookUp<ShadowMaps> by_middle(bricks.layout(), bricks), seed_by_middle(seed.layout(), seed);
    const PlaceLookUp<ShadowMaps> as_seed(seed.layout(), seed);
    const auto error = [&](const AskShadows& ask) { return floor_shadow_error(rays, ask).of_queries(); };
    const double own = error(asking(by_middle)), seeds = error(asking(as_seed)), middle = error(asking(seed_by_middle));
    table.add({subject.name, with_thousands(std::size_t(count)), size_text(bricks.bytes().size()), error_text(own), with_thousands(seed.info().grid.count()), size_text(seed.bytes().size()),
               error_text(seeds), error_text(middle), fmt::format("{:.1f}", seeds / own)});
}
