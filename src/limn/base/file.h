#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace limn {

/// The bytes of a file, or of standard input for "-".
/// @throws Error::Read when it is missing, a directory or unreadable (the message names it and says which).
std::string read_file(const std::filesystem::path& path);

/// Writes `bytes` beside `path` and renames the result onto it, so that nobody sees half a file and an older one
/// survives a failure. "-" writes to standard output.
/// @throws Error::Write when the folder is missing, not writable, or the disk is full; nothing is left behind.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// The ending of a path in lower case without its dot ("svg"), or "" where there is none.
std::string file_ending(const std::filesystem::path& path);

} // namespace limn
