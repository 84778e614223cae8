#include "limn/scene/options_json.h"

namespace limn {
namespace {

/// A bare number or word.
std::optional<std::string> scalar_text(const Json& value)
{
    if (value.is_string())
        return value.get<std::string>();
    if (value.is_number_integer())
        return value.dump();
    if (value.is_number())
        return fmt::format("{}", value.get<double>());
    return std::nullopt;
}

std::optional<std::string> list_text(const Json& value)
{
    std::string all;
    for (const auto& [key, entry] : value.items()) {
        const std::optional<std::string> text = scalar_text(entry);
        if (!text)
            return std::nullopt;
        all += (all.empty() ? "" : ",") + (value.is_object() ? key + "=" : "") + *text;
    }
    return all;
}

Json number_json(const std::string& text)
{
    constexpr double exact = 9e15; ///< whole numbers below it are doubles
    const double value = parse_number("", text);
    return std::abs(value) < exact && std::floor(value) == value ? Json(std::int64_t(value)) : Json(value);
}

} // namespace

std::optional<std::string> option_text(OptionKind kind, const Json& value)
{
    switch (kind) {
    case OptionKind::number:
    case OptionKind::whole: return value.is_number() ? scalar_text(value) : std::nullopt;
    case OptionKind::yes_no: return value.is_boolean() ? std::optional<std::string>(value.get<bool>() ? "yes" : "no") : std::nullopt;
    case OptionKind::yes_no_number: return option_text(value.is_boolean() ? OptionKind::yes_no : OptionKind::number, value);
    case OptionKind::colour: return value.is_string() ? scalar_text(value) : std::nullopt;
    case OptionKind::choice: return scalar_text(value);
    default: return value.is_structured() ? list_text(value) : scalar_text(value);
    }
}

Json option_json(OptionKind kind, const std::string& text)
{
    switch (kind) {
    case OptionKind::number:
    case OptionKind::whole: return number_json(text);
    case OptionKind::yes_no: return text == "yes";
    case OptionKind::yes_no_number: return option_json(text == "yes" || text == "no" ? OptionKind::yes_no : OptionKind::number, text);
    default: return text;
    }
}

std::string option_wish(OptionKind kind, std::string_view range, std::string_view unit)
{
    const std::string of_unit = unit.empty() ? "" : fmt::format(" {}", unit);
    switch (kind) {
    case OptionKind::number: return fmt::format("a number in {}{}", range, of_unit);
    case OptionKind::whole: return fmt::format("a whole number in {}{}", range, of_unit);
    case OptionKind::yes_no: return "true or false";
    case OptionKind::yes_no_number: return fmt::format("true, false or a number in {}{}", range.substr(range.rfind('|') + 1), of_unit);
    case OptionKind::colour: return fmt::format("\"{}\"", range);
    default: return fmt::format("{}{}{}", range.find('|') == range.npos ? "" : "one of ", range, of_unit);
    }
}

} // namespace limn
