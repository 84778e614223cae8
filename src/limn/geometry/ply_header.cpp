#include "limn/geometry/ply_header.h"

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/geometry/text_lines.h"

namespace limn {
namespace {

struct TypeName {
    std::string_view name;
    PlyType type;
};

constexpr TypeName type_names[] = {
    {"char", PlyType::int8},     {"int8", PlyType::int8},       {"uchar", PlyType::uint8},    {"uint8", PlyType::uint8},
    {"short", PlyType::int16},   {"int16", PlyType::int16},     {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},
    {"int", PlyType::int32},     {"int32", PlyType::int32},     {"uint", PlyType::uint32},    {"uint32", PlyType::uint32},
    {"float", PlyType::float32}, {"float32", PlyType::float32}, {"double", PlyType::float64}, {"float64", PlyType::float64}};

/// Reads the lines of a header one after the other.
class HeaderParser {
public:
    HeaderParser(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

    PlyHeader parse()
    {
        if (Fields(line()).next() != "ply")
            fail("found no 'ply', with which a PLY file begins");
        parse_format();
        while (parse_line()) {
        }
        header_.size = at_;
        header_.lines = number_;
        return std::move(header_);
    }

private:
    [[noreturn]] void fail(const std::string& what) const
    {
        throw Error::Read(fmt::format("{}: line {}: {}", name_, number_, what));
    }

    std::string_view line()
    {
        ++number_;
        const std::size_t end = bytes_.find('\n', at_);
        if (end == std::string_view::npos)
            fail("the file ends inside the PLY header");
        const std::string_view text = bytes_.substr(at_, end - at_);
        at_ = end + 1;
        return text;
    }

    PlyType type(std::string_view word) const
    {
        for (const TypeName& t : type_names)
            if (t.name == word)
                return t.type;
        fail(fmt::format("'{}' is not a type of PLY", shown(word)));
    }

    void parse_format()
    {
        Fields fields("");
        std::string_view word;
        do {
            fields = Fields(line());
            word = fields.next();
        } while (word == "comment" || word == "obj_info" || word.empty());
        const std::string_view format = fields.next();
        if (word != "format")
            fail(fmt::format("found '{}' where 'format' is expected", shown(word)));
        if (format == "ascii")
            header_.format = PlyHeader::Format::ascii;
        else if (format == "binary_little_endian")
            header_.format = PlyHeader::Format::little_endian;
        else if (format == "binary_big_endian")
            header_.format = PlyHeader::Format::big_endian;
        else
            fail(fmt::format("'{}' is none of ascii, binary_little_endian, binary_big_endian", shown(format)));
    }

    /// @return false at the header's end
    bool parse_line()
    {
        Fields fields(line());
        const std::string_view word = fields.next();
        if (word == "end_header")
            return false;
        if (word == "element")
            parse_element(fields);
        else if (word == "property")
            parse_property(fields);
        else if (word != "comment" && word != "obj_info" && !word.empty())
            fail(fmt::format("found '{}' where element, property, comment or end_header is expected", shown(word)));
        return true;
    }

    void parse_element(Fields& fields)
    {
        PlyElement element;
        element.name = fields.next();
        element.line = number_;
        const std::string_view count = fields.next();
        std::int64_t value = 0;
        if (!parse_whole(count, value) || value < 0)
            fail(fmt::format("'{}' is not a number of elements", shown(count)));
        element.count = std::size_t(value);
        header_.elements.push_back(std::move(element));
    }

    void parse_property(Fields& fields)
    {
        if (header_.elements.empty())
            fail("a property stands before the first element");
        PlyProperty property;
        std::string_view word = fields.next();
        if (word == "list") {
            property.count = type(fields.next());
            if (property.count == PlyType::float32 || property.count == PlyType::float64)
                fail("the length of a list must be a whole number");
            word = fields.next();
        }
        property.type = type(word);
        property.name = fields.next();
        if (property.name.empty())
            fail("a property has no name");
        header_.elements.back().properties.push_back(std::move(property));
    }

    std::string_view bytes_;
    const std::string& name_;
    PlyHeader header_;
    std::size_t at_ = 0, number_ = 0;
};

} // namespace

std::size_t size_of(PlyType type)
{
    constexpr std::size_t sizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[std::size_t(type)];
}

bool PlyElement::has_list() const
{
    for (const PlyProperty& p : properties)
        if (p.is_list())
            return true;
    return false;
}

std::size_t PlyElement::least_bytes() const
{
    std::size_t bytes = 0;
    for (const PlyProperty& p : properties)
        bytes += size_of(p.is_list() ? p.count : p.type);
    return bytes;
}

int PlyElement::find(std::string_view property) const
{
    for (std::size_t i = 0; i < properties.size(); ++i)
        if (properties[i].name == property)
            return int(i);
    return -1;
}

const PlyElement* PlyHeader::find(std::string_view element) const
{
    for (const PlyElement& e : elements)
        if (e.name == element && !e.properties.empty())
            return &e;
    return nullptr;
}

PlyHeader parse_ply_header(std::string_view bytes, const std::string& name) { return HeaderParser(bytes, name).parse(); }

} // namespace limn
