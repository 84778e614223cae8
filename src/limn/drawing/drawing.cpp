#include "limn/drawing/drawing.h"

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

constexpr std::string_view names[line_type_count] = {"iso", "iso-heavy", "highlight", "valley", "ridge", "apparent", "suggestive",
                                                     "crease", "border", "mesh-contour", "contour", "outline"};

} // namespace

std::string_view line_type_name(LineType type) { return names[std::size_t(type)]; }

LineType line_type_from_name(std::string_view name)
{
    std::string known;
    for (int i = 0; i < line_type_count; ++i) {
        if (names[i] == name)
            return LineType(i);
        known += fmt::format("{}{}", i > 0 ? "|" : "", names[i]);
    }
    throw Error::Input(fmt::format("line type '{}' is none of {}", name, known));
}

} // namespace limn
