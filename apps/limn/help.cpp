#include "help.h"

#include <sstream>

#include <fmt/format.h>

namespace {

constexpr std::size_t indent = 2, column = 30, width = 100;

/// The words of `text` in lines that fit right of the column; the first continues `head`.
std::string two_columns(const std::string& head, const std::string& text)
{
    std::string out = std::string(indent, ' ') + head;
    std::size_t at = out.size();
    if (at + 1 > column) {
        out += "\n";
        at = 0;
    }
    out += std::string(column - at, ' ');
    at = column;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (at > column && at + 1 + word.size() > width) {
            out += "\n" + std::string(column, ' ');
            at = column;
        } else if (at > column) {
            out += ' ';
            ++at;
        }
        out += word;
        at += word.size();
    }
    return out + "\n";
}

} // namespace

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const
{
    std::string head = is_positional ? option->get_name(true) : option->get_name(false, true);
    if (!is_positional && option->get_type_size() != 0)
        head += " " + option->get_type_name();
    return two_columns(head, option->get_description());
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const
{
    const CLI::App* parent = app->get_parent();
    std::string line = "Usage: " + (parent && name.rfind(parent->get_name(), 0) != 0 ? parent->get_name() + " " + name : name);
    for (const CLI::Option* option : app->get_options([](const CLI::Option* o) { return o->get_positional(); }))
        line += " " + option->get_name(true) + (option->get_expected_max() > 1 ? "..." : "");
    if (!app->get_subcommands([](const CLI::App*) { return true; }).empty())
        line += " COMMAND";
    return "\n" + line + " [OPTIONS]\n";
}

std::string HelpFormatter::make_subcommand(const CLI::App* app) const { return two_columns(app->get_name(), app->get_description()); }
