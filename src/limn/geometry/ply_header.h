#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace limn {

/// The scalar types of PLY; `absent` stands where a property is no list.
enum class PlyType : std::uint8_t { absent, int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::absent;  ///< of the value, or of a list's items
    PlyType count = PlyType::absent; ///< of a list's length; `absent`: no list
    bool is_list() const { return count != PlyType::absent; }
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::size_t line = 0; ///< where the header names it; from 1
    std::vector<PlyProperty> properties;

    bool has_list() const;
    /// Bytes of a row in a binary file whose lists are all empty: the row's size where there is no list.
    std::size_t least_bytes() const;
    /// Number of the property, or -1.
    int find(std::string_view property) const;
};

struct PlyHeader {
    enum class Format : std::uint8_t { ascii, little_endian, big_endian };
    Format format = Format::ascii;
    std::vector<PlyElement> elements;
    std::size_t size = 0; ///< bytes, up to the first row
    std::size_t lines = 0; ///< the number of its last

    /// The first element of that name that has properties, or a null pointer.
    const PlyElement* find(std::string_view element) const;
};

/// @param name  of the file, for messages
/// @throws Error::Read naming the line that is no part of a PLY header
PlyHeader parse_ply_header(std::string_view bytes, const std::string& name);

} // namespace limn
