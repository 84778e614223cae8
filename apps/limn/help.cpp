#include "help.h"

#include <vector>

#include <fmt/format.h>

namespace {

constexpr std::size_t indent = 2, column = 30, width = 100;

/// Where a line may break: words with the space before them, lists such as "a|b,c" after their separators.
std::vector<std::string> pieces(const std::string& text)
{
    std::vector<std::string> out(1);
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == ' ' || (i > 0 && (text[i - 1] == '|' || text[i - 1] == ',') && text[i] != ' '))
            out.emplace_back();
        out.back() += text[i];
    }
    return out;
}

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
    for (const std::string& piece : pieces(text)) {
        const bool new_word = piece[0] == ' ';
        const std::string word = new_word ? piece.substr(1) : piece;
        if (at > column && at + piece.size() > width) {
            out += "\n" + std::string(column, ' ');
            at = column;
        } else if (new_word) {
            out += ' ';
            ++at;
        }
        out += word;
        at += word.size();
    }
    return out + "\n";
}

} // namespace

std::string full_name(const CLI::App& app) { return app.get_parent() ? full_name(*app.get_parent()) + " " + app.get_name() : app.get_name(); }

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const
{
    std::string head = is_positional ? option->get_name(true) : option->get_name(false, true);
    head = head.substr(0, head.find('{')); // CLI11 shows what a bare flag means
    if (const std::string type = option->get_type_name(); !is_positional && option->get_type_size() != 0)
        head += " " + type.substr(0, type.find(':')); // and what its checks want, which the text says better
    return two_columns(head, option->get_description());
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string) const
{
    std::string line = "Usage: " + full_name(*app);
    for (const CLI::Option* option : app->get_options([](const CLI::Option* o) { return o->get_positional(); }))
        line += " " + option->get_name(true) + (option->get_expected_max() > 1 ? "..." : "");
    if (!app->get_parent())
        line += " COMMAND";
    return "\n" + line + " [OPTIONS]\n";
}

std::string HelpFormatter::make_subcommand(const CLI::App* app) const { return two_columns(app->get_name(), app->get_description()); }
