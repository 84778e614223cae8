#pragma once

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "limn/base/options.h"

/// What stands behind an option's help: "0..180 degrees; default 40".
template <class Options> std::string describe_range(const limn::OptionRow<Options>& row, const Options& usual)
{
    const std::string unit = row.unit.empty() ? "" : " " + row.unit;
    const std::string value = row.get(usual);
    const bool tells = value.size() <= 30; // a list of all types does not
    return row.range + unit + (tells ? "; default " + value : "");
}

/// Adds one row. A yes-or-no row becomes a flag: "--curves" is yes, "--curves=no" is no, "--ao=0.5" the number that some take.
template <class Options> void add_table_row(CLI::App& app, const limn::OptionRow<Options>& row, Options& options, const std::string& group)
{
    const std::string help = row.help + " (" + describe_range(row, options) + ")";
    auto set = [&options, &row](const std::string& text) { row.set(options, text); };
    if (row.range.starts_with("yes|no")) {
        auto value = std::make_shared<std::string>();
        app.add_flag("--" + row.name + "{yes}", *value, help)->each([value, set](const std::string& text) { set(text); })->group(group);
    } else {
        app.add_option_function<std::string>("--" + row.name, set, help)->type_name("X")->group(group);
    }
}

/// Adds every row of an option table to a subcommand; `options` must outlive the parsing.
template <class Options>
void add_table_options(CLI::App& app, const limn::OptionTable<Options>& table, Options& options, const std::string& group)
{
    for (const limn::OptionRow<Options>& row : table)
        add_table_row(app, row, options, group);
}
