#include <algorithm>
#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/geometry/readers.h"
#include "limn/geometry/text_lines.h"

namespace limn {
namespace {

constexpr std::size_t header_bytes = 84, record_bytes = 50, grain = 1 << 14;

std::uint32_t load_u32(const char* at)
{
    std::uint32_t value = 0;
    for (int k = 3; k >= 0; --k)
        value = value << 8 | static_cast<unsigned char>(at[k]);
    return value;
}

double load_float(const char* at) { return std::bit_cast<float>(load_u32(at)); }

/// Vertices 3i, 3i+1, 3i+2 become triangle i; the caller welds them.
void number_corners(Mesh& mesh)
{
    mesh.triangles.resize(mesh.positions.size() / 3);
    parallel_each(mesh.triangles.size(), grain, [&](std::size_t i) {
        const std::uint32_t first = std::uint32_t(3 * i);
        mesh.triangles[i] = {first, first + 1, first + 2};
    });
}

void check_count(std::size_t triangles, const std::string& name)
{
    if (triangles >= none / 3)
        throw Error::Read(fmt::format("{}: has {} triangles, more than 32-bit indices can name", name, triangles));
}

Mesh read_binary(std::string_view bytes, const std::string& name)
{
    if (bytes.size() < header_bytes)
        throw Error::Read(fmt::format("{}: byte {}: the file ends inside the STL header of {} bytes", name, bytes.size(), header_bytes));
    const std::size_t count = load_u32(bytes.data() + 80), held = (bytes.size() - header_bytes) / record_bytes;
    if (count > held)
        throw Error::Read(fmt::format("{}: byte 80: the header claims {} triangles of {} bytes, but the file holds {}", name, count,
                                      record_bytes, held));
    check_count(count, name);
    Mesh mesh;
    mesh.positions.resize(3 * count);
    parallel_each(count, grain, [&](std::size_t i) {
        const char* at = bytes.data() + header_bytes + i * record_bytes + 12; // behind the normal
        for (std::size_t k = 0; k < 3; ++k, at += 12)
            mesh.positions[3 * i + k] = {load_float(at), load_float(at + 4), load_float(at + 8)};
    });
    return mesh;
}

bool same_word(std::string_view text, std::string_view lower)
{
    return text.size() == lower.size() && std::equal(text.begin(), text.end(), lower.begin(), [](char a, char b) {
        return (a >= 'A' && a <= 'Z' ? char(a - 'A' + 'a') : a) == b;
    });
}

/// "solid", "facet normal", "outer loop", "vertex x y z", "endloop", "endfacet", "endsolid", in any case of letters,
/// any number of solids.
class AsciiParser {
public:
    AsciiParser(std::string_view bytes, const std::string& name) : lines_(LineBlock{bytes.data(), bytes.data() + bytes.size(), 1}), name_(name) {}

    Mesh parse()
    {
        while (lines_.next()) {
            Fields fields(lines_.line());
            const std::string_view word = fields.next();
            if (!word.empty())
                parse_line(word, fields);
        }
        if (corners_ != -1)
            fail("the file ends inside a facet");
        return std::move(mesh_);
    }

private:
    [[noreturn]] void fail(const std::string& what) const
    {
        throw Error::Read(fmt::format("{}: line {}: {}", name_, lines_.number(), what));
    }

    void parse_line(std::string_view word, Fields& fields)
    {
        if (same_word(word, "vertex")) {
            parse_vertex(fields);
        } else if (same_word(word, "facet")) {
            if (corners_ != -1)
                fail("a facet begins inside another");
            corners_ = 0;
        } else if (same_word(word, "endfacet")) {
            if (corners_ != 3)
                fail(fmt::format("a facet ends with {} vertices where 3 are expected", std::max(corners_, 0)));
            corners_ = -1;
        } else if (!same_word(word, "outer") && !same_word(word, "endloop") && !same_word(word, "solid") && !same_word(word, "endsolid")) {
            fail(fmt::format("found '{}', which is no word of STL", shown(word)));
        }
    }

    void parse_vertex(Fields& fields)
    {
        if (corners_ < 0 || corners_ > 2)
            fail(corners_ < 0 ? "a vertex stands outside of a facet" : "a facet has more than 3 vertices");
        dvec3 p;
        for (int k = 0; k < 3; ++k) {
            const std::string_view field = fields.next();
            if (!parse_real(field, p[k]))
                fail(field.empty() ? fmt::format("a vertex has {} coordinates where 3 are expected", k)
                                   : fmt::format("'{}' is not a number", shown(field)));
        }
        mesh_.positions.push_back(p);
        ++corners_;
    }

    LineWalker lines_;
    const std::string& name_;
    Mesh mesh_;
    int corners_ = -1; ///< of the facet so far; -1: outside of one
};

/// Binary files may begin with "solid" too; text goes on with words of STL and has no zero byte early on.
bool looks_like_text(std::string_view bytes)
{
    Fields fields(bytes.substr(0, 512));
    return same_word(fields.next(), "solid") && bytes.substr(0, 512).find('\0') == std::string_view::npos;
}

} // namespace

bool is_binary_stl(std::string_view bytes)
{
    return bytes.size() >= header_bytes && bytes.size() == header_bytes + record_bytes * std::size_t(load_u32(bytes.data() + 80));
}

Mesh read_stl(FileBytes file)
{
    Mesh mesh;
    if (is_binary_stl(file.bytes) || !looks_like_text(file.bytes)) {
        mesh = read_binary(file.bytes, file.name);
    } else {
        mesh = AsciiParser(file.bytes, file.name).parse();
        check_count(mesh.positions.size() / 3, file.name);
    }
    std::string().swap(file.bytes);
    number_corners(mesh);
    return mesh;
}

} // namespace limn
