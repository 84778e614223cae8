#pragma once

#include <cstdint>
#include <string_view>

namespace limn {

/// A line of G-code, read from the left. Words are a letter and a number, in any case, with or without spaces; brackets hold comments, and so does all
/// behind a semicolon.
class GcodeWords {
public:
    explicit GcodeWords(std::string_view line) : at_(line.data()), end_(line.data() + line.size()) {}

    /// Goes past spaces and comments in brackets. @return the letter of the next word in upper case, another character that is none, or 0 at the end
    char peek()
    {
        while (at_ < end_) {
            if (*at_ == ' ' || *at_ == '\t' || *at_ == '\r')
                ++at_;
            else if (*at_ == '(')
                skip_brackets();
            else
                return *at_ == ';' ? '\0' : upper(*at_);
        }
        return '\0';
    }
    /// Goes past the letter that peek() told.
    void take_letter() { ++at_; }
    /// Goes past a number: a sign, digits and a point. There are no exponents: X1E2 is two words. @return false where there is none
    bool take_number(double& value);
    /// The same for a whole number without a sign, which follows the letter at once. At most 9 digits.
    bool take_code(int& value);
    /// What is left, for messages and comments.
    std::string_view rest() const { return {at_, std::size_t(end_ - at_)}; }
    const char* position() const { return at_; }

private:
    static char upper(char c) { return c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c; }
    static bool is_digit(char c) { return unsigned(c - '0') < 10; }
    void skip_brackets()
    {
        while (at_ < end_ && *at_ != ')')
            ++at_;
        at_ += at_ < end_;
    }

    const char *at_, *end_;
};

inline bool GcodeWords::take_number(double& value)
{
    static constexpr double tens[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,
                                      1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19};
    constexpr std::uint64_t full = 1'000'000'000'000'000'000; // digits after these do not matter
    const char* p = at_;
    while (p < end_ && *p == ' ')
        ++p;
    const bool negative = p < end_ && *p == '-';
    p += p < end_ && (*p == '-' || *p == '+');
    std::uint64_t digits = 0;
    int decimals = 0, left_out = 0;
    const char* first = p;
    for (; p < end_ && is_digit(*p); ++p) {
        if (digits < full)
            digits = digits * 10 + std::uint64_t(*p - '0');
        else
            ++left_out;
    }
    auto count = p - first;
    if (p < end_ && *p == '.')
        for (first = ++p; p < end_ && is_digit(*p); ++p) {
            ++count;
            if (digits < full && left_out == 0 && decimals < 19) {
                digits = digits * 10 + std::uint64_t(*p - '0');
                ++decimals;
            }
        }
    if (count == 0)
        return false;
    value = double(digits) / tens[decimals];
    for (; left_out > 0 && value < 1e300; --left_out)
        value *= 10;
    value = negative ? -value : value;
    at_ = p;
    return true;
}

inline bool GcodeWords::take_code(int& value)
{
    const char* p = at_;
    int code = 0;
    while (p < end_ && is_digit(*p) && p - at_ < 9)
        code = code * 10 + (*p++ - '0');
    if (p == at_ || (p < end_ && is_digit(*p)))
        return false;
    at_ = p;
    value = code;
    return true;
}

} // namespace limn
