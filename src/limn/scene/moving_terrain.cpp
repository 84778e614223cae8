#include "limn/scene/moving_terrain.h"

#include <utility>

namespace limn {

TerrainStep after_skipped(TerrainStep step, TerrainStep skipped)
{
    if (!step.model)
        step.model = std::move(skipped.model);
    step.light = gpu::after_skipped(std::move(step.light), std::move(skipped.light));
    return step;
}

} // namespace limn
