#include "completions.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "common.h"
#include "limn/base/file.h"
#include "subcommand.h"

using namespace limn;

namespace {

constexpr const char* examples = R"(Examples:
  limn completions bash > ~/.local/share/bash-completion/completions/limn
  limn completions zsh > "${fpath[1]}/_limn"
  limn completions fish > ~/.config/fish/completions/limn.fish)";

std::string replaced(std::string text, const std::string& what, const std::string& with)
{
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
        text.replace(at, what.size(), with);
    return text;
}

std::vector<std::string> names_of(const std::vector<CommandText>& commands)
{
    std::vector<std::string> names;
    for (const CommandText& command : commands)
        names.push_back(command.name);
    return names;
}

/// All names of a command's options.
std::vector<std::string> option_names(const CommandText& command)
{
    std::vector<std::string> names;
    for (const OptionText& option : command.options)
        if (!option.positional)
            names.insert(names.end(), option.names.begin(), option.names.end());
    return names;
}

/// The words of a command's arguments, and whether one of them is a file.
std::vector<std::string> argument_words(const CommandText& command)
{
    std::vector<std::string> words;
    for (const OptionText& option : command.options)
        if (option.positional)
            words.insert(words.end(), option.words.begin(), option.words.end());
    for (const CommandText& inner : command.subcommands)
        words.push_back(inner.name.substr(inner.name.rfind(' ') + 1));
    return words;
}

bool takes_files(const CommandText& command)
{
    return std::any_of(command.options.begin(), command.options.end(), [](const OptionText& o) { return o.positional && o.takes_file(); });
}

std::string bash_reply(const std::string& what) { return fmt::format("mapfile -t COMPREPLY < <(compgen {} -- \"$current\")", what); }

std::string bash_reply_words(const std::vector<std::string>& words) { return bash_reply(fmt::format("-W '{}'", join(words, " "))); }

/// The branch of one subcommand.
std::string bash_branch(const CommandText& command)
{
    std::string values;
    for (const OptionText& option : command.options)
        if (!option.positional && !option.value.empty()) {
            const std::string reply = !option.words.empty() ? bash_reply_words(option.words) : option.takes_file() ? bash_reply("-f") : "COMPREPLY=()";
            values += fmt::format("        {}) {}; return ;;\n", join(option.names, "|"), reply);
        }
    std::string out = fmt::format("    {})\n", command.name);
    if (!values.empty())
        out += "        case $previous in\n" + values + "        esac\n";
    out += fmt::format("        if [[ $current == -* ]]; then {}; return; fi\n", bash_reply_words(option_names(command)));
    const std::vector<std::string> words = argument_words(command);
    if (!words.empty() && takes_files(command))
        out += fmt::format("        {}\n", bash_reply(fmt::format("-f -W '{}'", join(words, " "))));
    else if (!words.empty())
        out += fmt::format("        {}\n", bash_reply_words(words));
    else if (takes_files(command))
        out += fmt::format("        {}\n", bash_reply("-f"));
    return out + "        ;;\n";
}

/// Text within single quotes of a POSIX shell.
std::string shell_quoted(const std::string& text) { return "'" + replaced(text, "'", "'\\''") + "'"; }

/// One argument of zsh's _arguments for a name of an option.
std::string zsh_option(const OptionText& option, const std::string& name)
{
    std::string help = option.help;
    for (const char* special : {"\\", "[", "]", ":"})
        help = replaced(help, special, std::string("\\") + special);
    std::string spec = "*" + name;
    if (!option.value.empty() && name.starts_with("--"))
        spec += "="; // the value may follow after a space too
    spec += "[" + help + "]";
    if (!option.value.empty())
        spec += ":" + replaced(option.value, ":", "\\:") + ":" + (!option.words.empty() ? "(" + join(option.words, " ") + ")" : option.takes_file() ? "_files" : " ");
    return shell_quoted(spec);
}

std::string zsh_branch(const CommandText& command)
{
    std::string out = fmt::format("    {})\n        _arguments", command.name);
    for (const OptionText& option : command.options)
        for (const std::string& name : option.positional ? std::vector<std::string>() : option.names)
            out += " \\\n            " + zsh_option(option, name);
    const std::vector<std::string> words = argument_words(command);
    for (const OptionText& option : command.options)
        if (option.positional)
            out += fmt::format(" \\\n            '{}:{}:{}'", option.repeated ? "*" : "1", option.names[0],
                               !option.words.empty() ? "(" + join(option.words, " ") + ")"
                               : words.empty()       ? "_files"
                                                     : "{compadd -- " + join(words, " ") + "; _files}");
    return out + "\n        ;;\n";
}

