#include "limn/shadow/bake_maps.h"

namespace limn {

void bake_maps(MapPainter& painter, const DirectionGrid& grid, MapOrder order, const std::function<void(std::uint32_t, const DepthLayers&)>& take)
{
    check_order(order, grid.cells);
    constexpr std::uint32_t together = 16;
    std::vector<MapFrame> frames;
    for (std::uint32_t first = 0; first < grid.count(); first += together) {
        frames.clear();
        for (std::uint32_t rank = first; rank < std::min(first + together, grid.count()); ++rank)
            frames.push_back(grid.frame(cell_of_rank(order, grid.cells, rank)));
        std::uint32_t rank = first;
        for (const DepthLayers& map : painter.paint(frames))
            take(rank++, map);
    }
}

void bake_maps(const ShadowCaster& caster, const DirectionGrid& grid, MapOrder order, int size, const std::function<void(std::uint32_t, const DepthLayers&)>& take)
{
    bake_maps(*processor_painter(caster, size), grid, order, take);
}

void bake_blocks(MapPainter& painter, const DirectionGrid& grid, const ivec2& block,
                 const std::function<void(std::span<const DepthLayers* const>, double)>& take)
{
    const ivec2 blocks = (grid.cells + block - 1) / block;
    std::vector<MapFrame> frames;
    std::vector<const DepthLayers*> maps;
    for (int y = 0; y < blocks.y; ++y)
        for (int x = 0; x < blocks.x; ++x) {
            const auto each_cell = [&](auto&& f) {
                for (int k = 0; k < block.x * block.y; ++k) {
                    const ivec2 cell = ivec2(x, y) * block + ivec2(k % block.x, k / block.x);
                    f(cell, cell.x < grid.cells.x && cell.y < grid.cells.y);
                }
            };
            frames.clear(), maps.clear();
            each_cell([&](const ivec2& cell, bool exists) {
                if (exists)
                    frames.push_back(grid.frame(cell));
            });
            const DepthLayers* next = painter.paint(frames).data();
            each_cell([&](const ivec2&, bool exists) { maps.push_back(exists ? next++ : nullptr); });
            take(maps, double(y * blocks.x + x + 1) / double(blocks.x * blocks.y));
        }
}

} // namespace limn
