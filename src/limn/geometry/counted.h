#pragma once

#include <string>

#include <fmt/format.h>

namespace limn {

/// "1 face", "2 faces".
inline std::string counted(std::size_t count, const char* one, const char* many) { return fmt::format("{} {}", count, count == 1 ? one : many); }

} // namespace limn
