#include "limn/shadow/bake_shadow_maps.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/shadow/bake_maps.h"
#include "limn/shadow/brick_stream.h"
#include "limn/shadow/shape_hash.h"

namespace limn {
namespace {

constexpr double most_margin = 0.49;
constexpr double least_across = 32; ///< cells along phi of an oblong grid: with fewer, maps are too far apart (docs/shadow.md)

void check(const BakeOptions& options)
{
    const auto check_range = [](const char* name, double value, double low, double high) {
        if (!(value >= low && value <= high))
            throw Error::Input(fmt::format("--{}: {} is outside {}..{}", name, value, low, high));
    };
    check_range("maps", options.maps, 1, most_maps);
    check_range("resolution", options.resolution, 1, largest_map);
    check_range("margin", options.margin, 0, most_margin);
    if (options.codec == ShadowCodec::bricks && options.order != BakeOptions().order)
        throw Error::Input("--order: bricks of maps have none; say --codec seed with it");
    if (options.cells == ivec2(0, 0))
        return;
    check_range("cells", options.cells.x, 1, most_cells);
    check_range("cells", options.cells.y, 1, most_cells);
    if (std::uint64_t(options.cells.x) * std::uint64_t(options.cells.y) > most_maps)
        throw Error::Input(fmt::format("--cells: {} x {} are more than {} maps", options.cells.x, options.cells.y, most_maps));
}

OptionRow<BakeOptions> cells_row()
{
    const std::string range = fmt::format("1..{0}x1..{0}", most_cells);
    auto set = [](BakeOptions& options, std::string_view text) {
        const std::size_t x = text.find('x');
        const auto number = [&](std::string_view part) {
            const double value = parse_number("cells", part);
            if (!(value >= 1 && value <= most_cells && std::floor(value) == value))
                throw Error::Input(fmt::format("--cells: {} is outside 1..{}", part, most_cells));
            return int(value);
        };
        if (x == std::string_view::npos)
            throw Error::Input(fmt::format("--cells: '{}' is no SxT, such as 114x36", text));
        options.cells = {number(text.substr(0, x)), number(text.substr(x + 1))};
    };
    auto get = [](const BakeOptions& options) {
        return options.cells == ivec2(0, 0) ? std::string("by --maps") : fmt::format("{}x{}", options.cells.x, options.cells.y);
    };
    return {"cells", "", range, "directions along theta and phi, instead of --maps", set, get, OptionKind::text};
}

std::string baked_segments(MapPainter& painter, const ShadowMapsInfo& info, const std::function<void(double)>& progress)
{
    PixelCodec codec(info.texels(), info.margin);
    bake_maps(painter, info.grid, info.order, [&](std::uint32_t rank, const DepthLayers& layers) {
        codec.add(layers);
        progress(double(rank + 1) / double(info.grid.count()));
    });
    return stored_bytes(codec.finish());
}

std::string baked_bricks(MapPainter& painter, const ShadowMapsInfo& info, const std::function<void(double)>& progress)
{
    BrickStream stream(info.size, info.grid.cells, info.margin);
    bake_blocks(painter, info.grid, {brick_s, brick_t}, [&](std::span<const DepthLayers* const> maps, double part) {
        stream.add(maps);
        progress(part);
    });
    return stream.finish();
}

} // namespace

const OptionTable<BakeOptions>& bake_option_table()
{
    static const OptionTable<BakeOptions> table = {
        number_row<BakeOptions>("maps", "", 1, most_maps, "about so many directions", &BakeOptions::maps),
        cells_row(),
        number_row<BakeOptions>("resolution", "texels", 1, largest_map, "along a side of a map", &BakeOptions::resolution),
        choice_row<BakeOptions, DirectionSpread>(
            "spread", {{"even", DirectionSpread::even}, {"polar", DirectionSpread::polar}, {"octahedral", DirectionSpread::octahedral}},
            "how directions lie on the sphere", &BakeOptions::spread),
        choice_row<BakeOptions, MapOrder>("order",
                                          {{"theta-zigzag", MapOrder::theta_zigzag},
                                           {"theta-linear", MapOrder::theta_linear},
                                           {"phi-zigzag", MapOrder::phi_zigzag},
                                           {"phi-linear", MapOrder::phi_linear},
                                           {"hilbert", MapOrder::hilbert}},
                                          "of the seed's codec: how maps follow each other", &BakeOptions::order),
        choice_row<BakeOptions, ShadowCodec>("codec", {{"bricks", ShadowCodec::bricks}, {"seed", ShadowCodec::segments}}, "how depths are stored", &BakeOptions::codec),
        number_row<BakeOptions>("margin", "of the thickness", 0, most_margin, "that depths keep from both surfaces", &BakeOptions::margin),
        choice_row<BakeOptions, OpenBack>("open-back", {{"sphere", OpenBack::sphere}, {"constant", OpenBack::constant}},
                                          "what is behind a surface without a second one", &BakeOptions::back)};
    return table;
}

DirectionGrid bake_grid(const BakeOptions& options)
{
    check(options);
    if (options.cells != ivec2(0, 0))
        return {options.spread, options.cells};
    const double side = std::sqrt(double(options.maps));
    const auto to_nearest = [](double wanted, int unit) { return std::max(1, int(std::lround(wanted / unit))) * unit; };
    if (options.codec != ShadowCodec::bricks || options.spread == DirectionSpread::octahedral || side <= least_across)
        return {options.spread, {to_nearest(side, 1), to_nearest(side, 1)}};
    const int across = to_nearest(std::max(side / 2, least_across), brick_t);
    return {options.spread, {std::min(to_nearest(double(options.maps) / across, brick_s), int(most_maps) / across), across}};
}

ShadowMaps bake_shadow_maps(const Mesh& mesh, const BakeOptions& options, const std::function<void(double)>& progress, const MakePainter& make_painter)
{
    const DirectionGrid grid = bake_grid(options);
    const ShadowCaster caster = make_shadow_caster(mesh);
    ShadowMapsInfo info;
    info.grid = grid;
    info.order = options.codec == ShadowCodec::bricks ? MapOrder::theta_linear : options.order;
    info.size = options.resolution;
    info.codec = options.codec;
    info.margin = float(options.margin);
    info.back = options.back;
    info.sphere = caster.sphere;
    info.shape = shape_hash(mesh);
    const std::function<void(double)> tell = progress ? progress : [](double) {};
    const std::unique_ptr<MapPainter> painter = (make_painter ? make_painter : MakePainter(processor_painter))(caster, info.size, info.back);
    const std::string depths = options.codec == ShadowCodec::bricks ? baked_bricks(*painter, info, tell) : baked_segments(*painter, info, tell);
    const auto file = std::make_shared<const std::string>(encode_csm(info, depths));
    return {*file, file, "the baked maps"};
}

} // namespace limn
