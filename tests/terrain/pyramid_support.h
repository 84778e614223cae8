#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>

#include <fmt/format.h>

#include "limn/terrain/build_pyramid.h"
#include "support/support.h"
#include "terrain/terrain_support.h"

namespace limn::test {

/// Rough terrain with a hole, samples without data alone and one side without.
inline HeightMap holey_terrain(int columns, int rows)
{
    HeightMap map = rough_terrain(columns, rows, 7);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const ivec2 from = ivec2(x, y) - ivec2(columns / 3, rows / 2);
            if (from.x * from.x + 3 * from.y * from.y < columns * rows / 60 || x + y < rows / 8)
                map.heights[map.index(x, y)] = std::numeric_limits<float>::quiet_NaN();
        }
    map.heights[map.index(columns - 1, rows / 4)] = map.heights[map.index(columns / 2, rows - 1)] = std::numeric_limits<float>::quiet_NaN();
    return map;
}

/// Damages a file by one bit at a byte, or mends it again.
inline void flip_bit(const std::filesystem::path& path, std::uint64_t at)
{
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(std::streamoff(at));
    const int byte = file.get();
    file.seekp(std::streamoff(at));
    file.put(char(byte ^ 0x40));
}

} // namespace limn::test
