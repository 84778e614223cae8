#include <algorithm>
#include <bit>
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "common.h"
#include "console.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/parallel.h"
#include "limn/drawing/png.h"
#include "limn/shadow/map_pictures.h"
#include "shadow.h"

using namespace limn;

namespace {

const std::vector<std::string> formats = {"png"};

constexpr const char* examples = R"(Examples:
  limn shadow show bunny.csm
  limn shadow show bunny.csm --json
  limn shadow show bunny.csm -o maps.png --tiles 8x4
  limn shadow show bunny.csm --coherence coherence.png)";

struct ShowCommand {
    CommonOptions common;
    std::string file, coherence, tiles = "8x4";
};

ivec2 parse_tiles(const std::string& text)
{
    ivec2 tiles = {0, 0};
    char x = 0, rest = 0;
    if (std::sscanf(text.c_str(), "%d%c%d%c", &tiles.x, &x, &tiles.y, &rest) != 3 || x != 'x')
        throw Error::Input(fmt::format("--tiles: '{}' is no COLUMNSxROWS, such as 8x4", text));
    if (std::min(tiles.x, tiles.y) < 1 || std::max(tiles.x, tiles.y) > 256)
        throw Error::Input(fmt::format("--tiles: {} is outside 1x1..256x256", text));
    return tiles;
}

/// How many texels have lists of 1, of 2 to 3, of 4 to 7 ... runs.
std::vector<std::size_t> list_lengths(const StoredSegments& segments, std::size_t texels)
{
    std::vector<std::size_t> counts;
    for (std::size_t texel = 0; texel < texels; ++texel) {
        const auto step = std::size_t(std::bit_width(segments.list(texel).size())) - 1;
        counts.resize(std::max(counts.size(), step + 1));
        ++counts[step];
    }
    return counts;
}

nlohmann::ordered_json codec_json(const ShadowMaps& maps)
{
    if (maps.segments())
        return {{"segments", maps.segments()->count()}, {"lists_by_length", list_lengths(*maps.segments(), maps.info().texels())}};
    const StoredBricks::Counts counts = maps.bricks()->counts();
    return {{"bricks", {{"background", counts.background}, {"constant", counts.constant}, {"general", counts.general}}}};
}

std::string facts(const ShadowMaps& maps)
{
    const ShadowMapsInfo& info = maps.info();
    const double bytes = double(maps.bytes().size()), elements = double(info.texels()) * info.grid.count();
    std::string text;
    const auto row = [&](const char* name, const std::string& value) { text += fmt::format("{:<14}{}\n", name, value); };
    row("maps", fmt::format("{} of {} x {} texels ({} x {} directions, {})", with_thousands(info.grid.count()), info.size, info.size, info.grid.cells.x,
                            info.grid.cells.y, bake_word(info, "spread")));
    row("codec", fmt::format("{}, margin {}", bake_word(info, "codec"), info.margin));
    if (maps.segments()) {
        row("order", bake_word(info, "order"));
        row("segments", with_thousands(maps.segments()->count()));
        const std::vector<std::size_t> lengths = list_lengths(*maps.segments(), info.texels());
        for (std::size_t step = 0; step < lengths.size(); ++step)
            row(step == 0 ? "lists" : "", fmt::format("{:>9} of {}{}", with_thousands(lengths[step]), std::size_t(1) << step,
                                                      step == 0 ? "" : fmt::format(" to {}", (std::size_t(2) << step) - 1)));
    } else {
        const StoredBricks::Counts counts = maps.bricks()->counts();
        row("bricks", fmt::format("{} empty, {} of one depth, {} others", with_thousands(counts.background), with_thousands(counts.constant), with_thousands(counts.general)));
    }
    row("size", fmt::format("{} bytes, {:.3f} bits for each texel of each map", with_thousands(maps.bytes().size()), 8 * bytes / elements));
    row("ratio", fmt::format("{:.1f} against two layers of floats, {:.1f} against one, {:.1f} against one of 16 bits", 8 * elements / bytes, 4 * elements / bytes,
                             2 * elements / bytes));
    row("sphere", fmt::format("({:.6g}, {:.6g}, {:.6g}), radius {:.6g}", info.sphere.centre.x, info.sphere.centre.y, info.sphere.centre.z, info.sphere.radius));
    row("open backs", bake_word(info, "open-back"));
    row("shape", fmt::format("{:016x}", info.shape));
    return text;
}

void run(const ShowCommand& command)
{
    const Stopwatch watch;
    if (command.file.empty())
        throw Error::Input("no file given; see 'limn shadow show --help'");
    std::vector<Output> outputs = checked_outputs(command.common, formats);
    const ivec2 tiles = parse_tiles(command.tiles);
    check_cpu_only(command.common, "shadow show");
    Console console(command.common.quiet);
    console.progress("reading", 0);
    const ShadowMaps maps = read_csm(command.file);
    std::vector<std::string> written = command.common.outputs;
    for (const Output& output : outputs)
        write_file(output.path, encode_png(map_sheet(maps, tiles)));
    if (!command.coherence.empty()) {
        const std::vector<std::uint32_t> runs = run_counts(maps, [&](double part) { console.progress("counting runs", part); });
        write_png(coherence_map(runs, maps.info()), command.coherence);
        written.push_back(command.coherence);
    }
    if (command.common.json) {
        nlohmann::ordered_json json = {{"limn", LIMN_VERSION}, {"command", "shadow show"}, {"file", command.file}};
        json.update(maps_json(maps));
        json.update(codec_json(maps));
        json["outputs"] = written;
        write_file("-", json.dump(2) + "\n");
    } else if (written.empty()) {
        write_file("-", facts(maps));
    }
    console.finish(fmt::format("{}: {}, {}", written.empty() ? "read " + command.file : what_was_written(written), size_text(maps), seconds_text(watch.total())));
}

} // namespace

Subcommand add_shadow_show(CLI::App& shadow)
{
    auto command = std::make_shared<ShowCommand>();
    CLI::App* app = shadow.add_subcommand("show", "Say what a file of 'limn shadow bake' holds, and draw its maps");
    app->footer(examples);
    app->add_option("FILE", command->file, "file of 'limn shadow bake'");
    app->add_option("--tiles", command->tiles, "maps on the sheet (default 8x4)")->type_name("CxR");
    app->add_option("--coherence", command->coherence, "picture of how well each texel compresses: white is best")->type_name("FILE");
    add_common_options(*app, command->common, "sheet of maps to write: png; '-' is standard output");
    return {app, [command] { with_threads(command->common.threads, [&] { run(*command); }); }};
}
