#pragma once

#include <cstdint>
#include <vector>

namespace limn {

/// A key in the upper 32 bits and an item's number in the lower 32.
inline std::uint64_t keyed(std::uint32_t key, std::uint32_t item) { return std::uint64_t(key) << 32 | item; }
inline std::uint32_t key_of(std::uint64_t keyed_item) { return std::uint32_t(keyed_item >> 32); }
inline std::uint32_t item_of(std::uint64_t keyed_item) { return std::uint32_t(keyed_item); }

/// Sorts by key and keeps the order of items with equal keys. Parallel; the result does not depend on the threads.
/// @param key_limit  every key is below or equal to it: fewer passes where it is small
void sort_by_key(std::vector<std::uint64_t>& items, std::uint32_t key_limit = 0xFFFFFFFFu);

} // namespace limn
