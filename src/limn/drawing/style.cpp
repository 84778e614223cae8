#include "limn/drawing/style.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

namespace limn {
namespace {

using Colours = std::array<std::uint32_t, line_type_count>; ///< 0xRRGGBB in the order of LineType

//                               iso       heavy     highlight valley    ridge     apparent  suggest.  crease    border    mesh      contour   outline
constexpr Colours plain_colours = {0xa0683c, 0x8a5024, 0xb4b4b4, 0x000000, 0x000000, 0x000000, 0x000000, 0x000000, 0x000000, 0x000000, 0x000000, 0x000000};
constexpr Colours type_colours = {0xb06a3b, 0x9a5528, 0xe0a21b, 0x7a3e9d, 0x2e8b3d, 0x0f8b8d, 0xc8352b, 0x6b4a2f, 0x4d5a66, 0x24478f, 0x1d3f94, 0x000000};
constexpr Colours dark_colours = {0x8c8c8c, 0xa0a0a0, 0xffffff, 0x000000, 0xf0f0f0, 0x000000, 0x000000, 0x000000, 0x000000, 0x000000, 0x000000, 0x000000};

constexpr double default_widths[line_type_count] = {0.13, 0.25, 0.35, 0.30, 0.30, 0.35, 0.35, 0.40, 0.40, 0.50, 0.50, 0.70};

vec3 colour_of(std::uint32_t rgb)
{
    return vec3(float(rgb >> 16 & 255), float(rgb >> 8 & 255), float(rgb & 255)) / 255.0f;
}

std::uint32_t rgb_of(const vec3& colour)
{
    const auto byte = [](float c) { return std::uint32_t(std::lround(std::clamp(c, 0.0f, 1.0f) * 255)); };
    return byte(colour.r) << 16 | byte(colour.g) << 8 | byte(colour.b);
}

bool same_word(std::string_view a, std::string_view b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

bool remove_ending(std::string_view& text, std::string_view ending)
{
    if (text.size() < ending.size() || !same_word(text.substr(text.size() - ending.size()), ending))
        return false;
    text.remove_suffix(ending.size());
    return true;
}

struct NamedPage {
    std::string_view name;
    double width, height;
};
constexpr NamedPage known_pages[] = {{"A5", 148, 210}, {"A4", 210, 297}, {"A3", 297, 420}, {"A2", 420, 594},
                                     {"Letter", 215.9, 279.4}, {"Legal", 215.9, 355.6}};

[[noreturn]] void refuse_page(std::string_view text)
{
    throw Error::Input(fmt::format("--page: '{}' is none of none|A5|A4|A3|A2|Letter|Legal (with -portrait or -landscape) and no WxHmm", text));
}

double page_length(std::string_view whole, std::string_view number)
{
    double value = 0;
    const auto [end, failure] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (failure != std::errc() || end != number.data() + number.size() || number.empty())
        refuse_page(whole);
    if (!(value >= 10 && value <= 20000))
        throw Error::Input(fmt::format("--page: {} mm in '{}' is outside 10..20000 mm", number, whole));
    return value;
}

/// Calls `set(type, value)` for each "type=value" of a list, or for every type where the text is one bare value.
template <class Set> void for_each_type(std::string_view option, std::string_view text, Set&& set)
{
    while (true) {
        const std::size_t comma = text.find(',');
        const std::string_view part = text.substr(0, comma);
        const std::size_t equals = part.find('=');
        if (equals == std::string_view::npos && part.empty())
            throw Error::Input(fmt::format("--{}: a value is missing; give VALUE or TYPE=VALUE,...", option));
        if (equals == std::string_view::npos) {
            for (int i = 0; i < line_type_count; ++i)
                set(LineType(i), part);
        } else {
            try {
                set(line_type_from_name(part.substr(0, equals)), part.substr(equals + 1));
            } catch (const Error::Input& error) {
                const std::string message = error.what();
                throw Error::Input(message.starts_with("--") ? message : fmt::format("--{}: {}", option, message));
            }
        }
        if (comma == std::string_view::npos)
            return;
        text.remove_prefix(comma + 1);
    }
}

double width_from_text(std::string_view text)
{
    std::string_view number = text;
    remove_ending(number, "mm");
    const double width = parse_number("width", number);
    if (!(width >= 0.01 && width <= 50))
        throw Error::Input(fmt::format("--width: {} is outside 0.01..50 mm", text));
    return width;
}


/// "type=value" for all types, joined by commas.
template <class Value> std::string list_types(Value&& value)
{
    std::string text;
    for (int i = 0; i < line_type_count; ++i)
        text += fmt::format("{}{}={}", i > 0 ? "," : "", line_type_name(LineType(i)), value(LineType(i)));
    return text;
}

OptionRow<Style> look_row()
{
    auto row = choice_row<Style, Look>("style", {{"plain", Look::plain}, {"coloured", Look::coloured}, {"dark", Look::dark}, {"toon", Look::toon}},
                                       "look of the drawing; sets all colours", &Style::look);
    row.set = [choose = row.set](Style& style, std::string_view text) {
        choose(style, text);
        style.set_look(style.look);
    };
    return row;
}

OptionRow<Style> width_row()
{
    return {"width", "mm", "0.01..50", "line width, for all types or as TYPE=WIDTH,...",
            [](Style& style, std::string_view text) { style.set_widths(text); },
            [](const Style& style) { return list_types([&](LineType t) { return fmt::format("{}mm", style.line(t).width_mm); }); }};
}

OptionRow<Style> colour_row()
{
    return {"colour", "", "#000000..#ffffff", "line colour, for all types or as TYPE=#RRGGBB,...; give it after --style",
            [](Style& style, std::string_view text) { style.set_colours(text); },
            [](const Style& style) { return list_types([&](LineType t) { return colour_text(style.line(t).colour); }); }};
}

OptionRow<Style> page_row()
{
    return {"page", "", "none|A5|A4|A3|A2|Letter|Legal|WxHmm", "paper the drawing is fitted to; named ones turn with the picture",
            [](Style& style, std::string_view text) { style.page = page_from_text(text); },
            [](const Style& style) { return page_text(style.page); }};
}

} // namespace

vec3 colour_from_text(std::string_view option, std::string_view text)
{
    std::uint32_t rgb = 0;
    const char* end = text.data() + text.size();
    if (text.size() != 7 || text[0] != '#' || std::from_chars(text.data() + 1, end, rgb, 16).ptr != end)
        throw Error::Input(fmt::format("--{}: '{}' is no colour; expected #RRGGBB", option, text));
    return colour_of(rgb);
}

std::string colour_text(const vec3& colour) { return fmt::format("#{:06x}", rgb_of(colour)); }

std::array<LineStyle, line_type_count> default_lines()
{
    std::array<LineStyle, line_type_count> lines;
    for (std::size_t i = 0; i < lines.size(); ++i)
        lines[i].width_mm = default_widths[i];
    return lines;
}

Page page_from_text(std::string_view text)
{
    if (text.empty() || text == "none")
        return {};
    std::string_view name = text;
    const bool portrait = remove_ending(name, "-portrait"), landscape = !portrait && remove_ending(name, "-landscape");
    for (const NamedPage& page : known_pages)
        if (same_word(name, page.name))
            return landscape ? Page{page.height, page.width, false} : Page{page.width, page.height, !portrait};
    std::string_view lengths = text;
    remove_ending(lengths, "mm");
    const std::size_t by = lengths.find('x');
    if (by == std::string_view::npos)
        refuse_page(text);
    return {page_length(text, lengths.substr(0, by)), page_length(text, lengths.substr(by + 1)), false};
}

std::string page_text(const Page& page)
{
    if (page.empty())
        return "none";
    for (const NamedPage& known : known_pages) {
        if (page.width_mm == known.width && page.height_mm == known.height)
            return fmt::format("{}{}", known.name, page.turns ? "" : "-portrait");
        if (page.width_mm == known.height && page.height_mm == known.width)
            return fmt::format("{}-landscape", known.name);
    }
    return fmt::format("{}x{}mm", page.width_mm, page.height_mm);
}

void Style::set_look(Look wanted)
{
    look = wanted;
    const Colours& colours = wanted == Look::plain ? plain_colours : wanted == Look::coloured ? type_colours : dark_colours;
    for (int i = 0; i < line_type_count; ++i)
        lines[std::size_t(i)].colour = colour_of(colours[std::size_t(i)]);
    paper = vec3(1);
    shape = wanted == Look::dark ? vec3(0.38f) : vec3(1);
}

void Style::set_widths(std::string_view text)
{
    for_each_type("width", text, [&](LineType type, std::string_view value) { line(type).width_mm = width_from_text(value); });
}

void Style::set_colours(std::string_view text)
{
    for_each_type("colour", text, [&](LineType type, std::string_view value) { line(type).colour = colour_from_text("colour", value); });
}

const OptionTable<Style>& style_option_table()
{
    static const OptionTable<Style> table = {
        look_row(),
        choice_row<Style, StrokeMode>("stroke", {{"line", StrokeMode::line}, {"outline", StrokeMode::outline}},
                                      "lines of constant width (also for plotters), or filled outlines that swell and taper", &Style::stroke),
        width_row(),
        colour_row(),
        page_row(),
        number_row<Style, double>("margin", "mm", 0, 1000, "free border of the page", &Style::margin_mm),
        number_row<Style, double>("taper", "mm", 0, 100, "length over which free ends taper with --stroke outline", &Style::taper_mm),
        switch_row<Style>("curves", "strokes as Bezier curves; no: polylines", &Style::curves),
        number_row<Style, double>("curve-tolerance", "px", 0.01, 10, "largest distance between a stroke and its curve", &Style::curve_tolerance),
        number_row<Style, double>("dash", "mm", 0, 100, "dash length of hidden lines; 0: not dashed", &Style::dash_mm),
        number_row<Style, double>("dash-gap", "mm", 0.01, 100, "gap between the dashes of hidden lines", &Style::dash_gap_mm),
    };
    return table;
}

} // namespace limn
