#include "limn/base/nearest.h"

#include <algorithm>

namespace limn {

int edit_distance(std::string_view a, std::string_view b)
{
    const std::size_t columns = b.size() + 1;
    std::vector<int> cost((a.size() + 1) * columns);
    const auto at = [&](std::size_t i, std::size_t j) -> int& { return cost[i * columns + j]; };
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                at(i, j) = int(i + j);
                continue;
            }
            at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
        }
    return cost.back();
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates)
{
    std::string best;
    int fewest = std::max(2, int(word.size()) / 3) + 1;
    for (const std::string& candidate : candidates)
        if (const int edits = edit_distance(word, candidate); edits < fewest) {
            best = candidate;
            fewest = edits;
        }
    return best;
}

} // namespace limn
