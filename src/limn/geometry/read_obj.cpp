#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/geometry/counted.h"
#include "limn/geometry/face_blocks.h"
#include "limn/geometry/readers.h"
#include "limn/geometry/text_lines.h"

namespace limn {
namespace {

/// How many of each kind of vertex stand in a part of the file.
struct Counts {
    std::size_t positions = 0, uvs = 0, normals = 0;
};

/// "o", "g" or "usemtl": from this face of the block on.
struct NameChange {
    std::uint32_t face;
    char kind; ///< first letter of the keyword
    std::string_view name;
};

struct Note {
    std::size_t count = 0, line = 0;
    std::string_view example;

    void add(std::size_t at, std::string_view what)
    {
        if (count++ == 0) {
            line = at;
            example = what;
        }
    }
};

/// What one block of lines holds besides the vertices, which go straight to their place.
struct ObjBlock {
    FaceBlock faces;
    std::vector<NameChange> names;
    std::vector<vec4> colours; ///< of all vertices of the block; empty: none of them has one
    std::vector<CreaseEdge> creases;
    Note small_faces, unknown;
    std::string error;
};

struct ObjFile {
    std::string name;
    Counts totals;
    std::vector<dvec3> positions;
    std::vector<vec2> uvs;
    std::vector<vec3> normals;
};

constexpr std::string_view known_keywords[] = {
    "mtllib", "s", "l", "p", "vp", "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim", "hole", "scrv",
    "sp", "end", "con", "mg", "bevel", "c_interp", "d_interp", "lod", "maplib", "usemap", "shadow_obj", "trace_obj", "ctech",
    "stech", "call", "csh"};

bool is_known(std::string_view keyword)
{
    return std::find(std::begin(known_keywords), std::end(known_keywords), keyword) != std::end(known_keywords);
}

Counts count_vertices(const LineBlock& block)
{
    Counts counts;
    LineWalker lines(block, true);
    while (lines.next()) {
        Fields fields(lines.line());
        if (fields.peek() != 'v')
            continue;
        const std::string_view keyword = fields.next();
        counts.positions += keyword == "v";
        counts.uvs += keyword == "vt";
        counts.normals += keyword == "vn";
    }
    return counts;
}

/// Parses the lines of one block. Vertices are written into the file's arrays from `at` on.
class BlockParser {
public:
    BlockParser(ObjFile& file, Counts at, ObjBlock& out) : file_(file), at_(at), first_position_(at.positions), out_(out) {}

    void parse(const LineBlock& block)
    {
        LineWalker lines(block, true);
        while (lines.next()) {
            line_ = lines.number();
            Fields fields(lines.line());
            const std::string_view keyword = fields.next();
            if (!keyword.empty() && keyword[0] != '#')
                parse_line(keyword, fields);
        }
        if (!out_.colours.empty())
            out_.colours.resize(at_.positions - first_position_, vec4(1));
    }

private:
    void parse_line(std::string_view keyword, Fields& fields)
    {
        if (keyword == "v")
            parse_position(fields);
        else if (keyword == "f" || keyword == "fo")
            parse_face(fields);
        else if (keyword == "vn")
            parse_numbers(fields, &file_.normals[at_.normals++].x, 3, 3);
        else if (keyword == "vt")
            parse_numbers(fields, &file_.uvs[at_.uvs++].x, 1, 2);
        else if (keyword == "o" || keyword == "g" || keyword == "usemtl")
            out_.names.push_back({std::uint32_t(out_.faces.face_count()), keyword[0], fields.rest()});
        else if (keyword == "t")
            parse_tag(fields);
        else if (!is_known(keyword))
            out_.unknown.add(line_, keyword);
    }

    [[noreturn]] void fail(const std::string& what) const
    {
        throw Error::Read(fmt::format("{}: line {}: {}", file_.name, line_, what));
    }

    double real(std::string_view field) const
    {
        double value = 0;
        if (!parse_real(field, value))
            fail(fmt::format("'{}' is not a number", shown(field)));
        return value;
    }

    std::string_view next(Fields& fields) const
    {
        const std::string_view field = fields.next();
        return field.starts_with('#') ? std::string_view() : field;
    }

    /// Reads up to `most` numbers into `values`; further ones are left alone.
    void parse_numbers(Fields& fields, float* values, int least, int most) const
    {
        for (int k = 0; k < most; ++k) {
            const std::string_view field = next(fields);
            if (field.empty() && k < least)
                fail(fmt::format("found {} numbers where {} are expected", k, least));
            if (field.empty())
                return;
            values[k] = float(real(field));
        }
    }

