#include "markdown_section.h"

#include <fmt/format.h>

std::string with_section(std::string text, std::string_view name, std::string_view content)
{
    const std::string begin = fmt::format("<!-- begin {} -->\n", name), end = fmt::format("<!-- end {} -->\n", name);
    const std::string section = fmt::format("{}{}{}", begin, content, end);
    const std::size_t from = text.find(begin), to = text.find(end);
    if (from != std::string::npos && to != std::string::npos && from < to)
        return text.replace(from, to + end.size() - from, section);
    if (!text.empty() && !text.ends_with("\n\n"))
        text += text.ends_with('\n') ? "\n" : "\n\n";
    return text + section;
}
