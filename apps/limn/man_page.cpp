#include "man_page.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "common.h"
#include "limn/base/file.h"
#include "subcommand.h"

using namespace limn;

namespace {

constexpr const char* examples = R"(Examples:
  limn man | man -l -
  limn man > /usr/local/share/man/man1/limn.1)";

/// A line of text that troff takes for nothing else.
std::string plain(const std::string& text)
{
    std::string out;
    for (const char c : text)
        out += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
    return !out.empty() && (out[0] == '.' || out[0] == '\'') ? "\\&" + out : out;
}

std::string plain_lines(const std::string& text)
{
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        out += plain(text.substr(at, end - at)) + "\n";
        at = end + 1;
    }
    return out;
}

std::string upper(std::string text)
{
    for (char& c : text)
        c = char(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

std::string option_entry(const OptionText& option)
{
    std::string head;
    for (const std::string& name : option.names)
        head += (head.empty() ? "" : ", ") + ("\\fB" + plain(name) + "\\fR");
    if (!option.value.empty())
        head += " \\fI" + plain(option.value) + "\\fR";
    return fmt::format(".TP\n{}\n{}\n", head, plain(option.help));
}

std::string synopsis(const CommandText& command)
{
    std::string line = "\\fBlimn " + plain(command.name) + "\\fR";
    for (const OptionText& option : command.options)
        if (option.positional)
            line += " \\fI" + option.names[0] + "\\fR" + (option.repeated ? "..." : "");
    return line + " [options]\n";
}

std::string command_section(const CommandText& command)
{
    std::string out = fmt::format(".SH LIMN {}\n{}{}.\n", upper(command.name), synopsis(command) + ".PP\n", plain(command.help));
    std::string group;
    for (const OptionText& option : command.options) {
        if (option.group != group && option.group != "Options" && option.group != "Positionals")
            out += fmt::format(".SS {}\n", plain(option.group));
        group = option.group;
        out += option_entry(option);
    }
    if (!command.footer.empty())
        out += ".PP\n.nf\n" + plain_lines(command.footer) + ".fi\n";
    for (const CommandText& inner : command.subcommands)
        out += command_section(inner);
    return out;
}

} // namespace

std::string man_page(const CommandText& limn, const std::vector<CommandText>& commands)
{
    std::string out = fmt::format(".TH LIMN 1 \"\" \"limn {}\" \"User Commands\"\n.ad l\n", LIMN_VERSION);
    out += ".SH NAME\nlimn \\- draws the shape of 3D things\n.SH SYNOPSIS\n";
    for (const CommandText& command : commands) {
        out += synopsis(command) + ".br\n";
        for (const CommandText& inner : command.subcommands)
            out += synopsis(inner) + ".br\n";
    }
    out += ".SH DESCRIPTION\n" + plain_lines(limn.help) + ".SH OPTIONS\n";
    for (const OptionText& option : limn.options)
        out += option_entry(option);
    for (const CommandText& command : commands)
        out += command_section(command);
    return out + ".SH EXIT STATUS\n.TP\n0\na result, perhaps with a warning\n.TP\n1\nsomething cannot be read or written\n"
                 ".TP\n2\nthe command line is wrong\n";
}

Subcommand add_man(CLI::App& limn)
{
    CLI::App* app = limn.add_subcommand("man", "Print the man page");
    app->footer(examples);
    return {app, [&limn] { write_file("-", man_page(describe(limn), describe_subcommands(limn))); }};
}
