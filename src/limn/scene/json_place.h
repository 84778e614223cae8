#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "limn/base/vec.h"

namespace limn {

using Json = nlohmann::ordered_json;

/// A value of a JSON file and the way to it. Whatever it does not hold is refused with one line that names the file, the way, what
/// was expected and what was found: "scene.json: objects[1].material.colour: expected "#rrggbb", found 3".
class JsonPlace {
public:
    /// @param file  stands in messages. `value` must outlive the place and all that are made from it.
    JsonPlace(const Json& value, std::string file, std::string way = "") : value_(value), file_(std::move(file)), way_(std::move(way)) {}

    const Json& value() const { return value_; }
    const std::string& way() const { return way_; }

    /// The value of a key, which must be there, and of an entry of a list.
    JsonPlace at(const std::string& key) const;
    JsonPlace at(std::size_t index) const;
    bool has(std::string_view key) const { return value_.is_object() && value_.contains(key); }

    /// @throws Error::Read naming the first key that is none of these and the nearest one that is, or saying that this is no object.
    void check_keys(const std::vector<std::string>& known) const;
    /// @throws Error::Read naming a key that is missing.
    void need(std::initializer_list<const char*> keys) const;
    /// The entries of a list. @throws Error::Read
    std::vector<JsonPlace> entries() const;

    // All throw Error::Read.
    double number(double low, double high) const;
    bool yes_no() const;
    std::string text() const;
    dvec3 vector() const; ///< three finite numbers
    std::vector<double> numbers(std::size_t count) const;

    [[noreturn]] void expected(std::string_view what) const;
    /// "FILE: WAY: WHAT".
    [[noreturn]] void refuse(std::string_view what) const;

private:
    const Json& value_;
    std::string file_, way_;
};

/// A text in quotation marks, without line breaks and not too long for a message.
std::string quoted(const std::string& text);

/// "; did you mean 'colour'?", or "" where no word is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

/// Parses a JSON file. @throws Error::Read naming the file, and the line and byte where it is broken or the key that stands twice in one
/// object.
Json parse_json(std::string_view text, const std::string& file);

} // namespace limn
