#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace limn {

/// A run of whole lines of a text that one thread parses.
struct LineBlock {
    const char* begin = nullptr;
    const char* end = nullptr;
    std::size_t first_line = 1; ///< number of its first line in the file, from 1
};

/// Cuts a text into blocks of whole lines of about a megabyte, numbered; the cut depends on the text alone.
/// @param continued  a backslash before the line's end joins it with the next: no cut is made there
/// @param start      where in `text` to begin; lines before it count
std::vector<LineBlock> split_lines(std::string_view text, bool continued, std::size_t start = 0);

/// Walks over the lines of a block. With `continued`, lines that end in a backslash are joined with their successors,
/// except comments (whose first character is '#').
class LineWalker {
public:
    explicit LineWalker(const LineBlock& block, bool continued = false)
        : next_(block.begin), end_(block.end), next_number_(block.first_line), continued_(continued)
    {
    }
    /// Goes to the next line. @return false after the last one
    bool next();
    std::string_view line() const { return line_; }
    /// Number of the line in the file, from 1 (of the first one where several were joined).
    std::size_t number() const { return number_; }

private:
    const char* next_;
    const char* end_;
    std::string_view line_;
    std::size_t number_ = 0, next_number_;
    bool continued_;
};

/// Cuts a line into fields at blanks; a backslash before the end of a joined line counts as a blank.
class Fields {
public:
    explicit Fields(std::string_view line) : at_(line.data()), end_(line.data() + line.size()) {}
    /// The next field, or "" at the end of the line.
    std::string_view next();
    /// What is left of the line, without blanks around it.
    std::string_view rest();
    /// The next character that is not blank, or 0.
    char peek();

private:
    bool at_blank() const;
    void skip_blanks();
    const char* at_;
    const char* end_;
};

/// Reads a number that is the whole of `field`: "1", "+.5", "-2e3", "nan", "inf". What is too large becomes infinite,
/// what is too small 0. @return false where it is not a number
bool parse_real(std::string_view field, double& value);
/// Reads a whole number that is the whole of `field`. @return false where it is not one or does not fit
bool parse_whole(std::string_view field, std::int64_t& value);

/// A field as it is shown in a message: shortened, without control characters.
std::string shown(std::string_view field);

} // namespace limn
