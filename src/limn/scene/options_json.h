#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limn/base/options.h"
#include "limn/scene/json_place.h"

namespace limn {

/// What a JSON value is as an option's text: 3 is "3", true is "yes", [1, 2] is "1,2", {"contour": 0.5} is "contour=0.5". Nothing where
/// a value of that kind is not written so.
std::optional<std::string> option_text(OptionKind kind, const Json& value);
/// An option's text as the JSON value that option_text makes it from.
Json option_json(OptionKind kind, const std::string& text);
/// "a number in 0..1", "one of smooth|flat|toon", "\"#rrggbb\"": what a person should have written.
std::string option_wish(OptionKind kind, std::string_view range, std::string_view unit);

template <class Options> std::vector<std::string> option_names(const OptionTable<Options>& table)
{
    std::vector<std::string> names;
    for (const OptionRow<Options>& row : table)
        names.push_back(row.name);
    return names;
}

/// Sets the options that an object names, in the table's order. @throws Error::Read naming the place of an unknown key or a bad value.
template <class Options> void read_options(const JsonPlace& place, const OptionTable<Options>& table, Options& options)
{
    place.check_keys(option_names(table));
    for (const OptionRow<Options>& row : table) {
        if (!place.has(row.name))
            continue;
        const JsonPlace at = place.at(row.name);
        const std::optional<std::string> text = option_text(row.kind, at.value());
        try {
            if (text)
                row.set(options, *text);
        } catch (const Error::Input&) { // its sentence speaks of the command line
            at.expected(option_wish(row.kind, row.range, row.unit));
        }
        if (!text)
            at.expected(option_wish(row.kind, row.range, row.unit));
    }
}

/// The options that differ from `usual`, as an object that read_options takes.
template <class Options> Json options_json(const OptionTable<Options>& table, const Options& options, const Options& usual)
{
    Json json = Json::object();
    for (const OptionRow<Options>& row : table)
        if (const std::string text = row.get(options); text != row.get(usual))
            json[row.name] = option_json(row.kind, text);
    return json;
}

} // namespace limn
