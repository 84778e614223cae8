#pragma once

#include <functional>

#include <CLI/CLI.hpp>

/// A part of the command line and what it does. `run` throws limn::Error.
struct Subcommand {
    CLI::App* app = nullptr;
    std::function<void()> run;
};

Subcommand add_bench(CLI::App& limn);
Subcommand add_completions(CLI::App& limn);
Subcommand add_draw(CLI::App& limn);
Subcommand add_info(CLI::App& limn);
Subcommand add_man(CLI::App& limn);
Subcommand add_render(CLI::App& limn);
Subcommand add_sample(CLI::App& limn);
Subcommand add_shadow(CLI::App& limn);
Subcommand add_subdivide(CLI::App& limn);
Subcommand add_terrain(CLI::App& limn);
Subcommand add_view(CLI::App& limn);
