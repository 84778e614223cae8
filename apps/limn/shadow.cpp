#include "shadow.h"

#include <algorithm>

#include <fmt/format.h>

#include "console.h"
#include "limn/base/error.h"
#include "limn/shadow/bake_shadow_maps.h"

using namespace limn;

namespace {

constexpr const char* examples = R"(Examples:
  limn shadow bake bunny.ply -o bunny.csm
  limn shadow bake bunny.ply -o fine.csm --maps 16384 --resolution 256
  limn shadow show bunny.csm -o maps.png --coherence coherence.png
  limn shadow check bunny.csm bunny.ply)";

} // namespace

std::string size_text(const ShadowMaps& maps)
{
    const ShadowMapsInfo& info = maps.info();
    return fmt::format("{} x {} maps of {} x {}, {:.2f} MB, {:.1f}:1 against two float layers", info.grid.cells.x, info.grid.cells.y, info.size, info.size,
                       double(maps.bytes().size()) / 1e6, double(info.uncompressed_bytes()) / double(maps.bytes().size()));
}

std::string bake_word(const ShadowMapsInfo& info, const std::string& option)
{
    BakeOptions options;
    options.spread = info.grid.spread, options.order = info.order, options.codec = info.codec, options.back = info.back;
    const OptionTable<BakeOptions>& table = bake_option_table();
    return std::find_if(table.begin(), table.end(), [&](const OptionRow<BakeOptions>& row) { return row.name == option; })->get(options);
}

nlohmann::ordered_json maps_json(const ShadowMaps& maps)
{
    const ShadowMapsInfo& info = maps.info();
    const double bytes = double(maps.bytes().size()), elements = double(info.texels()) * info.grid.count();
    nlohmann::ordered_json json = {{"maps", info.grid.count()},
                                   {"cells", {info.grid.cells.x, info.grid.cells.y}},
                                   {"resolution", info.size},
                                   {"spread", bake_word(info, "spread")},
                                   {"codec", bake_word(info, "codec")},
                                   {"order", bake_word(info, "order")},
                                   {"margin", info.margin},
                                   {"open_back", bake_word(info, "open-back")}};
    json["sphere"] = {{"centre", {info.sphere.centre.x, info.sphere.centre.y, info.sphere.centre.z}}, {"radius", info.sphere.radius}};
    json["shape"] = fmt::format("{:016x}", info.shape);
    json["bytes"] = maps.bytes().size();
    json["bits_per_texel"] = 8 * bytes / elements;
    json["ratio"] = {{"two_float_layers", 8 * elements / bytes}, {"one_float_layer", 4 * elements / bytes}, {"one_16_bit_layer", 2 * elements / bytes}};
    return json;
}

Subcommand add_shadow(CLI::App& limn)
{
    CLI::App* app = limn.add_subcommand("shadow", "Keep what hides what of a rigid object, seen from everywhere, in a small file");
    app->footer(examples);
    const std::vector<Subcommand> subcommands = {add_shadow_bake(*app), add_shadow_show(*app), add_shadow_check(*app)};
    return {app, [subcommands] {
                for (const Subcommand& subcommand : subcommands)
                    if (subcommand.app->parsed())
                        return subcommand.run();
                throw Error::Input("say what to do: bake, show or check; see 'limn shadow --help'");
            }};
}
