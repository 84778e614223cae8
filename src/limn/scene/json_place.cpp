#include "limn/scene/json_place.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/nearest.h"

namespace limn {
namespace {

constexpr std::size_t longest_shown = 80; ///< bytes
constexpr std::size_t deepest = 64; ///< levels of nesting; a scene has five

/// What was found, short enough for one line.
std::string shown(const Json& value)
{
    if (value.is_object())
        return "an object";
    if (value.is_array())
        return value.size() == 1 ? "a list of 1" : fmt::format("a list of {}", value.size());
    const std::string text = value.dump();
    std::size_t end = longest_shown;
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) // not within a character
        --end;
    return text.size() <= longest_shown ? text : text.substr(0, end) + "...";
}

/// A key as it stands in a way: quoted where it is no plain word, so that it keeps to one line.
std::string shown_key(const std::string& key)
{
    const auto is_plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'; };
    return !key.empty() && key.size() <= longest_shown && std::all_of(key.begin(), key.end(), is_plain) ? key : shown(Json(key));
}

bool is_finite_number(const Json& value) { return value.is_number() && std::isfinite(value.get<double>()); }

/// Refuses what a person cannot have meant: one key twice in an object, and nesting without end.
class StructureCheck {
public:
    explicit StructureCheck(const std::string& file) : file_(file) {}

    bool operator()(int depth, Json::parse_event_t event, const Json& parsed)
    {
        if (std::size_t(depth) > deepest)
            throw Error::Read(fmt::format("{}: more than {} levels of brackets", file_, deepest));
        if (event == Json::parse_event_t::object_start)
            keys_.emplace_back();
        else if (event == Json::parse_event_t::object_end)
            keys_.pop_back();
        else if (event == Json::parse_event_t::key && !keys_.back().insert(parsed.get<std::string>()).second)
            throw Error::Read(fmt::format("{}: the key {} stands twice in one object", file_, shown(parsed)));
        return true;
    }

private:
    std::string file_;
    std::vector<std::set<std::string>> keys_; ///< of the objects around
};

} // namespace

JsonPlace JsonPlace::at(const std::string& key) const { return {value_[key], file_, (way_.empty() ? "" : way_ + ".") + shown_key(key)}; }
JsonPlace JsonPlace::at(std::size_t index) const { return {value_[index], file_, fmt::format("{}[{}]", way_, index)}; }

void JsonPlace::check_keys(const std::vector<std::string>& known) const
{
    if (!value_.is_object())
        expected("an object");
    for (const auto& [key, value] : value_.items())
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            const std::string guess = did_you_mean(key, known);
            at(key).refuse("unknown key" + (guess.empty() ? fmt::format("; known: {}", fmt::join(known, ", ")) : guess));
        }
}

void JsonPlace::need(std::initializer_list<const char*> keys) const
{
    for (const char* key : keys)
        if (!has(key))
            refuse(fmt::format("the key '{}' is missing", key));
}

std::vector<JsonPlace> JsonPlace::entries() const
{
    if (!value_.is_array())
        expected("a list");
    std::vector<JsonPlace> all;
    for (std::size_t i = 0; i < value_.size(); ++i)
        all.push_back(at(i));
    return all;
}

double JsonPlace::number(double low, double high) const
{
    if (!is_finite_number(value_) || value_.get<double>() < low || value_.get<double>() > high)
        expected(fmt::format("a number in {}..{}", low, high));
    return value_.get<double>();
}

bool JsonPlace::yes_no() const
{
    if (!value_.is_boolean())
        expected("true or false");
    return value_.get<bool>();
}

std::string JsonPlace::text() const
{
    if (!value_.is_string())
        expected("a text");
    return value_.get<std::string>();
}

dvec3 JsonPlace::vector() const
{
    if (!value_.is_array() || value_.size() != 3 || !std::all_of(value_.begin(), value_.end(), is_finite_number))
        expected("[x, y, z]");
    return {value_[0].get<double>(), value_[1].get<double>(), value_[2].get<double>()};
}

std::vector<double> JsonPlace::numbers(std::size_t count) const
{
    if (!value_.is_array() || value_.size() != count || !std::all_of(value_.begin(), value_.end(), is_finite_number))
        expected(fmt::format("a list of {} numbers", count));
    return value_.get<std::vector<double>>();
}

void JsonPlace::expected(std::string_view what) const { refuse(fmt::format("expected {}, found {}", what, shown(value_))); }

void JsonPlace::refuse(std::string_view what) const
{
    throw Error::Read(way_.empty() ? fmt::format("{}: {}", file_, what) : fmt::format("{}: {}: {}", file_, way_, what));
}

std::string quoted(const std::string& text) { return shown(Json(text)); }

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known)
{
    const std::string guess = nearest(word, known);
    return guess.empty() ? "" : fmt::format("; did you mean '{}'?", guess);
}

Json parse_json(std::string_view text, const std::string& file)
{
    try {
        return Json::parse(text, StructureCheck(file));
    } catch (const Json::parse_error& error) {
        const auto at = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
        const auto line = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n');
        throw Error::Read(fmt::format("{}: line {}: no valid JSON at byte {}", file, line, at));
    } catch (const Json::out_of_range&) {
        throw Error::Read(fmt::format("{}: a number is too large to be read", file));
    }
}

} // namespace limn
