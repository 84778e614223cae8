#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "limn/base/image.h"

namespace limn {

/// A Radiance picture (.hdr, RGBE, plain or run-length coded): light in RGB, linear, of any size. Rows from top to bottom.
/// @param name  of the file, in messages
/// @throws Error::Read for what is none, is truncated or damaged, is in XYZ, or lies on its side
Image decode_hdr(std::string_view bytes, const std::string& name);
Image read_hdr(const std::filesystem::path& path);

/// The same back, plain. @throws Error::Input for other channels than three and an empty picture.
std::string encode_hdr(const Image& image);

} // namespace limn
