#include <cstdio>
#include <new>
#include <vector>

#include <fmt/format.h>

#include "help.h"
#include "limn/base/error.h"
#include "limn/base/nearest.h"
#include "subcommand.h"

namespace {

constexpr int success = 0, failure = 1, usage = 2;

constexpr const char* introduction = "Limn draws the shape of 3D things: line drawings of meshes, with hidden lines removed, shaded pictures, terrain, and shadows.\n"
                                     "'limn COMMAND --help' explains a command, with examples.";

int complain(const std::string& who, const std::string& what, int code)
{
    fmt::print(stderr, "{}: {}\n", who, what);
    return code;
}

std::vector<std::string> option_names(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

std::vector<std::string> subcommand_names(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(subcommand->get_name());
    return names;
}

/// The app whose options are being parsed: the chosen subcommand, or one of its own, or the command itself.
const CLI::App& chosen(const CLI::App& app)
{
    const std::vector<CLI::App*> parsed = app.get_subcommands();
    return parsed.empty() ? app : chosen(*parsed.front());
}

/// "unknown option '--sise'; did you mean '--size'?"
std::string unknown_argument(const CLI::App& app, const std::string& argument)
{
    const std::string word = argument.substr(0, argument.find('='));
    const bool is_option = word.size() > 1 && word[0] == '-';
    const std::string guess = limn::nearest(word, is_option ? option_names(app) : subcommand_names(app));
    const std::string kind = is_option ? "option" : app.get_parent() ? "argument" : "command";
    return fmt::format("unknown {} '{}'; ", kind, word) +
           (guess.empty() ? fmt::format("see '{} --help'", full_name(app)) : fmt::format("did you mean '{}'?", guess));
}

int explain_usage_error(const CLI::App& app, const CLI::ParseError& error)
{
    const CLI::App& at = chosen(app);
    const std::vector<std::string> rest = app.remaining(true);
    if (dynamic_cast<const CLI::ExtrasError*>(&error) && !rest.empty())
        return complain(full_name(at), unknown_argument(at, rest.front()), usage);
    return complain(full_name(at), fmt::format("{}; see '{} --help'", error.what(), full_name(at)), usage);
}

int run(CLI::App& app, const std::vector<Subcommand>& subcommands, int argc, char** argv)
{
    try {
        app.parse(argc, argv);
        for (const Subcommand& subcommand : subcommands)
            if (subcommand.app->parsed()) {
                subcommand.run();
                return success;
            }
        fmt::print("{}", app.help());
        return success;
    } catch (const CLI::Success& asked) { // --help, --version
        return app.exit(asked);
    } catch (const CLI::ParseError& error) {
        return explain_usage_error(app, error);
    } catch (const limn::Error::Input& error) {
        return complain(full_name(chosen(app)), error.what(), usage);
    } catch (const limn::Error& error) {
        return complain("limn", error.what(), failure);
    } catch (const std::bad_alloc&) {
        return complain("limn", "not enough memory", failure);
    } catch (const std::exception& error) {
        return complain("limn", error.what(), failure);
    }
}

} // namespace

/// `limn`: the command. Exit codes: 0 a result, 1 something cannot be read or written, 2 the command line is wrong.
int main(int argc, char** argv)
{
    CLI::App app(introduction, "limn");
    app.set_version_flag("--version", "limn " LIMN_VERSION);
    app.formatter(std::make_shared<HelpFormatter>());
    app.require_subcommand(0, 1);
    const std::vector<Subcommand> subcommands = {add_bench(app), add_completions(app), add_draw(app),
                                                 add_info(app), add_man(app), add_render(app), add_sample(app), add_shadow(app), add_subdivide(app), add_terrain(app), add_view(app)};
    return run(app, subcommands, argc, argv);
}
