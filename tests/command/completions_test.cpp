#include <regex>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "command/command.h"
#include "command_text.h"

namespace limn::test {
namespace {

const std::vector<std::string> subcommands = {"bench", "completions", "draw", "info", "man", "sample", "shadow", "subdivide", "terrain", "view"};

/// The long options that a help text lists.
std::set<std::string> options_in_help(const std::string& command)
{
    const std::string help = limn(command + " --help").output;
    static const std::regex option("(^|\n)  (-[a-z],)?(--[a-z-]+)");
    std::set<std::string> options;
    for (std::sregex_iterator at(help.begin(), help.end(), option), end; at != end; ++at)
        options.insert((*at)[3]);
    return options;
}

bool has_tool(const std::string& name) { return run_shell("command -v " + name).exit_code == 0; }

/// The part of a text from one mark to the next.
std::string between(const std::string& text, const std::string& from, const std::string& to)
{
    const std::size_t begin = text.find(from), end = text.find(to, begin + from.size());
    return begin == std::string::npos ? "" : text.substr(begin, end - begin);
}

TEST(CommandText, FindsTheWordsThatAnOptionCanBe)
{
    using Words = std::vector<std::string>;
    EXPECT_EQ(words_in("what becomes of hidden lines (remove|dash|keep; default remove)"), (Words{"remove", "dash", "keep"}));
    EXPECT_EQ(words_in("front|top or AZ,EL in degrees (default iso = 45,35.264)"), (Words{"front", "top"}));
    EXPECT_EQ(words_in("torus, bumpy-torus, sphere"), (Words{"torus", "bumpy-torus", "sphere"}));
    EXPECT_EQ(words_in("rings of neighbours (auto|2..6)"), (Words{"auto"}));
    EXPECT_EQ(words_in("files to draw together, in any mesh format; '-' is standard input"), Words{});
}

TEST(Completions, OfEveryShellHoldEveryOptionOfEverySubcommand)
{
    const std::string bash = limn("completions bash").output, zsh = limn("completions zsh").output, fish = limn("completions fish").output;
    for (const std::string& command : subcommands) {
        const std::set<std::string> options = options_in_help(command);
        EXPECT_FALSE(options.empty()) << command;
        const std::string in_bash = between(bash, "\n    " + command + ")\n", "\n        ;;"), in_zsh = between(zsh, "\n    " + command + ")\n", "\n        ;;");
        for (const std::string& option : options) {
            EXPECT_TRUE(std::regex_search(in_bash, std::regex("[ ']" + option + "[ ']"))) << command << " " << option;
            EXPECT_TRUE(std::regex_search(in_zsh, std::regex("'\\*" + option + "=?\\["))) << command << " " << option;
            EXPECT_TRUE(std::regex_search(fish, std::regex("from " + command + "'.* -l " + option.substr(2) + " "))) << command << " " << option;
        }
    }
    EXPECT_GT(options_in_help("draw").size(), 50u);
}

TEST(Completions, AreScriptsOfTheirShells)
{
    const TemporaryFolder folder;
    int checked = 0;
    for (const std::string shell : {"bash", "zsh", "fish"}) {
        const std::string file = (folder / shell).string();
        write_text(file, limn("completions " + shell).output);
        if (!has_tool(shell))
            continue;
        const ProgramResult result = run_shell(shell + " -n " + file);
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        ++checked;
    }
    EXPECT_GE(checked, 1);
    EXPECT_EQ(limn("completions csh").exit_code, 2);
}

TEST(Completions, OfBashComplete)
{
    const TemporaryFolder folder;
    write_text(folder / "limn.bash", limn("completions bash").output);
    write_text(folder / "model.ply", "");
    const auto complete = [&](const std::string& words, int at) {
        write_text(folder / "try.bash", fmt::format("cd '{}'\n. ./limn.bash\nCOMP_WORDS=({})\nCOMP_CWORD={}\n_limn\necho \"${{COMPREPLY[*]}}\"\n",
                                                    folder.path().string(), words, at));
        return run_shell("bash " + (folder / "try.bash").string()).output;
    };
    EXPECT_EQ(complete("limn dr", 1), "draw\n");
    EXPECT_EQ(complete("limn draw --hi", 2), "--hidden --highlight-limit\n");
    EXPECT_EQ(complete("limn draw --hidden ''", 3), "remove dash keep\n");
    EXPECT_EQ(complete("limn draw mod", 2), "model.ply\n");
    EXPECT_EQ(complete("limn draw --cache mod", 3), "model.ply\n");
    EXPECT_EQ(complete("limn sample bumpy", 2), "bumpy-torus\n");
    EXPECT_EQ(complete("limn sample va", 2), "vase\n");
    EXPECT_EQ(complete("limn draw --fade ''", 3), "\n");
}

TEST(ManPage, HoldsEveryOptionOfEverySubcommandAndIsCleanTroff)
{
    const TemporaryFolder folder;
    const std::string page = limn("man").output;
    write_text(folder / "limn.1", page);
    for (const std::string& command : subcommands) {
        std::string title = command;
        std::transform(title.begin(), title.end(), title.begin(), [](unsigned char c) { return char(std::toupper(c)); });
        const std::string section = between(page, "\n.SH LIMN " + title + "\n", "\n.SH ");
        for (const std::string& option : options_in_help(command))
            EXPECT_NE(section.find("\\fB" + std::regex_replace(option, std::regex("-"), "\\-") + "\\fR"), std::string::npos) << command << " " << option;
        EXPECT_NE(section.find("Examples:\n"), std::string::npos) << command;
    }
    if (!has_tool("groff"))
        GTEST_SKIP() << "groff is not installed";
    const ProgramResult set = run_shell("groff -man -ww -Tascii " + (folder / "limn.1").string());
    EXPECT_EQ(set.exit_code, 0);
    EXPECT_EQ(set.errors, "");
    EXPECT_NE(set.output.find("draws the shape of 3D things"), std::string::npos);
}

} // namespace
} // namespace limn::test
