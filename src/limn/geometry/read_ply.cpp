#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/geometry/counted.h"
#include "limn/geometry/face_blocks.h"
#include "limn/geometry/ply_header.h"
#include "limn/geometry/readers.h"
#include "limn/geometry/text_lines.h"

namespace limn {
namespace {

constexpr std::size_t rows_per_block = 1 << 14;

/// Where the vertex properties that Limn uses stand in a row; -1: missing.
struct VertexLayout {
    int position[3], normal[3], uv[2], colour[4];
    double colour_scale = 1; ///< makes a colour of its type lie in [0,1]
    bool has_normal = false, has_uv = false, has_colour = false;
};

int find_any(const PlyElement& element, std::initializer_list<std::string_view> names)
{
    for (std::string_view name : names)
        if (const int i = element.find(name); i >= 0 && !element.properties[std::size_t(i)].is_list())
            return i;
    return -1;
}

VertexLayout vertex_layout(const PlyElement& e, const std::string& name)
{
    VertexLayout at{.position = {find_any(e, {"x"}), find_any(e, {"y"}), find_any(e, {"z"})},
                    .normal = {find_any(e, {"nx", "normal_x"}), find_any(e, {"ny", "normal_y"}), find_any(e, {"nz", "normal_z"})},
                    .uv = {find_any(e, {"s", "u", "texture_u"}), find_any(e, {"t", "v", "texture_v"})},
                    .colour = {find_any(e, {"red", "r", "diffuse_red"}), find_any(e, {"green", "g", "diffuse_green"}),
                               find_any(e, {"blue", "b", "diffuse_blue"}), find_any(e, {"alpha", "a"})}};
    for (int k = 0; k < 3; ++k)
        if (at.position[k] < 0)
            throw Error::Read(fmt::format("{}: line {}: its vertices have no property '{}'", name, e.line, "xyz"[k]));
    at.has_normal = at.normal[0] >= 0 && at.normal[1] >= 0 && at.normal[2] >= 0;
    at.has_uv = at.uv[0] >= 0 && at.uv[1] >= 0;
    at.has_colour = at.colour[0] >= 0 && at.colour[1] >= 0 && at.colour[2] >= 0;
    if (at.has_colour) {
        const PlyType type = e.properties[std::size_t(at.colour[0])].type;
        at.colour_scale = type == PlyType::uint8 ? 1.0 / 255 : type == PlyType::uint16 ? 1.0 / 65535 : 1;
    }
    return at;
}

/// The vertices of the file, and the normals and texture coordinates they carry.
struct Vertices {
    VertexLayout layout;
    std::vector<dvec3> positions;
    std::vector<vec3> normals;
    std::vector<vec2> uvs;
    std::vector<vec4> colours;

