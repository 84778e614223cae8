#include "limn/raycast/nearest_sample.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace limn {

NearestSample::NearestSample(const std::vector<ivec2>& marked, const ivec2& size) : cells_(size / cell + 1), marked_(marked.size())
{
    first_.assign(std::size_t(cells_.x) * std::size_t(cells_.y) + 1, 0);
    for (const ivec2& p : marked)
        ++first_[cell_index(p.x / cell, p.y / cell) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i)
        first_[i] += first_[i - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (const ivec2& p : marked)
        marked_[next[cell_index(p.x / cell, p.y / cell)]++] = p;
}

double NearestSample::distance(const ivec2& from) const
{
    const ivec2 at = from / cell;
    std::int64_t least = std::numeric_limits<std::int64_t>::max(); // squared
    const auto look = [&](int x, int y) {
        if (x < 0 || y < 0 || x >= cells_.x || y >= cells_.y)
            return;
        for (std::uint32_t i = first_[cell_index(x, y)]; i < first_[cell_index(x, y) + 1]; ++i) {
            const std::int64_t dx = marked_[i].x - from.x, dy = marked_[i].y - from.y;
            least = std::min(least, dx * dx + dy * dy);
        }
    };
    const int most = std::max(cells_.x, cells_.y);
    for (int ring = 0; ring < most; ++ring) { // whatever lies in it is at least ring - 1 cells away
        const std::int64_t away = std::int64_t(std::max(0, ring - 1)) * cell;
        if (away * away >= least)
            break;
        for (int x = at.x - ring; x <= at.x + ring; ++x) {
            look(x, at.y - ring);
            if (ring > 0)
                look(x, at.y + ring);
        }
        for (int y = at.y - ring + 1; y < at.y + ring; ++y) {
            look(at.x - ring, y);
            look(at.x + ring, y);
        }
    }
    return least == std::numeric_limits<std::int64_t>::max() ? HUGE_VAL : std::sqrt(double(least));
}

} // namespace limn
