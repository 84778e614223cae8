#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/geometry/face_blocks.h"
#include "limn/geometry/readers.h"
#include "limn/geometry/text_lines.h"

namespace limn {
namespace {

/// Reads OFF: "OFF" (or COFF, NOFF, STOFF, CNOFF...: what follows the coordinates is left out), the counts of vertices, faces
/// and edges, a line for each vertex and for each face; '#' starts a comment.
class OffParser {
public:
    OffParser(std::string_view bytes, const std::string& name)
        : bytes_(bytes), name_(name), lines_(LineBlock{bytes.data(), bytes.data() + bytes.size(), 1})
    {
    }

    Mesh parse(bool keep_polygons)
    {
        const Counts counts = parse_head();
        Mesh mesh;
        mesh.positions.resize(counts.vertices);
        for (dvec3& p : mesh.positions)
            p = parse_vertex();
        std::vector<FaceBlock> faces(1);
        for (std::size_t f = 0; f < counts.faces; ++f)
            parse_face(faces[0], counts.vertices);
        assemble_faces(mesh, faces, {}, {}, keep_polygons);
        return mesh;
    }

private:
    struct Counts {
        std::size_t vertices, faces;
    };

    [[noreturn]] void fail(const std::string& what) const
    {
        throw Error::Read(fmt::format("{}: line {}: {}", name_, lines_.number(), what));
    }

    /// The next field of the current line that is no comment, or "".
    std::string_view field()
    {
        const std::string_view text = fields_.next();
        return text.starts_with('#') ? std::string_view() : text;
    }

    /// Goes to the next line that holds something and gives its first field.
    std::string_view first_field(const char* expected)
    {
        while (lines_.next()) {
            fields_ = Fields(lines_.line());
            if (const std::string_view text = field(); !text.empty())
                return text;
        }
        fail(fmt::format("the file ends where {} is expected", expected));
    }

    double real(std::string_view text) const
    {
        double value = 0;
        if (!parse_real(text, value))
            fail(text.empty() ? "a coordinate is missing" : fmt::format("'{}' is not a number", shown(text)));
        return value;
    }

    std::int64_t whole(std::string_view text, std::int64_t limit, const char* what) const
    {
        std::int64_t value = 0;
        if (!parse_whole(text, value) || value < 0 || value >= limit)
            fail(fmt::format("'{}' is not {} below {}", shown(text), what, limit));
        return value;
    }

    Counts parse_head()
    {
        const std::string_view word = first_field("'OFF'");
        if (!word.ends_with("OFF") || word.find_first_not_of("STCNOF") != std::string_view::npos)
            fail(fmt::format("found '{}' where 'OFF' (3D, ASCII) is expected", shown(word)));
        std::string_view text = field();
        if (text == "BINARY")
            fail("binary OFF is not supported");
        if (text.empty())
            text = first_field("the number of vertices");
        const Counts counts{std::size_t(whole(text, none, "a number of vertices")), std::size_t(whole(field(), none, "a number of faces"))};
        // A vertex takes at least six characters, a face at least two.
        if (6 * counts.vertices + 2 * counts.faces > bytes_.size())
            fail(fmt::format("the file claims {} vertices and {} faces, but has only {} bytes", counts.vertices, counts.faces, bytes_.size()));
        return counts;
    }

    dvec3 parse_vertex()
    {
        const double x = real(first_field("a vertex")), y = real(field());
        return {x, y, real(field())};
    }

    void parse_face(FaceBlock& block, std::size_t vertices)
    {
        const std::int64_t size = whole(first_field("a face"), none, "a number of corners");
        for (std::int64_t k = 0; k < size; ++k)
            block.corners.push_back(std::uint32_t(whole(field(), std::int64_t(vertices), "a vertex index")));
        if (size < 3)
            fail(fmt::format("a face has {} corners", size));
        block.end_face(std::uint32_t(size));
    }

    std::string_view bytes_;
    const std::string& name_;
    LineWalker lines_;
    Fields fields_{""};
};

} // namespace

Mesh read_off(FileBytes file, bool keep_polygons) { return OffParser(file.bytes, file.name).parse(keep_polygons); }

} // namespace limn
