#include "limn/geometry/text_lines.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <string>

#include "limn/base/parallel.h"

namespace limn {
namespace {

constexpr std::size_t block_bytes = 1 << 20;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }

/// One past the end of the line that holds `at`, its line feed included.
const char* after_line(const char* at, const char* end)
{
    const void* feed = std::memchr(at, '\n', std::size_t(end - at));
    return feed ? static_cast<const char*>(feed) + 1 : end;
}

/// True where the line [begin, end), its line feed included, asks to be joined with the next one.
bool ends_in_backslash(const char* begin, const char* end)
{
    while (end > begin && (end[-1] == '\n' || end[-1] == '\r'))
        --end;
    return end > begin && end[-1] == '\\';
}

/// The first start of a line at or after `at` that is not joined to the line before it.
const char* line_start(const char* begin, const char* at, const char* end, bool continued)
{
    do
        at = after_line(at, end);
    while (continued && at < end && ends_in_backslash(begin, at));
    return at;
}

} // namespace

std::vector<LineBlock> split_lines(std::string_view text, bool continued, std::size_t start)
{
    const char* const begin = text.data() + start;
    const char* const end = text.data() + text.size();
    std::vector<LineBlock> blocks;
    for (const char* at = begin; at < end;) {
        const char* stop = std::size_t(end - at) <= block_bytes ? end : line_start(at, at + block_bytes, end, continued);
        blocks.push_back({at, stop, 0});
        at = stop;
    }
    std::vector<std::size_t> lines(blocks.size());
    parallel_each(blocks.size(), 1, [&](std::size_t b) {
        lines[b] = std::size_t(std::count(blocks[b].begin, blocks[b].end, '\n'));
    });
    std::size_t number = 1 + std::size_t(std::count(text.data(), begin, '\n'));
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        blocks[b].first_line = number;
        number += lines[b];
    }
    return blocks;
}

bool LineWalker::next()
{
    if (next_ == end_)
        return false;
    number_ = next_number_;
    const char* const begin = next_;
    const char* stop = after_line(begin, end_);
    ++next_number_;
    if (continued_ && *begin != '#')
        while (stop < end_ && ends_in_backslash(begin, stop)) {
            stop = after_line(stop, end_);
            ++next_number_;
        }
    next_ = stop;
    line_ = {begin, std::size_t(stop - begin)};
    return true;
}

bool Fields::at_blank() const
{
    return is_blank(*at_) || (*at_ == '\\' && at_ + 1 < end_ && (at_[1] == '\n' || at_[1] == '\r'));
}

void Fields::skip_blanks()
{
    while (at_ < end_ && at_blank())
        ++at_;
}

std::string_view Fields::next()
{
    skip_blanks();
    const char* const begin = at_;
    while (at_ < end_ && !at_blank())
        ++at_;
    return {begin, std::size_t(at_ - begin)};
}

std::string_view Fields::rest()
{
    skip_blanks();
    const char* stop = end_;
    while (stop > at_ && is_blank(stop[-1]))
        --stop;
    return {at_, std::size_t(stop - at_)};
}

char Fields::peek()
{
    skip_blanks();
    return at_ < end_ ? *at_ : '\0';
}

bool parse_real(std::string_view field, double& value)
{
    if (!field.empty() && field[0] == '+' && field.size() > 1 && field[1] != '-')
        field.remove_prefix(1);
    const auto [end, failure] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (end != field.data() + field.size() || failure == std::errc::invalid_argument)
        return false;
    if (failure == std::errc::result_out_of_range)
        value = std::strtod(std::string(field).c_str(), nullptr);
    return true;
}

bool parse_whole(std::string_view field, std::int64_t& value)
{
    if (field.size() > 1 && field[0] == '+' && field[1] != '-')
        field.remove_prefix(1);
    const auto [end, failure] = std::from_chars(field.data(), field.data() + field.size(), value);
    return end == field.data() + field.size() && failure == std::errc();
}

std::string shown(std::string_view field)
{
    std::string text;
    for (char c : field.substr(0, 32))
        text += c >= ' ' && c <= '~' ? c : '?';
    return field.size() > 32 ? text + "..." : text;
}

} // namespace limn
