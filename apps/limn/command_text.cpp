#include "command_text.h"

#include <regex>

namespace {

std::vector<std::string> split(const std::string& text, const std::string& between)
{
    std::vector<std::string> parts;
    std::size_t at = 0;
    for (std::size_t end; (end = text.find(between, at)) != std::string::npos; at = end + between.size())
        parts.push_back(text.substr(at, end - at));
    parts.push_back(text.substr(at));
    return parts;
}

OptionText describe_option(const CLI::Option& option)
{
    OptionText text;
    text.positional = option.get_positional();
    if (text.positional)
        text.names.push_back(option.get_name(true));
    for (const std::string& name : option.get_snames())
        text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        text.names.push_back("--" + name);
    text.help = option.get_description();
    text.group = option.get_group();
    text.repeated = option.get_expected_max() > 1;
    const std::string type = option.get_type_name();
    if (!text.positional && option.get_type_size() != 0)
        text.value = type.substr(0, type.find(':')); // CLI11 appends what its checks want
    if (text.positional || !text.value.empty())
        text.words = words_in(text.help);
    return text;
}

} // namespace

std::vector<std::string> words_in(const std::string& help)
{
    static const std::regex choice("[A-Za-z0-9_,.:-]+(\\|[A-Za-z0-9_,.:-]+)+"), list("[a-z-]+(, [a-z-]+)*"), word("[a-z][a-z0-9-]*");
    std::smatch found;
    std::vector<std::string> words;
    if (std::regex_match(help, list))
        words = split(help, ", ");
    else if (std::regex_search(help, found, choice))
        words = split(found.str(), "|");
    std::erase_if(words, [](const std::string& w) { return !std::regex_match(w, word); });
    return words;
}

CommandText describe(const CLI::App& app)
{
    CommandText text = {app.get_name(), app.get_description(), app.get_footer(), {}, {}};
    for (const CLI::Option* option : app.get_options())
        if (!option->get_group().empty()) // those of no group are hidden
            text.options.push_back(describe_option(*option));
    for (const CLI::App* inner : app.get_parent() ? app.get_subcommands([](const CLI::App*) { return true; }) : std::vector<const CLI::App*>()) {
        text.subcommands.push_back(describe(*inner));
        text.subcommands.back().name = app.get_name() + " " + inner->get_name();
    }
    return text;
}

std::vector<CommandText> describe_subcommands(const CLI::App& app)
{
    std::vector<CommandText> commands;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        commands.push_back(describe(*command));
    return commands;
}
