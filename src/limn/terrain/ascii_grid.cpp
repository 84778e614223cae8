#include "limn/terrain/ascii_grid.h"

#include <algorithm>
#include <cctype>
#include <memory>
#include <string_view>
#include <vector>

#include <cpl_vsi.h>
#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::size_t skip_digits(std::string_view word, std::size_t at)
{
    while (at < word.size() && is_digit(word[at]))
        ++at;
    return at;
}
std::size_t skip_sign(std::string_view word, std::size_t at) { return at < word.size() && (word[at] == '+' || word[at] == '-') ? at + 1 : at; }

/// A decimal number, with a point or a comma as GDAL takes them.
bool is_decimal(std::string_view word)
{
    const std::size_t first = skip_sign(word, 0);
    std::size_t at = skip_digits(word, first), digits = at - first;
    if (at < word.size() && (word[at] == '.' || word[at] == ',')) {
        const std::size_t after = at + 1;
        at = skip_digits(word, after);
        digits += at - after;
    }
    if (digits > 0 && at < word.size() && (word[at] == 'e' || word[at] == 'E')) {
        const std::size_t exponent = skip_sign(word, at + 1);
        at = skip_digits(word, exponent);
        if (at == exponent)
            return false;
    }
    return digits > 0 && at == word.size();
}

std::string lower_case(std::string_view word)
{
    std::string lower(word);
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return lower;
}

template <class Names> bool is_one_of(std::string_view word, const Names& names) { return std::find(std::begin(names), std::end(names), lower_case(word)) != std::end(names); }

bool is_number(std::string_view word)
{
    constexpr std::string_view others[] = {"nan", "inf", "infinity"};
    return is_decimal(word) || is_one_of(word.substr(skip_sign(word, 0)), others);
}

bool is_header_name(std::string_view word)
{
    constexpr std::string_view names[] = {"ncols", "nrows", "xllcorner", "yllcorner", "xllcenter", "yllcenter", "cellsize", "dx", "dy", "nodata_value"};
    return is_one_of(word, names);
}

/// Takes the words of a file one after the other. Lines of its header have a name and a number.
class WordCheck {
public:
    explicit WordCheck(const std::string& name) : name_(name) {}
    void take(std::string_view word)
    {
        if (!is_number(word) && !is_header_name(word))
            throw Error::Read(fmt::format("{}: line {}: '{}' is no number", name_, line_, word.substr(0, 40)));
    }
    void end_line() { ++line_; }

private:
    const std::string& name_;
    std::size_t line_ = 1;
};

struct CloseFile {
    void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

} // namespace

void check_ascii_grid(const std::string& path, const std::string& name)
{
    constexpr std::size_t block = std::size_t(1) << 20, longest_word = 1000;
    const std::unique_ptr<VSILFILE, CloseFile> file(VSIFOpenL(path.c_str(), "rb"));
    if (!file)
        throw Error::Read(name + ": cannot be read");
    WordCheck check(name);
    std::vector<char> bytes(block);
    std::string begun; // of a word that goes on in the next block
    for (std::size_t read; (read = VSIFReadL(bytes.data(), 1, block, file.get())) > 0;) {
        std::size_t at = 0;
        while (at < read) {
            if (is_space(bytes[at])) {
                if (!begun.empty())
                    check.take(begun), begun.clear();
                if (bytes[at] == '\n')
                    check.end_line();
                ++at;
                continue;
            }
            const std::size_t start = at;
            while (at < read && !is_space(bytes[at]))
                ++at;
            const std::string_view word(bytes.data() + start, at - start);
            if (at == read || !begun.empty())
                begun.append(word.substr(0, longest_word));
            else
                check.take(word);
        }
    }
    if (!begun.empty())
        check.take(begun);
}

} // namespace limn
