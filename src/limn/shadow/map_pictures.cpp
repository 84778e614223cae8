#include "limn/shadow/map_pictures.h"

#include <algorithm>
#include <cmath>

#include "limn/base/parallel.h"

namespace limn {
namespace {

constexpr float nearest_grey = 1.0f, furthest_grey = 0.25f; ///< of surfaces: further than any is black
constexpr int gap = 1;                                       ///< pixels between maps
constexpr float gap_grey = 0.5f;

/// Runs of equal depths of some texels, map by map.
void count_runs(const ShadowMaps& maps, std::size_t begin, std::size_t end, std::vector<std::uint32_t>& runs)
{
    std::vector<MapPlace> places(end - begin);
    std::vector<float> depths(end - begin), before;
    for (std::uint32_t rank = 0; rank < maps.info().grid.count(); ++rank) {
        for (std::size_t i = 0; i < places.size(); ++i)
            places[i] = {std::uint32_t(begin + i), rank};
        maps.depths(places, depths.data());
        for (std::size_t i = 0; i < places.size(); ++i)
            runs[begin + i] += before.empty() || before[i] != depths[i];
        before = depths;
    }
}

} // namespace

std::vector<std::uint32_t> run_counts(const ShadowMaps& maps, const std::function<void(double)>& progress)
{
    const std::size_t texels = maps.info().texels();
    std::vector<std::uint32_t> runs(texels, 0);
    if (maps.segments()) {
        for (std::size_t texel = 0; texel < texels; ++texel)
            runs[texel] = std::uint32_t(maps.segments()->list(texel).size());
        return runs;
    }
    constexpr std::size_t grain = 256, together = 16 * grain;
    for (std::size_t first = 0; first < texels; first += together) {
        const std::size_t count = std::min(together, texels - first);
        parallel_blocks(count, grain, [&](std::size_t begin, std::size_t end) { count_runs(maps, first + begin, first + end, runs); });
        if (progress)
            progress(double(first + count) / double(texels));
    }
    return runs;
}

Image coherence_map(const std::vector<std::uint32_t>& runs, const ShadowMapsInfo& info)
{
    Image image({info.size, info.size}, 1);
    const double all = std::log(double(std::max(2u, info.grid.count())));
    for (int y = 0; y < info.size; ++y)
        for (int x = 0; x < info.size; ++x) // up is up
            *image.at(x, info.size - 1 - y) = float(1 - std::log(double(runs[std::size_t(y) * std::size_t(info.size) + std::size_t(x)])) / all);
    return image;
}

Image map_sheet(const ShadowMaps& maps, const ivec2& tiles)
{
    const ShadowMapsInfo& info = maps.info();
    const ivec2 shown = glm::min(tiles, info.grid.cells);
    Image image(shown * (info.size + gap) - gap, 1, gap_grey);
    parallel_each(std::size_t(shown.x * shown.y), 1, [&](std::size_t tile) {
        const ivec2 at = {int(tile) % shown.x, int(tile) / shown.x}, cell = (2 * at + 1) * info.grid.cells / (2 * shown), corner = at * (info.size + gap);
        const std::uint32_t rank = rank_of(info.order, info.grid.cells, cell);
        for (int y = 0; y < info.size; ++y)
            for (int x = 0; x < info.size; ++x) {
                const float depth = maps.depth(std::size_t(y) * std::size_t(info.size) + std::size_t(x), rank);
                *image.at(corner.x + x, corner.y + info.size - 1 - y) = depth == no_surface ? 0 : nearest_grey + (furthest_grey - nearest_grey) * depth;
            }
    });
    return image;
}

} // namespace limn
