#include "limn/drawing/ply_lines.h"

#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"

namespace limn {
namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

template <class T> void append(std::string& bytes, T value)
{
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes.append(raw, sizeof(T));
}

std::size_t edge_count(const Stroke& stroke)
{
    const std::size_t n = stroke.points.size();
    return n < 2 ? 0 : stroke.closed ? n : n - 1;
}

std::string header(std::size_t vertices, std::size_t edges)
{
    std::string types;
    for (int i = 0; i < line_type_count; ++i)
        types += fmt::format(" {}={}", i, line_type_name(LineType(i)));
    return fmt::format("ply\nformat binary_little_endian 1.0\ncomment line types:{}\n"
                       "element vertex {}\nproperty double x\nproperty double y\nproperty double z\nproperty float ink\n"
                       "element edge {}\nproperty int vertex1\nproperty int vertex2\nproperty uchar type\nproperty uchar visible\nproperty uint face\nend_header\n",
                       types, vertices, edges);
}

void add_vertices(std::string& ply, const Stroke& stroke)
{
    if (stroke.world.size() != stroke.points.size())
        throw Error::Input(fmt::format("a stroke of {} points has {} positions in space: it cannot be written as PLY", stroke.points.size(), stroke.world.size()));
    for (std::size_t i = 0; i < stroke.world.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis)
            append(ply, stroke.world[i][axis]);
        append(ply, i < stroke.ink.size() ? stroke.ink[i] : 1.0f);
    }
}

void add_edges(std::string& ply, const Stroke& stroke, std::size_t first)
{
    const std::size_t n = stroke.points.size();
    for (std::size_t i = 0; i < edge_count(stroke); ++i) {
        append(ply, std::int32_t(first + i));
        append(ply, std::int32_t(first + (i + 1) % n));
        append(ply, std::uint8_t(stroke.type));
        append(ply, std::uint8_t(stroke.visible));
        append(ply, i < stroke.faces.size() ? stroke.faces[i] : none);
    }
}

} // namespace

std::string to_ply_lines(const Drawing& drawing)
{
    std::size_t vertices = 0, edges = 0;
    for (const Stroke& stroke : drawing.strokes) {
        vertices += stroke.points.size();
        edges += edge_count(stroke);
    }
    std::string ply = header(vertices, edges);
    for (const Stroke& stroke : drawing.strokes)
        add_vertices(ply, stroke);
    std::size_t first = 0;
    for (const Stroke& stroke : drawing.strokes) {
        add_edges(ply, stroke, first);
        first += stroke.points.size();
    }
    return ply;
}

void write_ply_lines(const Drawing& drawing, const std::filesystem::path& path) { write_file(path, to_ply_lines(drawing)); }

} // namespace limn
