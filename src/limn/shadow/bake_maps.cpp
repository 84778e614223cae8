#include "limn/shadow/bake_maps.h"

#include <memory>

#include "limn/base/parallel.h"

namespace limn {

void bake_maps(const ShadowCaster& caster, const DirectionGrid& grid, MapOrder order, int size, const std::function<void(std::uint32_t, const DepthLayers&)>& take,
               OpenBack back)
{
    check_order(order, grid.cells);
    constexpr std::uint32_t together = 16;
    std::vector<std::unique_ptr<DepthPainter>> painters;
    std::vector<const DepthLayers*> maps(together);
    for (std::uint32_t k = 0; k < std::min(together, grid.count()); ++k)
        painters.push_back(std::make_unique<DepthPainter>(caster, size, back));
    for (std::uint32_t first = 0; first < grid.count(); first += together) {
        const std::uint32_t count = std::min(together, grid.count() - first);
        parallel_each(count, 1, [&](std::size_t k) { maps[k] = &painters[k]->paint(grid.frame(cell_of_rank(order, grid.cells, first + std::uint32_t(k)))); });
        for (std::uint32_t k = 0; k < count; ++k)
            take(first + k, *maps[k]);
    }
}

void bake_blocks(const ShadowCaster& caster, const DirectionGrid& grid, const ivec2& block, int size,
                 const std::function<void(std::span<const DepthLayers* const>, double)>& take, OpenBack back)
{
    const std::size_t together = std::size_t(block.x) * std::size_t(block.y);
    std::vector<std::unique_ptr<DepthPainter>> painters;
    for (std::size_t k = 0; k < together; ++k)
        painters.push_back(std::make_unique<DepthPainter>(caster, size, back));
    std::vector<const DepthLayers*> maps(together);
    const ivec2 blocks = (grid.cells + block - 1) / block;
    for (int y = 0; y < blocks.y; ++y)
        for (int x = 0; x < blocks.x; ++x) {
            parallel_each(together, 1, [&](std::size_t k) {
                const ivec2 cell = ivec2(x, y) * block + ivec2(int(k) % block.x, int(k) / block.x);
                maps[k] = cell.x < grid.cells.x && cell.y < grid.cells.y ? &painters[k]->paint(grid.frame(cell)) : nullptr;
            });
            take(maps, double(y * blocks.x + x + 1) / double(blocks.x * blocks.y));
        }
}

} // namespace limn
