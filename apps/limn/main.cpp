#include <cstdio>

#include <CLI/CLI.hpp>

/// `limn`: the command. Exit codes: 0 a result, 1 something cannot be read or written, 2 the command line is wrong.
int main(int argc, char** argv)
{
    CLI::App app("Limn draws the shape of 3D things.", "limn");
    app.set_version_flag("--version", "limn " LIMN_VERSION);
    app.require_subcommand(0, 1);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : 2;
    }
    std::puts(app.help().c_str());
    return 0;
}
