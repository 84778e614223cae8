#pragma once

#include <string>
#include <string_view>

/// A text whose section `name` is replaced by `content`, between two comment lines that carry the name; added at the end
/// where the text has no such section yet.
std::string with_section(std::string text, std::string_view name, std::string_view content);
