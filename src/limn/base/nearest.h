#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace limn {

/// Fewest insertions, deletions, substitutions and swaps of neighbours that turn one word into the other.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate with the fewest edits from `word`, or "" where none is near enough to be what was meant.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

} // namespace limn
