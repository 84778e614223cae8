#pragma once

#include <cstdint>
#include <vector>

#include "limn/base/random.h"
#include "limn/base/vec.h"

namespace limn::test {

/// A picture with about that share of its pixels marked, at least one.
inline std::vector<std::uint8_t> random_marks(ivec2 size, double share, std::uint64_t seed)
{
    std::vector<std::uint8_t> marks(std::size_t(size.x) * std::size_t(size.y));
    Random random(seed);
    for (std::uint8_t& mark : marks)
        mark = random.uniform() < share ? 1 : 0;
    marks[marks.size() / 3] = 1;
    return marks;
}

} // namespace limn::test
