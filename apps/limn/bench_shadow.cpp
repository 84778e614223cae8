#include "bench_shadow.h"

#include <algorithm>

#include <fmt/format.h>

#include "bench_table.h"
#include "limn/base/error.h"
#include "limn/shadow/map_quality.h"
#include "shadow_figures.h"
#include "shadow_pictures.h"
#include "shadow_studies.h"

using namespace limn;

namespace {

struct ShadowBench {
    std::vector<std::string> models;
    std::vector<int> maps, resolutions;

    int finest() const { return resolutions.back(); }
    int middle() const { return resolutions[resolutions.size() / 2]; }
    int some_maps() const { return maps[maps.size() / 2]; }
};

ShadowBench bench_of(const BenchRequest& request)
{
    ShadowBench bench = {request.models.empty() ? shadow_subject_names() : request.models, {request.sizes.begin(), request.sizes.end()}, request.edges};
    if (bench.maps.empty())
        bench.maps = request.full ? std::vector<int>{64, 256, 1024, 4096, 16384, 65536} : std::vector<int>{256, 1024, 4096};
    if (bench.resolutions.empty())
        bench.resolutions = request.full ? std::vector<int>{32, 64, 128, 256} : std::vector<int>{32, 64, 128};
    if (bench.maps.back() > int(most_maps))
        throw Error::Input(fmt::format("--sizes: {} maps are more than {}", bench.maps.back(), most_maps));
    for (const int resolution : bench.resolutions)
        if ((resolution & (resolution - 1)) != 0)
            throw Error::Input(fmt::format("--edges: {} is no power of two, which Hilbert's curve needs", resolution));
    return bench;
}

struct Tables {
    MarkdownTable sizes = MarkdownTable({"model", "maps", "seed (MB)", "ratio", "wrong (%)", "bricks (MB)", "ratio", "wrong (%)", "smaller by", "bake (s)"});
    MarkdownTable orders = MarkdownTable({"model", "theta zigzag", "theta linear", "Hilbert", "phi linear", "phi zigzag"});
    MarkdownTable resolutions = MarkdownTable({"model", "maps", "resolution", "seed (MB)", "ratio", "bricks (MB)", "ratio"});
    MarkdownTable spreads = MarkdownTable({"model", "maps", "even", "polar", "octahedral"});
    MarkdownTable orientations = MarkdownTable({"model", "x", "x over", "y", "y over", "z", "z over"});
    MarkdownTable compressors = MarkdownTable({"model", "maps", "per texel (MB)", "per map", "3D Hilbert", "4D, cells", "4D, sequence", "k-means / repaired", "Haar zeros",
                                               "Haar expanded / seed's reckoning / with positions", "bricks"});
    MarkdownTable qualities = MarkdownTable({"model", "maps"});
    MarkdownTable plateau = MarkdownTable({"model", "maps", "resolution", "MB", "wrong (%)"});
    MarkdownTable floors = MarkdownTable({"model", "maps", "MB", "wrong (%)", "seed's maps", "MB", "as the seed looks up, wrong (%)", "as we do", "fewer errors"});
    MarkdownTable lengths = MarkdownTable({"model", "maps", "least", "10 %", "25 %", "median", "75 %", "90 %", "99 %", "most"});
    MarkdownTable pictures =
        MarkdownTable({"model", "samples", "queries (M)", "no shadows (s)", "rays (s)", "maps (s)", "maps/rays", "ray (ns)", "look-up (ns)"});
    MarkdownTable look_ups = MarkdownTable({"model", "triangles", "maps", "rays (ns)", "seed (ns)", "bricks (ns)", "bricks, one by one (ns)", "bricks/rays"});
};

Tables empty_tables(const ShadowBench& bench)
{
    Tables tables;
    std::vector<std::string> header = {"model", "maps"};
    for (const int resolution : bench.resolutions)
        header.push_back(fmt::format("{0} x {0}", resolution));
    tables.qualities = MarkdownTable(header);
    return tables;
}

void add_studies(const ShadowBench& bench, const std::string& name, Tables& tables)
{
    const ShadowSubject subject = shadow_subject(name);
    const int finest = bench.finest(), middle = bench.middle(), some_maps = bench.some_maps();
    add_sizes(subject, bench.maps, finest, tables.sizes);
    add_orders(subject, some_maps, middle, tables.orders);
    add_resolutions(subject, {some_maps}, bench.resolutions, tables.resolutions);
    add_spreads(subject, bench.maps, middle, tables.spreads);
    add_orientations(subject, some_maps, middle, tables.orientations);
    add_compressors(subject, some_maps, bench.resolutions.front(), tables.compressors);
    add_qualities(subject, bench.maps, bench.resolutions, tables.qualities, tables.plateau);
    add_floors(subject, bench.maps.back(), finest, tables.floors);
    add_list_lengths(subject, bench.maps.back(), finest, tables.lengths);
    add_look_ups(subject, {bench.maps.back()}, finest, tables.look_ups);
}

constexpr int many_maps = 16384;
constexpr std::size_t many_triangles = 820000;

/// The bunny, where it is.
const std::string& main_model(const ShadowBench& bench) { return bench.models[std::min<std::size_t>(1, bench.models.size() - 1)]; }

/// Many maps and many triangles, of which the models have one each.
void add_large(const ShadowBench& bench, Tables& tables)
{
    add_sizes(shadow_subject(main_model(bench)), {many_maps}, bench.finest(), tables.sizes);
    add_look_ups(shadow_subject(main_model(bench)), {many_maps}, bench.finest(), tables.look_ups);
    add_look_ups(shadow_subject("knot", many_triangles), {bench.maps.back()}, bench.finest(), tables.look_ups);
}

std::string text_of(const ShadowBench& bench, const Tables& t)
{
    const int coarsest = bench.resolutions.front(), middle = bench.middle(), finest = bench.finest();
    const std::string some_maps = with_thousands(std::size_t(bench.some_maps()));
    return fmt::format(
        "## Shadow maps\n\n`limn bench shadow`, version {}, {}. MB are 2^20 bytes of whole files, ratios are against two layers of floats; \"seed\" is the codec of the "
        "thesis (8 bytes a segment, theta zigzag, square grid, no margin), \"bricks\" the default. Wrong: of places on the object that face a light outside, those whose "
        "shadow is not that of a ray (100 pictures).\n\n### Sizes, {} x {} texels\n\n{}\n### Orders of maps: MB of the seed's codec, {} maps of {} x {} (beside theta zigzag)\n\n{}\n"
        "### Resolutions\n\n{}\n### Grids of directions: MB of the seed's codec / wrong (%), {} x {} texels\n\n{}\n### Axis of the poles, and the object turned over: MB / wrong (%)\n\n{}\n"
        "### Other compressors, beside lists per texel: {} maps of {} x {}\n\nk-means has a quarter as many clusters as there are maps.\n\n{}\n"
        "### Quality: wrong (%) / MB of bricks, by maps and texels\n\n{}\nThe smallest of these whose errors are at most {} times the least ones:\n\n{}\n"
        "### On a floor, {} x {} texels\n\nWrong answers at places of a floor under the object; the seed's codec with as many maps as fit into a file of the same size, looked up at "
        "the place itself, as it does, and where the line is nearest to the object's middle.\n\n{}\n"
        "### Segments in the seed's lists, {} x {} texels\n\n{}\n"
        "### Pictures, 1920 x 1080\n\nThe object on a ground under a ball of light, in all threads, one each. A ray or look-up is what the picture takes "
        "beyond one whose answers cost nothing, of all threads together.\n\n{}\n"
        "### Look-ups on the object, incoherent, one thread\n\nProcessor time. Rays are Embree's `rtcOccluded1`; lists and bricks are read many at once.\n\n{}",
        LIMN_VERSION, machine_name(), finest, finest, t.sizes.text(), some_maps, middle, middle, t.orders.text(), t.resolutions.text(), middle, middle, t.spreads.text(),
        t.orientations.text(), some_maps, coarsest, coarsest, t.compressors.text(), t.qualities.text(), plateau_height, t.plateau.text(), finest, finest, t.floors.text(), finest, finest, t.lengths.text(),
        t.pictures.text(), t.look_ups.text());
}

} // namespace