    /// "v x y z", "v x y z w" (the weight is ignored), "v x y z r g b" or "v x y z r g b a".
    void parse_position(Fields& fields)
    {
        double value[7] = {0, 0, 0, 1, 1, 1, 1};
        int count = 0;
        for (std::string_view field = next(fields); !field.empty() && count < 7; field = next(fields))
            value[count++] = real(field);
        if (count < 3)
            fail(fmt::format("a vertex has {} coordinates where 3 are expected", count));
        const std::size_t index = at_.positions++;
        file_.positions[index] = {value[0], value[1], value[2]};
        if (count >= 6) {
            out_.colours.resize(index - first_position_, vec4(1));
            out_.colours.push_back(glm::clamp(vec4(value[3], value[4], value[5], count == 7 ? value[6] : 1.0), 0.0f, 1.0f));
        }
    }

    /// Turns an index of the file (from 1, or negative: from the end of what stands before this line) into one from 0.
    std::uint32_t resolve(std::string_view text, std::size_t before, std::size_t total, const char* kind) const
    {
        std::int64_t index = 0;
        if (!parse_whole(text, index))
            fail(fmt::format("'{}' is not an index", shown(text)));
        const std::int64_t absolute = index < 0 ? std::int64_t(before) + index : index - 1;
        if (absolute < 0 || absolute >= std::int64_t(total))
            fail(fmt::format("{} index {} is out of range: the file has {}", kind, index, total));
        return std::uint32_t(absolute);
    }

    /// Adds a texture or normal index to a list that stays empty as long as no corner has one.
    void add_optional(std::vector<std::uint32_t>& list, std::string_view text, std::size_t before, std::size_t total, const char* kind) const
    {
        if (text.empty() && list.empty())
            return;
        list.resize(out_.faces.corners.size() - 1, none);
        list.push_back(text.empty() ? none : resolve(text, before, total, kind));
    }

    void parse_corner(std::string_view field)
    {
        const std::size_t slash = field.find('/');
        out_.faces.corners.push_back(resolve(field.substr(0, slash), at_.positions, file_.totals.positions, "vertex"));
        std::string_view uv, normal;
        if (slash != std::string_view::npos) {
            uv = field.substr(slash + 1);
            const std::size_t second = uv.find('/');
            if (second != std::string_view::npos) {
                normal = uv.substr(second + 1);
                uv = uv.substr(0, second);
            }
        }
        add_optional(out_.faces.uvs, uv, at_.uvs, file_.totals.uvs, "texture");
        add_optional(out_.faces.normals, normal, at_.normals, file_.totals.normals, "normal");
    }

    void parse_face(Fields& fields)
    {
        FaceBlock& faces = out_.faces;
        std::uint32_t size = 0;
        for (std::string_view field = next(fields); !field.empty(); field = next(fields), ++size)
            parse_corner(field);
        if (size >= 3)
            return faces.end_face(size);
        out_.small_faces.add(line_, "f");
        faces.corners.resize(faces.corners.size() - size);
        faces.uvs.resize(std::min(faces.uvs.size(), faces.corners.size()));
        faces.normals.resize(std::min(faces.normals.size(), faces.corners.size()));
    }

    /// "t crease 2/1/0 a b sharpness" (or more vertices: a path). Its vertices count from 0, as OpenSubdiv writes them.
    void parse_tag(Fields& fields)
    {
        if (next(fields) != "crease")
            return;
        const std::string_view counts = next(fields);
        std::int64_t whole = 0, real_count = 0;
        const std::size_t slash = std::min(counts.find('/'), counts.size());
        const std::string_view after = counts.substr(std::min(slash + 1, counts.size()));
        if (!parse_whole(counts.substr(0, slash), whole) || !parse_whole(after.substr(0, after.find('/')), real_count) ||
            whole < 2 || real_count < 1)
            fail(fmt::format("'{}' are not the counts of a crease tag, such as 2/1/0", shown(counts)));
        std::vector<std::uint32_t> path;
        for (std::int64_t i = 0; i < whole; ++i) {
            std::int64_t vertex = 0;
            const std::string_view field = next(fields);
            if (!parse_whole(field, vertex) || vertex < 0 || vertex >= std::int64_t(file_.totals.positions))
                fail(fmt::format("'{}' is not a vertex of a crease (they count from 0; the file has {})", shown(field),
                                 file_.totals.positions));
            path.push_back(std::uint32_t(vertex));
        }
        double sharpness = 0;
        for (std::size_t i = 0; i + 1 < path.size(); ++i) {
            if (i == 0 || std::int64_t(i) < real_count)
                sharpness = real(next(fields));
            out_.creases.push_back({path[i], path[i + 1], float(sharpness)});
        }
    }

