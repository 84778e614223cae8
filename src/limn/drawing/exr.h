#pragma once

#include <filesystem>
#include <string>

#include "limn/base/image.h"

namespace limn {

/// A picture as OpenEXR with 32-bit float samples, ZIP-compressed: one channel Y, or R, G and B. Samples stand as they are.
/// @throws Error::Input for other channels or an empty picture.
std::string encode_exr(const Image& image);
/// @throws Error::Write
void write_exr(const Image& image, const std::filesystem::path& path);

} // namespace limn
