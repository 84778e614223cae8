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

} // namespace limn
