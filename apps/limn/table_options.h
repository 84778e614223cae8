#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "limn/base/options.h"

/// What stands behind an option's help: "0..180 degrees, default 40".
template <class Options> std::string describe_range(const limn::OptionRow<Options>& row)
{
    const std::string unit = row.unit.empty() ? "" : " " + row.unit;
    return row.range + unit + "; default " + row.get(Options());
}

/// Adds every row of an option table to a subcommand; `options` must outlive the parsing.
template <class Options>
void add_table_options(CLI::App& app, const limn::OptionTable<Options>& table, Options& options, const std::string& group)
{
    for (const limn::OptionRow<Options>& row : table)
        app.add_option_function<std::string>(
               "--" + row.name, [&options, &row](const std::string& text) { row.set(options, text); },
               row.help + " (" + describe_range(row) + ")")
            ->type_name("X")
            ->group(group);
}
