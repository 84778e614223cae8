#include "pyramid_info.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common.h"
#include "console.h"
#include "raster_info.h"

using namespace limn;

namespace {

std::uint64_t samples_without_data(const TerrainPyramid& pyramid)
{
    return std::uint64_t(pyramid.frame().columns) * std::uint64_t(pyramid.frame().rows) - pyramid.samples();
}

} // namespace

std::string pyramid_text(const TerrainPyramid& pyramid)
{
    const PyramidLayout& layout = pyramid.layout();
    const std::string heights = pyramid.samples() > 0 ? fmt::format("{:.7g} to {:.7g} m", pyramid.lowest(), pyramid.highest()) : "none";
    return map_rows(pyramid.frame()) + fact_row("heights", heights) +
           fact_row("no data", counted(samples_without_data(pyramid), "sample")) +
           fact_row("tiles", fmt::format("{} of {} x {} points, in {}", with_thousands(layout.tile_count()), layout.tile_points(),
                                         layout.tile_points(), counted(std::size_t(layout.levels()), "level"))) +
           fact_row("file", fmt::format("{} bytes", with_thousands(pyramid.bytes())));
}

std::string pyramid_json(const TerrainPyramid& pyramid, const std::string& file, double seconds)
{
    const PyramidLayout& layout = pyramid.layout();
    nlohmann::ordered_json heights; // null where nothing has data
    if (pyramid.samples() > 0)
        heights = {{"lowest", pyramid.lowest()}, {"highest", pyramid.highest()}};
    nlohmann::ordered_json facts = map_json(pyramid.frame());
    facts.update({{"heights", heights},
                  {"no_data", samples_without_data(pyramid)},
                  {"levels", layout.levels()},
                  {"tiles", layout.tile_count()},
                  {"points_of_tile", layout.tile_points()},
                  {"bytes", pyramid.bytes()}});
    const nlohmann::ordered_json json = {
        {"limn", LIMN_VERSION}, {"command", "info"}, {"file", file}, {"pyramid", facts}, {"seconds", {{"read", seconds}}}};
    return json.dump(2) + "\n";
}
