#include "limn/lines/options.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace limn {
namespace {

struct Preset {
    std::string_view name;
    std::vector<LineType> lines;
};

/// Each in the order of LineType.
const std::vector<Preset>& presets()
{
    using enum LineType;
    static const std::vector<Preset> table = {
        {"illustration", {suggestive, crease, border, contour}},
        {"technical", {crease, border, contour}},
        {"all", {highlight, valley, ridge, apparent, suggestive, crease, border, contour, outline}},
    };
    return table;
}

std::vector<LineType> lines_of_word(std::string_view word)
{
    for (const Preset& preset : presets())
        if (preset.name == word)
            return preset.lines;
    const LineType type = line_type_from_name(word);
    if (type == LineType::iso || type == LineType::iso_heavy)
        throw Error::Input("--lines: iso lines are of heights; 'limn terrain --iso STEP' draws them");
    return {type};
}

/// In the order of LineType, each once.
std::vector<LineType> in_order(std::vector<LineType> lines)
{
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    return lines;
}

/// "contour,suggestive", "technical,outline": types and presets.
void set_lines(LineOptions& options, std::string_view text)
{
    std::vector<LineType> lines;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::vector<LineType> more = lines_of_word(text.substr(begin, end - begin));
        lines.insert(lines.end(), more.begin(), more.end());
        begin = end + 1;
    }
    options.lines = in_order(lines);
}

std::string get_lines(const LineOptions& options)
{
    const std::vector<LineType> lines = in_order(options.lines);
    for (const Preset& preset : presets())
        if (preset.lines == lines)
            return std::string(preset.name);
    std::string text;
    for (const LineType type : lines)
        text += fmt::format("{}{}", text.empty() ? "" : ",", line_type_name(type));
    return text;
}

std::string lines_range()
{
    std::string range;
    for (const Preset& preset : presets())
        range += fmt::format("{}|", preset.name);
    for (int t = line_type_count - 1; t >= int(LineType::highlight); --t)
        range += fmt::format("{}{}", line_type_name(LineType(t)), t > int(LineType::highlight) ? "," : "");
    return range;
}

OptionRow<LineOptions> lines_row()
{
    return {"lines", "", lines_range(), "a preset or the types of line, joined by commas", set_lines, get_lines};
}

struct FeatureSizeWord {
    std::string_view word;
    FeatureSizeMode mode;
};
constexpr FeatureSizeWord feature_size_words[] = {{"bsphere", FeatureSizeMode::bsphere},
                                                  {"edge-median", FeatureSizeMode::edge_median},
                                                  {"curvature", FeatureSizeMode::curvature}};

void set_feature_size(LineOptions& options, std::string_view text)
{
    for (const auto& [word, mode] : feature_size_words)
        if (word == text) {
            options.feature_size = {mode, 0};
            return;
        }
    double length = 0;
    try {
        length = parse_number("feature-size", text);
    } catch (const Error::Input&) { // a mistyped word: the sentence below says more
    }
    if (!(length > 0))
        throw Error::Input(fmt::format("--feature-size: '{}' is none of bsphere|edge-median|curvature|a length above 0", text));
    options.feature_size = {FeatureSizeMode::length, length};
}

std::string get_feature_size(const LineOptions& options)
{
    for (const auto& [word, mode] : feature_size_words)
        if (mode == options.feature_size.mode)
            return std::string(word);
    return fmt::format("{}", options.feature_size.length);
}

OptionRow<LineOptions> feature_size_row()
{
    return {"feature-size", "model units", "bsphere|edge-median|curvature|LENGTH",
            "length that frees the limits from the model's scale", set_feature_size, get_feature_size};
}

OptionTable<LineOptions> make_table()
{
    using O = LineOptions;
    constexpr double huge = std::numeric_limits<double>::infinity();
    return {
        lines_row(),
        choice_row<O, Hidden>("hidden", {{"remove", Hidden::remove}, {"dash", Hidden::dash}, {"keep", Hidden::keep}},
                              "what becomes of hidden lines", &O::hidden),
        choice_row<O, ExtractMethod>("method", {{"exact", ExtractMethod::exact}, {"stochastic", ExtractMethod::stochastic}},
                                     "look at every face, or follow lines from random ones", &O::method),
        number_row("suggestive-limit", "", 0, huge, "weakest suggestive contour drawn; 0 keeps all", &O::suggestive_limit),
        number_row("highlight-limit", "", 0, huge, "weakest suggestive highlight drawn; 0 keeps all", &O::highlight_limit),
        number_row("ridge-limit", "", 0, huge, "weakest ridge and valley drawn", &O::ridge_limit),
        number_row("apparent-limit", "", 0, huge, "weakest apparent ridge drawn", &O::apparent_limit),
        number_row("fade", "limits", 0, huge, "full ink from so many limits above a limit; 0 does not fade", &O::fade),
        number_row("speed-limit", "", 0, huge, "drop suggestive lines that slide faster than this; 0 keeps all", &O::speed_limit),
        number_row("crease-angle", "degrees", 0, 180, "bend of an edge from which it is a crease", &O::crease_angle),
        feature_size_row(),
        number_row("min-length", "px", 0, huge, "drop lines with less ink than this length of full line; contours, borders and creases stay", &O::min_length),
        number_row("tolerance", "px", 0, huge, "how far simplified strokes may stray", &O::tolerance),
        number_row("sample-fraction", "", 0, 1, "stochastic: part of the candidate faces looked at", &O::sample_fraction),
        number_row("discovery", "", 0, 1, "stochastic: part of the seeds traded for random faces", &O::discovery),
        number_row("seed", "", 0, 4294967295.0, "stochastic: start of the random numbers", &O::seed),
    };
}

/// Contours need curvature for their visibility: it says on which side of a cusp they are hidden.
Need need_of(LineType type)
{
    switch (type) {
    case LineType::suggestive:
    case LineType::highlight:
    case LineType::ridge:
    case LineType::valley:
    case LineType::apparent:
        return Need::derivative;
    case LineType::contour:
    case LineType::outline:
        return Need::curvature;
    default:
        return Need::normals;
    }
}

} // namespace

bool LineOptions::has(LineType type) const
{
    return std::find(lines.begin(), lines.end(), type) != lines.end();
}

Need surface_need(const LineOptions& options)
{
    Need need = Need::normals;
    for (const LineType type : options.lines)
        need = std::max(need, need_of(type));
    return need;
}

const OptionTable<LineOptions>& line_option_table()
{
    static const OptionTable<LineOptions> table = make_table();
    return table;
}

} // namespace limn