/// Text within single quotes of fish.
std::string fish_quoted(const std::string& text) { return "'" + replaced(replaced(text, "\\", "\\\\"), "'", "\\'") + "'"; }

std::string fish_option(const std::string& condition, const OptionText& option)
{
    std::string line = fmt::format("complete -c limn -n {}", fish_quoted(condition));
    for (const std::string& name : option.names)
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (!option.value.empty())
        line += option.takes_file() ? " -r -F" : " -x";
    if (!option.words.empty())
        line += " -a " + fish_quoted(join(option.words, " "));
    return line + " -d " + fish_quoted(option.help) + "\n";
}

} // namespace

std::string bash_completions(const CommandText& limn, const std::vector<CommandText>& commands)
{
    std::vector<std::string> first = names_of(commands);
    for (const std::string& name : option_names(limn))
        first.push_back(name);
    std::string branches;
    for (const CommandText& command : commands)
        branches += bash_branch(command);
    return fmt::format("# bash completion for limn\n"
                       "_limn()\n{{\n"
                       "    local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}\n"
                       "    COMPREPLY=()\n"
                       "    if [[ $COMP_CWORD -eq 1 ]]; then {}; return; fi\n"
                       "    case ${{COMP_WORDS[1]}} in\n{}    esac\n}}\n"
                       "complete -o filenames -F _limn limn\n",
                       bash_reply_words(first), branches);
}

std::string zsh_completions(const CommandText& limn, const std::vector<CommandText>& commands)
{
    std::string names, branches, own;
    for (const CommandText& command : commands) {
        names += "\n        " + shell_quoted(command.name + ":" + replaced(command.help, ":", "\\:"));
        branches += zsh_branch(command);
    }
    for (const OptionText& option : limn.options)
        for (const std::string& name : option.names)
            own += " \\\n            " + zsh_option(option, name);
    return fmt::format("#compdef limn\n"
                       "_limn()\n{{\n"
                       "    local -a commands\n"
                       "    commands=({})\n"
                       "    if (( CURRENT == 2 )); then\n"
                       "        _describe command commands\n"
                       "        _arguments{}\n"
                       "        return\n"
                       "    fi\n"
                       "    shift words\n"
                       "    (( CURRENT-- ))\n"
                       "    case $words[1] in\n{}    esac\n}}\n"
                       "_limn \"$@\"\n",
                       names, own, branches);
}

std::string fish_completions(const CommandText& limn, const std::vector<CommandText>& commands)
{
    std::string out = "# fish completion for limn\ncomplete -c limn -n __fish_use_subcommand -f\n";
    for (const OptionText& option : limn.options)
        out += fish_option("__fish_use_subcommand", option);
    for (const CommandText& command : commands) {
        out += fmt::format("complete -c limn -n __fish_use_subcommand -a {} -d {}\n", command.name, fish_quoted(command.help));
        const std::string seen = "__fish_seen_subcommand_from " + command.name;
        if (const std::vector<std::string> words = argument_words(command); !words.empty())
            out += fmt::format("complete -c limn -n {} {}-a {}\n", fish_quoted(seen), takes_files(command) ? "" : "-f ", fish_quoted(join(words, " ")));
        for (const OptionText& option : command.options)
            if (!option.positional)
                out += fish_option(seen, option);
    }
    return out;
}

Subcommand add_completions(CLI::App& limn)
{
    auto shell = std::make_shared<std::string>();
    CLI::App* app = limn.add_subcommand("completions", "Print what teaches a shell to complete the command's options");
    app->footer(examples);
    app->add_option("SHELL", *shell, "bash|zsh|fish")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}));
    return {app, [shell, &limn] {
                const CommandText own = describe(limn);
                const std::vector<CommandText> commands = describe_subcommands(limn);
                write_file("-", *shell == "bash"  ? bash_completions(own, commands)
                                : *shell == "zsh" ? zsh_completions(own, commands)
                                                  : fish_completions(own, commands));
            }};
}
