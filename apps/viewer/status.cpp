#include "status.h"

#include <fmt/format.h>

using namespace limn;

BoundStatus bound_status(const TerrainStep& step, double pixels, bool is_of_this_view)
{
    using Kind = BoundStatus::Kind;
    const std::string bound = fmt::format("{:.4g} px", pixels);
    if (step.unmet == 0)
        return is_of_this_view ? BoundStatus{Kind::holds, bound + " holds everywhere"}
                               : BoundStatus{Kind::following, bound + ": following the camera"};
    const std::string where = fmt::format("{} not met at {} of {} triangles", bound, step.unmet, step.triangles);
    if (!step.fault.empty())
        return {Kind::unreadable, where + ": " + step.fault};
    if (step.missing > 0)
        return {Kind::reading, fmt::format("{} yet: {} tile{} to read", where, step.missing, step.missing == 1 ? "" : "s")};
    return {Kind::short_of_memory, where + ": their tiles do not fit into memory (--tile-memory)"};
}
