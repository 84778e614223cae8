#pragma once

// Not for users of the library.

#include <string>

namespace limn {

/// Looks through the heights of an Esri ASCII grid: GDAL reads a word that is no number as 0.
/// @param path  as GDAL's file functions know it
/// @param name  of the file, for messages
/// @throws Error::Read naming the line and the word, which may be a decimal number, nan or inf
void check_ascii_grid(const std::string& path, const std::string& name);

} // namespace limn
