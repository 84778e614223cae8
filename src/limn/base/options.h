#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {

/// What the text of an option stands for: files that know more than text hold a number as a number, and so on.
enum class OptionKind : std::uint8_t {
    text,   ///< a word, a number or a list, as the row's range tells
    number, ///< any number in the range
    whole,  ///< a whole number in the range
    choice, ///< one of the words of the range
    yes_no,
    colour, ///< "#rrggbb"
    yes_no_number, ///< yes, no, or a number in the range after them
    vector, ///< "x,y,z", or the word that stands in the range after it
};

/// One option of a technique, as data: the command line, scene files, the help text and the viewer all read this row.
/// `Options` is the technique's plain struct; the default is whatever a default-made `Options` holds.
template <class Options> struct OptionRow {
    std::string name;                                     ///< as on the command line, without "--"
    std::string unit;                                     ///< "mm", "degrees", "px"; "" where there is none
    std::string range;                                    ///< "0..180", "plain|coloured", "yes|no"
    std::string help;                                     ///< one line, no full stop
    std::function<void(Options&, std::string_view)> set;  ///< throws Error::Input naming the option, value and range
    std::function<std::string(const Options&)> get;       ///< the value as text that `set` accepts
    OptionKind kind = OptionKind::text;
};

template <class Options> using OptionTable = std::vector<OptionRow<Options>>;

/// A finite number that is the whole of `text`. @throws Error::Input naming `name` and the text.
inline double parse_number(std::string_view name, std::string_view text)
{
    double value = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc() || end != text.data() + text.size() || !(value - value == 0))
        throw Error::Input(fmt::format("--{}: '{}' is not a number", name, text));
    return value;
}

/// A row for a number (double, float or int) between `low` and `high` inclusive.
template <class Options, class Number>
OptionRow<Options> number_row(std::string name, std::string unit, double low, double high, std::string help,
                              Number Options::*member)
{
    const std::string range = fmt::format("{}..{}", low, high);
    auto set = [=](Options& options, std::string_view text) {
        const double value = parse_number(name, text);
        if (value < low || value > high || (std::is_integral_v<Number> && std::floor(value) != value))
            throw Error::Input(fmt::format("--{}: {} is outside {}{}", name, text, range,
                                           std::is_integral_v<Number> ? " (a whole number)" : ""));
        options.*member = Number(value);
    };
    auto get = [=](const Options& options) { return fmt::format("{}", options.*member); };
    return {name, std::move(unit), range, std::move(help), set, get, std::is_integral_v<Number> ? OptionKind::whole : OptionKind::number};
}

/// A row for one of several named values.
template <class Options, class Value>
OptionRow<Options> choice_row(std::string name, std::vector<std::pair<std::string, Value>> choices, std::string help,
                              Value Options::*member)
{
    std::string range;
    for (const auto& [word, value] : choices)
        range += (range.empty() ? "" : "|") + word;
    auto set = [=](Options& options, std::string_view text) {
        for (const auto& [word, value] : choices)
            if (word == text) {
                options.*member = value;
                return;
            }
        throw Error::Input(fmt::format("--{}: '{}' is none of {}", name, text, range));
    };
    auto get = [=](const Options& options) {
        for (const auto& [word, value] : choices)
            if (value == options.*member)
                return word;
        return std::string();
    };
    return {name, "", range, std::move(help), set, get, OptionKind::choice};
}

/// A row for a yes/no value.
template <class Options> OptionRow<Options> switch_row(std::string name, std::string help, bool Options::*member)
{
    OptionRow<Options> row = choice_row<Options, bool>(std::move(name), {{"yes", true}, {"no", false}}, std::move(help), member);
    row.kind = OptionKind::yes_no;
    return row;
}

} // namespace limn