    Vertices(const VertexLayout& at, std::size_t count)
        : layout(at), positions(count), normals(at.has_normal ? count : 0), uvs(at.has_uv ? count : 0),
          colours(at.has_colour ? count : 0)
    {
    }
    /// Takes vertex v from the values of its row, one for each property.
    void set(std::size_t v, const std::vector<double>& row)
    {
        const auto value = [&](int i) { return row[std::size_t(i)]; };
        positions[v] = {value(layout.position[0]), value(layout.position[1]), value(layout.position[2])};
        if (layout.has_normal)
            normals[v] = {value(layout.normal[0]), value(layout.normal[1]), value(layout.normal[2])};
        if (layout.has_uv)
            uvs[v] = {value(layout.uv[0]), value(layout.uv[1])};
        if (layout.has_colour) {
            const double alpha = layout.colour[3] < 0 ? 1.0 : value(layout.colour[3]) * layout.colour_scale;
            const dvec3 rgb(value(layout.colour[0]), value(layout.colour[1]), value(layout.colour[2]));
            colours[v] = glm::clamp(vec4(rgb * layout.colour_scale, alpha), 0.0f, 1.0f);
        }
    }
};

/// The property that lists the vertices of a face.
int index_property(const PlyElement& faces, const std::string& name)
{
    for (std::string_view candidate : {"vertex_indices", "vertex_index"})
        if (const int i = faces.find(candidate); i >= 0 && faces.properties[std::size_t(i)].is_list())
            return i;
    throw Error::Read(fmt::format("{}: line {}: its faces have no list 'vertex_indices'", name, faces.line));
}

template <class T> T load(const char* at, bool swap)
{
    char bytes[sizeof(T)];
    std::memcpy(bytes, at, sizeof(T));
    if (swap)
        std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

/// A value of any type as double, which holds all of them exactly.
double load_real(const char* at, PlyType type, bool swap)
{
    switch (type) {
    case PlyType::int8: return load<std::int8_t>(at, false);
    case PlyType::uint8: return load<std::uint8_t>(at, false);
    case PlyType::int16: return load<std::int16_t>(at, swap);
    case PlyType::uint16: return load<std::uint16_t>(at, swap);
    case PlyType::int32: return load<std::int32_t>(at, swap);
    case PlyType::uint32: return load<std::uint32_t>(at, swap);
    case PlyType::float32: return load<float>(at, swap);
    case PlyType::float64: return load<double>(at, swap);
    case PlyType::absent: break;
    }
    return 0;
}

/// What every part of the reader needs to know of the file.
struct PlyFile {
    std::string name;
    PlyHeader header;
    const PlyElement* vertex = nullptr;
    const PlyElement* face = nullptr;
    int indices = -1; ///< property of the face
    std::atomic<std::size_t> small_faces = 0;

    std::uint32_t vertex_index(double value, std::string_view place) const
    {
        if (!(value >= 0 && value < double(vertex->count)) || value != std::floor(value))
            throw Error::Read(fmt::format("{}: {}: vertex index {} is outside 0..{}", name, place, value, vertex->count - 1));
        return std::uint32_t(value);
    }

    /// Closes a face whose corners were appended; one with fewer than 3 goes away.
    void end_face(FaceBlock& block, std::size_t size)
    {
        if (size >= 3)
            return block.end_face(std::uint32_t(size));
        block.corners.resize(block.corners.size() - size);
        ++small_faces;
    }
};

/// Runs `work(block, begin, end)` for blocks of rows in parallel; of several errors the one of the first block is thrown.
template <class Work> void for_row_blocks(std::size_t blocks, Work&& work)
{
    std::vector<std::string> errors(blocks);
    parallel_each(blocks, 1, [&](std::size_t b) {
        try {
            work(b);
        } catch (const Error::Read& e) {
            errors[b] = e.what();
        }
    });
    for (const std::string& error : errors)
        if (!error.empty())
            throw Error::Read(error);
}

/// The rows of a binary file. All sizes are checked here, before anything is allocated for them.
class BinaryBody {
public:
    BinaryBody(PlyFile& file, std::string_view bytes)
        : file_(file), bytes_(bytes), swap_((file.header.format == PlyHeader::Format::big_endian) == (std::endian::native == std::endian::little))
    {
        std::size_t at = file.header.size;
        for (const PlyElement& element : file.header.elements) {
            Rows rows = locate(element, at);
            if (&element == file.vertex)
                vertex_rows_ = std::move(rows);
            else if (&element == file.face)
                face_rows_ = std::move(rows);
        }
    }

    void read(Vertices& vertices) const
    {
        const PlyElement& element = *file_.vertex;
        parallel_each(vertex_rows_.size(), 1, [&](std::size_t b) {
            std::vector<double> row(element.properties.size());
            const char* at = bytes_.data() + vertex_rows_[b];
            const std::size_t end = std::min(element.count, (b + 1) * rows_per_block);
            for (std::size_t v = b * rows_per_block; v < end; ++v) {
                for (std::size_t p = 0; p < row.size(); ++p) {
                    const PlyProperty& property = element.properties[p];
                    if (!property.is_list())
                        row[p] = load_real(at, property.type, swap_);
                    at += value_bytes(property, at);
                }
                vertices.set(v, row);
            }
        });
    }

    std::vector<FaceBlock> read_faces() const
    {
        std::vector<FaceBlock> blocks(face_rows_.size());
        for_row_blocks(blocks.size(), [&](std::size_t b) {
            const std::size_t rows = std::min(file_.face->count - b * rows_per_block, rows_per_block);
            blocks[b].corners.reserve(3 * rows);
            const char* at = bytes_.data() + face_rows_[b];
            for (std::size_t row = 0; row < rows; ++row)
                at = read_face(at, blocks[b]);
        });
        return blocks;
    }

private:
    using Rows = std::vector<std::size_t>; ///< byte where each block of rows starts

    [[noreturn]] void truncated(const PlyElement& element, std::size_t row, std::size_t at) const
    {
        throw Error::Read(fmt::format("{}: byte {}: the file ends in row {} of {} of element '{}'", file_.name, at, row, element.count,
                                      shown(element.name)));
    }

    /// Bytes of a value or list that begins at `at` and is known to lie inside the file.
    std::size_t value_bytes(const PlyProperty& property, const char* at) const
    {
        if (!property.is_list())
            return size_of(property.type);
        return size_of(property.count) + std::size_t(load_real(at, property.count, swap_)) * size_of(property.type);
    }

    /// Finds the rows of an element that begin at byte `at`, and moves `at` behind them.
    Rows locate(const PlyElement& element, std::size_t& at) const
    {
        const std::size_t left = bytes_.size() - at, least = element.least_bytes();
        if (least > 0 && element.count > left / least)
            throw Error::Read(fmt::format("{}: byte {}: the header claims {} rows of element '{}', at least {} bytes each, but {} bytes are left",
                                          file_.name, at, element.count, shown(element.name), least, left));
        if (least == 0)
            return {};
        Rows rows((element.count + rows_per_block - 1) / rows_per_block);
        if (!element.has_list()) {
            for (std::size_t b = 0; b < rows.size(); ++b)
                rows[b] = at + b * rows_per_block * least;
            at += element.count * least;
            return rows;
        }
        for (std::size_t row = 0; row < element.count; ++row) {
            if (row % rows_per_block == 0)
                rows[row / rows_per_block] = at;
            skip_row(element, row, at);
        }
        return rows;
    }

    /// Passes by the row of a lone list with a length of one byte, as nearly all files have it. @return false: it has to be looked at
    bool skip_short_list(const PlyElement& element, std::size_t& at) const
    {
        const PlyProperty& property = element.properties[0];
        if (element.properties.size() > 1 || property.count != PlyType::uint8 || at == bytes_.size())
            return false;
        const std::size_t size = 1 + static_cast<unsigned char>(bytes_[at]) * size_of(property.type);
        if (size > bytes_.size() - at)
            return false;
        at += size;
        return true;
    }

    void skip_row(const PlyElement& element, std::size_t row, std::size_t& at) const
    {
        if (skip_short_list(element, at))
            return;
        for (const PlyProperty& property : element.properties) {
            if (bytes_.size() - at < size_of(property.is_list() ? property.count : property.type))
                truncated(element, row, bytes_.size());
            if (property.is_list()) {
                const double count = load_real(bytes_.data() + at, property.count, swap_);
                const std::size_t left = bytes_.size() - at - size_of(property.count);
                if (count < 0 || count > double(left / size_of(property.type)))
                    throw Error::Read(fmt::format("{}: byte {}: a list claims {} items, but {} bytes are left", file_.name, at, count, left));
            }
            at += value_bytes(property, bytes_.data() + at);
        }
    }

    const char* read_face(const char* at, FaceBlock& block) const
    {
        const std::vector<PlyProperty>& properties = file_.face->properties;
        for (std::size_t p = 0; p < properties.size(); ++p) {
            if (int(p) == file_.indices)
                read_indices(at, properties[p], block);
            at += value_bytes(properties[p], at);
        }
        return at;
    }

    void read_indices(const char* at, const PlyProperty& property, FaceBlock& block) const
    {
        const std::size_t count = std::size_t(load_real(at, property.count, swap_));
        at += size_of(property.count);
        if (count == 3 && !swap_ && size_of(property.type) == 4 && property.type != PlyType::float32) {
            std::uint32_t v[3]; // negative ones are too large
            std::memcpy(v, at, sizeof v);
            if (std::max({v[0], v[1], v[2]}) < file_.vertex->count) {
                block.corners.insert(block.corners.end(), v, v + 3);
                return file_.end_face(block, 3);
            }
        }
        for (std::size_t k = 0; k < count; ++k, at += size_of(property.type)) {
            const double value = load_real(at, property.type, swap_);
            if (!(value >= 0 && value < double(file_.vertex->count)))
                file_.vertex_index(value, fmt::format("byte {}", at - bytes_.data()));
            block.corners.push_back(std::uint32_t(value));
        }
        file_.end_face(block, count);
    }

    PlyFile& file_;
    std::string_view bytes_;
    bool swap_;
    Rows vertex_rows_, face_rows_;
};

bool is_blank_line(std::string_view line) { return line.find_first_not_of(" \t\r\n\v\f") == std::string_view::npos; }

/// The rows of an ASCII file: one line each, blank lines not counted.
class AsciiBody {
public:
    AsciiBody(PlyFile& file, std::string_view bytes) : file_(file), lines_(split_lines(bytes, false, file.header.size)), first_row_(lines_.size() + 1, 0)
    {
        parallel_each(lines_.size(), 1, [&](std::size_t b) {
            LineWalker lines(lines_[b]);
            while (lines.next())
                first_row_[b + 1] += !is_blank_line(lines.line());
        });
        for (std::size_t b = 0; b < lines_.size(); ++b)
            first_row_[b + 1] += first_row_[b];
        std::size_t left = first_row_.back();
        for (const PlyElement& element : file.header.elements) {
            if (element.properties.empty())
                continue;
            if (element.count > left)
                throw Error::Read(fmt::format("{}: line {}: the header claims {} rows of element '{}', but {} lines are left for them", file.name,
                                              element.line, element.count, shown(element.name), left));
            left -= element.count;
        }
    }

    /// Reads all rows; vertices go to their place, faces into one block for each block of lines.
    std::vector<FaceBlock> read(Vertices& vertices) const
    {
        std::vector<FaceBlock> faces(lines_.size());
        for_row_blocks(lines_.size(), [&](std::size_t b) { read_block(b, vertices, faces[b]); });
        return faces;
    }

private:
    void read_block(std::size_t b, Vertices& vertices, FaceBlock& faces) const
    {
        LineWalker lines(lines_[b]);
        std::size_t row = first_row_[b];
        auto element = file_.header.elements.begin();
        const auto enter = [&] { // leaves the elements that end before `row`, which then counts from the element's start
            while (element != file_.header.elements.end() && (element->properties.empty() || row >= element->count))
                row -= element->properties.empty() ? 0 : element->count, ++element;
        };
        std::vector<double> values(file_.vertex->properties.size());
        for (enter(); lines.next() && element != file_.header.elements.end();) {
            if (is_blank_line(lines.line()))
                continue;
            if (&*element == file_.vertex) {
                read_vertex(lines, values);
                vertices.set(row, values);
            } else if (&*element == file_.face) {
                read_face(lines, faces);
            }
            ++row;
            enter();
        }
    }

    [[noreturn]] void fail(const LineWalker& lines, const std::string& what) const
    {
        throw Error::Read(fmt::format("{}: line {}: {}", file_.name, lines.number(), what));
    }

    double real(Fields& fields, const LineWalker& lines) const
    {
        const std::string_view field = fields.next();
        double value = 0;
        if (field.empty())
            fail(lines, "the row ends early: it has fewer values than the header lists properties");
        if (!parse_real(field, value))
            fail(lines, fmt::format("'{}' is not a number", shown(field)));
        return value;
    }

    std::size_t list_length(Fields& fields, const LineWalker& lines) const
    {
        const std::string_view field = fields.next();
        std::int64_t count = 0;
        if (!parse_whole(field, count) || count < 0)
            fail(lines, fmt::format("'{}' is not the length of a list", shown(field)));
        return std::size_t(count);
    }

    void read_vertex(const LineWalker& lines, std::vector<double>& values) const
    {
        Fields fields(lines.line());
        for (std::size_t p = 0; p < values.size(); ++p) {
            if (!file_.vertex->properties[p].is_list()) {
                values[p] = real(fields, lines);
                continue;
            }
            for (std::size_t left = list_length(fields, lines); left > 0; --left)
                real(fields, lines);
        }
    }

    void read_face(const LineWalker& lines, FaceBlock& block) const
    {
        Fields fields(lines.line());
        const std::vector<PlyProperty>& properties = file_.face->properties;
        for (int p = 0; p <= file_.indices; ++p) {
            const bool is_list = properties[std::size_t(p)].is_list();
            const std::size_t count = is_list ? list_length(fields, lines) : 1;
            for (std::size_t k = 0; k < count; ++k) {
                const double value = real(fields, lines);
                if (p == file_.indices)
                    block.corners.push_back(file_.vertex_index(value, fmt::format("line {}", lines.number())));
            }
            if (p == file_.indices)
                file_.end_face(block, count);
        }
    }

    PlyFile& file_;
    std::vector<LineBlock> lines_;
    std::vector<std::size_t> first_row_; ///< of each block of lines; one more at the end
};

} // namespace

Mesh read_ply(FileBytes source, bool keep_polygons, std::vector<std::string>& notes)
{
    PlyFile file;
    file.name = source.name;
    file.header = parse_ply_header(source.bytes, file.name);
    file.vertex = file.header.find("vertex");
    file.face = file.header.find("face");
    if (!file.vertex || !file.face)
        throw Error::Read(fmt::format("{}: line {}: the header ends, and named no element '{}' with properties", file.name, file.header.lines, file.vertex ? "face" : "vertex"));
    if (file.vertex->count >= none)
        throw Error::Read(fmt::format("{}: line {}: the header claims {} vertices, more than 32-bit indices can name", file.name, file.vertex->line, file.vertex->count));
    const VertexLayout layout = vertex_layout(*file.vertex, file.name);
    file.indices = index_property(*file.face, file.name);

    const auto finish = [&](Vertices vertices, std::vector<FaceBlock> faces) {
        std::string().swap(source.bytes);
        if (file.small_faces > 0)
            notes.push_back(counted(file.small_faces, "face", "faces") + " with fewer than 3 corners dropped");
        Mesh mesh;
        mesh.positions = std::move(vertices.positions);
        mesh.colours = std::move(vertices.colours);
        assemble_faces(mesh, faces, {}, {}, keep_polygons);
        take_corners_from_vertices(mesh, vertices.normals, vertices.uvs);
        return mesh;
    };
    if (file.header.format == PlyHeader::Format::ascii) {
        const AsciiBody body(file, source.bytes);
        Vertices vertices(layout, file.vertex->count);
        std::vector<FaceBlock> faces = body.read(vertices);
        return finish(std::move(vertices), std::move(faces));
    }
    const BinaryBody body(file, source.bytes);
    Vertices vertices(layout, file.vertex->count);
    body.read(vertices);
    std::vector<FaceBlock> faces = body.read_faces();
    return finish(std::move(vertices), std::move(faces));
}

} // namespace limn
