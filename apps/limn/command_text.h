#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

/// An option or an argument as its help tells of it.
struct OptionText {
    std::vector<std::string> names; ///< "-o", "--output"; one without dashes for an argument
    std::string value;              ///< what stands for its value ("FILE"); "" for a flag
    std::vector<std::string> words; ///< the values that can be named, where the help lists them ("cpu|gpu|auto")
    std::string help, group;
    bool positional = false, repeated = false;

    bool takes_file() const { return value == "FILE" || value == "FOLDER" || (positional && words.empty()); }
};

/// A command as its help tells of it: what completions and the man page are made of.
struct CommandText {
    std::string name, help, footer;
    std::vector<OptionText> options; ///< arguments among them; in their order
    std::vector<CommandText> subcommands = {}; ///< "terrain build"
};

CommandText describe(const CLI::App& app);
/// The subcommands, in their order.
std::vector<CommandText> describe_subcommands(const CLI::App& app);

/// The words of a list in a help text: the first "a|b|c", or all of "a, b, c"; upper case stands for something else and is no word.
std::vector<std::string> words_in(const std::string& help);