BenchResult bench_shadow(const BenchRequest& request, Console& console)
{
    const ShadowBench bench = bench_of(request);
    Tables tables = empty_tables(bench);
    for (std::size_t i = 0; i < bench.models.size(); ++i) {
        console.progress(bench.models[i], double(i) / double(bench.models.size()));
        add_studies(bench, bench.models[i], tables);
    }
    add_pictures(shadow_subject(main_model(bench)), bench.maps.back(), bench.finest(), request.full ? std::vector<int>{1, 16, 64, 256} : std::vector<int>{1, 16, 64}, tables.pictures);
    if (request.models.empty() && request.sizes.empty())
        add_large(bench, tables);
    if (!request.figures.empty())
        write_shadow_figures(request.figures, bench.maps, bench.resolutions, console);
    const nlohmann::ordered_json json = {{"limn", LIMN_VERSION},
                                         {"command", "bench shadow"},
                                         {"machine", machine_name()},
                                         {"sizes", json_of(tables.sizes)},
                                         {"orders", json_of(tables.orders)},
                                         {"resolutions", json_of(tables.resolutions)},
                                         {"spreads", json_of(tables.spreads)},
                                         {"orientations", json_of(tables.orientations)},
                                         {"compressors", json_of(tables.compressors)},
                                         {"qualities", json_of(tables.qualities)},
                                         {"plateau", json_of(tables.plateau)},
                                         {"floors", json_of(tables.floors)},
                                         {"lengths", json_of(tables.lengths)},
                                         {"pictures", json_of(tables.pictures)},
                                         {"look_ups", json_of(tables.look_ups)}};
    return {text_of(bench, tables), json.dump(2) + "\n", bench.models.size() == 1 ? "1 model" : fmt::format("{} models", bench.models.size())};
}
