#include "limn/drawing/write_drawing.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/drawing/dxf.h"
#include "limn/drawing/json.h"
#include "limn/drawing/pdf.h"
#include "limn/drawing/ply_lines.h"
#include "limn/drawing/raster.h"
#include "limn/drawing/svg.h"

namespace limn {
namespace {

constexpr std::array<std::string_view, 6> formats = {"svg", "pdf", "png", "dxf", "json", "ply"};

} // namespace

std::span<const std::string_view> drawing_formats() { return formats; }

std::string drawing_format(const std::filesystem::path& path, std::string_view format)
{
    const std::string wanted = format.empty() ? file_ending(path) : std::string(format);
    if (std::find(formats.begin(), formats.end(), wanted) != formats.end())
        return wanted;
    const std::string known = fmt::format("{}", fmt::join(formats, ", "));
    if (!format.empty())
        throw Error::Input(fmt::format("--to: a drawing cannot be written as '{}', but as {}", format, known));
    if (path == "-")
        throw Error::Input(fmt::format("standard output has no ending: give --to with one of {}", known));
    throw Error::Input(fmt::format("{}: the ending '{}' names no format for a drawing; known are {}", path.string(), wanted, known));
}

std::string encode_drawing(const Drawing& drawing, const Style& style, std::string_view format)
{
    const std::string known = drawing_format({}, format.empty() ? "?" : format);
    if (known == "svg")
        return to_svg(drawing, style);
    if (known == "pdf")
        return to_pdf(drawing, style);
    if (known == "png")
        return to_png(drawing, style);
    if (known == "dxf")
        return to_dxf(drawing, style);
    return known == "json" ? to_json(drawing) : to_ply_lines(drawing);
}

void write_drawing(const Drawing& drawing, const Style& style, const std::filesystem::path& path, std::string_view format)
{
    write_file(path, encode_drawing(drawing, style, drawing_format(path, format)));
}

} // namespace limn
