#pragma once

#include <filesystem>
#include <string>

#include "limn/base/image.h"

namespace limn {

struct PngOptions {
    int bits = 8;              ///< for each sample: 8 or 16
    double pixels_per_mm = 0;  ///< written into the file; 0: not stated
};

/// A picture of 1 to 4 channels (grey, grey and alpha, RGB, RGBA) as PNG. Samples are clamped to [0,1] and rounded to
/// the nearest step; a sample that is no number becomes 0. @throws Error::Input for other channels or bits, or an empty picture.
std::string encode_png(const Image& image, const PngOptions& options = {});
/// @throws Error::Write
void write_png(const Image& image, const std::filesystem::path& path, const PngOptions& options = {});

/// Reads any PNG: palettes become RGB, transparent colours alpha, 1, 2 and 4 bit grey the range [0,1]; samples are
/// value / 255 or value / 65535. `name` stands in messages. @throws Error::Read naming the file, the byte and what is wrong there.
Image decode_png(std::string_view bytes, const std::string& name);
Image read_png(const std::filesystem::path& path);

} // namespace limn
