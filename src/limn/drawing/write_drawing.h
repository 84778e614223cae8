#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "limn/drawing/style.h"

namespace limn {

/// The formats a drawing can be written in: svg, pdf, png, dxf, json, ply.
std::span<const std::string_view> drawing_formats();

/// The bytes of a drawing in one of them. @throws Error::Input for another one, naming those known.
std::string encode_drawing(const Drawing& drawing, const Style& style, std::string_view format);

/// Writes a drawing in the format that the ending of `path` names, or in `format` where that is given ("-", standard
/// output, needs it). @throws Error::Input for an unknown ending or format, before anything is written; Error::Write.
void write_drawing(const Drawing& drawing, const Style& style, const std::filesystem::path& path, std::string_view format = "");

/// The format that write_drawing would use. @throws Error::Input for an unknown one.
std::string drawing_format(const std::filesystem::path& path, std::string_view format = "");

} // namespace limn