    ObjFile& file_;
    Counts at_;
    std::size_t first_position_;
    ObjBlock& out_;
    std::size_t line_ = 0;
};

/// Where each block's vertices start; fills in the totals.
std::vector<Counts> vertex_offsets(const std::vector<LineBlock>& lines, ObjFile& file)
{
    std::vector<Counts> counts(lines.size());
    parallel_each(lines.size(), 1, [&](std::size_t b) { counts[b] = count_vertices(lines[b]); });
    Counts& sum = file.totals;
    for (Counts& c : counts) {
        const Counts here = c;
        c = sum;
        sum = {sum.positions + here.positions, sum.uvs + here.uvs, sum.normals + here.normals};
    }
    return counts;
}

std::vector<ObjBlock> parse_blocks(const std::vector<LineBlock>& lines, const std::vector<Counts>& offsets, ObjFile& file)
{
    std::vector<ObjBlock> blocks(lines.size());
    parallel_each(lines.size(), 1, [&](std::size_t b) {
        try {
            BlockParser(file, offsets[b], blocks[b]).parse(lines[b]);
        } catch (const Error::Read& e) {
            blocks[b].error = e.what();
        }
    });
    for (const ObjBlock& block : blocks)
        if (!block.error.empty())
            throw Error::Read(block.error);
    return blocks;
}

/// Gives each combination of object, group and material that holds faces a number, and tells the blocks.
void number_groups(std::vector<ObjBlock>& blocks, std::vector<std::string>& names)
{
    const bool any = std::any_of(blocks.begin(), blocks.end(), [](const ObjBlock& b) { return !b.names.empty(); });
    if (!any)
        return;
    std::map<std::string, std::uint32_t> numbers;
    std::string object, group, material;
    const auto number = [&] {
        std::string joined;
        for (const std::string* part : {&object, &group, &material})
            if (!part->empty())
                joined += (joined.empty() ? "" : "/") + *part;
        const auto [place, added] = numbers.try_emplace(joined, std::uint32_t(names.size()));
        if (added)
            names.push_back(joined);
        return place->second;
    };
    for (ObjBlock& block : blocks) {
        const std::uint32_t faces = std::uint32_t(block.faces.face_count());
        std::uint32_t from = 0;
        for (std::size_t i = 0; i <= block.names.size(); ++i) {
            const std::uint32_t until = i < block.names.size() ? block.names[i].face : faces;
            if (until > from)
                block.faces.groups.push_back({from, number()});
            from = until;
            if (i < block.names.size())
                (block.names[i].kind == 'o' ? object : block.names[i].kind == 'g' ? group : material) = block.names[i].name;
        }
    }
}

std::vector<vec4> join_colours(const std::vector<ObjBlock>& blocks, const std::vector<Counts>& offsets, std::size_t total)
{
    std::vector<vec4> colours;
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (!blocks[b].colours.empty()) {
            colours.resize(total, vec4(1));
            std::copy(blocks[b].colours.begin(), blocks[b].colours.end(), colours.begin() + std::ptrdiff_t(offsets[b].positions));
        }
    return colours;
}

void add_note(const std::vector<ObjBlock>& blocks, Note ObjBlock::*member, const char* one, const char* many,
              const char* text, std::vector<std::string>& notes)
{
    Note sum;
    for (const ObjBlock& block : blocks) {
        const Note& note = block.*member;
        if (sum.count == 0)
            sum = note;
        else
            sum.count += note.count;
    }
    if (sum.count > 0)
        notes.push_back(fmt::format("{} {} ({}'{}' in line {})", counted(sum.count, one, many), text, sum.count > 1 ? "the first: " : "",
                                    shown(sum.example), sum.line));
}

} // namespace

Mesh read_obj(FileBytes source, bool keep_polygons, std::vector<std::string>& notes)
{
    ObjFile file{.name = std::move(source.name), .totals = {}, .positions = {}, .uvs = {}, .normals = {}};
    const std::vector<LineBlock> lines = split_lines(source.bytes, true);
    const std::vector<Counts> offsets = vertex_offsets(lines, file);
    if (file.totals.positions >= none)
        throw Error::Read(fmt::format("{}: has {} vertices, more than 32-bit indices can name", file.name, file.totals.positions));
    file.positions.resize(file.totals.positions);
    file.uvs.resize(file.totals.uvs);
    file.normals.resize(file.totals.normals);
    std::vector<ObjBlock> blocks = parse_blocks(lines, offsets, file);
    add_note(blocks, &ObjBlock::small_faces, "face", "faces", "with fewer than 3 corners dropped", notes);
    add_note(blocks, &ObjBlock::unknown, "line", "lines", "with an unknown keyword ignored", notes);

    Mesh mesh;
    mesh.positions = std::move(file.positions);
    mesh.colours = join_colours(blocks, offsets, mesh.positions.size());
    number_groups(blocks, mesh.group_names);
    std::string().swap(source.bytes);
    std::vector<FaceBlock> faces;
    faces.reserve(blocks.size());
    for (ObjBlock& block : blocks) {
        faces.push_back(std::move(block.faces));
        if (keep_polygons)
            mesh.creases.insert(mesh.creases.end(), block.creases.begin(), block.creases.end());
    }
    assemble_faces(mesh, faces, file.uvs, file.normals, keep_polygons);
    return mesh;
}

} // namespace limn
