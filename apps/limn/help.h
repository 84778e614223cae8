#pragma once

#include <string>

#include <CLI/CLI.hpp>

/// "limn terrain build".
std::string full_name(const CLI::App& app);

/// Help texts: one column of options, one of wrapped explanations, 100 columns in all.
class HelpFormatter : public CLI::Formatter {
public:
    std::string make_option(const CLI::Option* option, bool is_positional) const override;
    std::string make_usage(const CLI::App* app, std::string name) const override;
    std::string make_subcommand(const CLI::App* app) const override;
};
