#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

/// What every subcommand takes.
struct CommonOptions {
    std::vector<std::string> outputs; ///< -o, as often as given
    std::string to;                   ///< format of the outputs, whatever their ending
    int threads = 0;                  ///< 0: all of the machine
    std::string device = "auto";
    bool quiet = false, json = false, strict = false;
};

/// -o, --to, --threads, --device, --json, --strict, --quiet.
void add_common_options(CLI::App& app, CommonOptions& options, const std::string& output_help);

/// @throws limn::Error::Device where --device asks for what a command that computes on the CPU alone has not.
void check_cpu_only(const CommonOptions& options, std::string_view command);

/// A file to write and the format to write it in.
struct Output {
    std::string path; ///< "-": standard output
    std::string format;
};

/// The outputs with their formats.
/// @param known  the formats this subcommand can write
/// @throws limn::Error::Input for a format that is missing or unknown, for standard output twice, and for --json with it.
std::vector<Output> checked_outputs(const CommonOptions& options, const std::vector<std::string>& known);

/// "wrote a.svg, a.png": what the last line of a run starts with.
std::string what_was_written(std::vector<std::string> paths);

/// "a|b|c".
std::string join(const std::vector<std::string>& words, std::string_view between);

/// Warnings of one run. Said as one line, or thrown where --strict asks for it.
class Warnings {
public:
    void add(std::string_view file, const std::vector<std::string>& notes);
    bool empty() const { return all_.empty(); }
    const std::vector<std::string>& all() const { return all_; }
    std::string line() const { return join(all_, "; "); }

private:
    std::vector<std::string> all_;
};
