#include <gtest/gtest.h>

#include "command/command.h"

namespace limn::test {
namespace {

using Usage = WithTorus;

void expect_usage_error(const std::string& arguments, const std::string& message)
{
    const ProgramResult result = limn(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_EQ(result.output, "") << arguments;
    EXPECT_EQ(result.errors, message + "\n") << arguments;
}

TEST_F(Usage, HelpAndVersionGoToStandardOutput)
{
    const ProgramResult version = limn("--version"), help = limn("--help");
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_EQ(version.output, "limn " LIMN_VERSION "\n");
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.output.find("Usage: limn COMMAND"), std::string::npos);
    EXPECT_EQ(version.errors + help.errors, "");
}

TEST_F(Usage, EverySubcommandHasHelpWithExamplesWithinAHundredColumns)
{
    for (const std::string command : {"bench", "completions", "draw", "info", "man", "render", "sample", "shadow", "subdivide", "terrain", "view"}) {
        const ProgramResult help = limn(command + " --help");
        EXPECT_EQ(help.exit_code, 0);
        EXPECT_NE(help.output.find("Usage: limn " + command), std::string::npos);
        EXPECT_NE(help.output.find("Examples:\n  limn " + command), std::string::npos);
        std::istringstream lines(help.output);
        for (std::string line; std::getline(lines, line);)
            EXPECT_LE(line.size(), 100u) << line;
    }
}

TEST_F(Usage, HelpShowsEveryRowOfTheOptionTables)
{
    const std::string help = limn("draw --help").output;
    for (const std::string name : {"lines", "hidden", "method", "suggestive-limit", "highlight-limit", "speed-limit", "crease-angle",
                                   "feature-size", "style", "width", "stroke", "page", "curvature", "curvature-radius", "smooth", "fill",
                                   "turntable", "cache", "size", "view", "eye", "look", "up", "fov", "ortho", "scale", "camera", "up-axis",
                                   "threads", "quiet", "json", "strict", "device", "to", "from"})
        EXPECT_NE(help.find("--" + name), std::string::npos) << name;
}

TEST_F(Usage, AMistypedOptionOrCommandIsAnsweredWithTheNearestRealOne)
{
    expect_usage_error("--vresion", "limn: unknown option '--vresion'; did you mean '--version'?");
    expect_usage_error("darw x.ply", "limn: unknown command 'darw'; did you mean 'draw'?");
    expect_usage_error("draw --sise 3x3 " + torus(), "limn draw: unknown option '--sise'; did you mean '--size'?");
    expect_usage_error("draw --sugestive-limit=1 x.ply", "limn draw: unknown option '--sugestive-limit'; did you mean '--suggestive-limit'?");
    expect_usage_error("draw --zzzzzzzzzzzz x.ply", "limn draw: unknown option '--zzzzzzzzzzzz'; see 'limn draw --help'");
    expect_usage_error("sample tours -o t.ply", "limn sample: 'tours' is no shape; did you mean 'torus'?");
    expect_usage_error("draw x.ply -o x.sgv",
                       "limn draw: -o x.sgv: 'sgv' is not a format to write; known: svg, pdf, png, dxf, json, ply (did you mean 'svg'?)");
}

TEST_F(Usage, ValuesOutOfTheirRangeAreRefusedBeforeAnythingIsRead)
{
    const std::string missing = "draw no-such-file.obj -o " + path("a.svg") + " ";
    expect_usage_error(missing + "--size 0x0", "limn draw: --size: '0x0' is outside 1x1..32768x32768");
    expect_usage_error(missing + "--size 640", "limn draw: --size: '640' is not WIDTHxHEIGHT");
    expect_usage_error(missing + "--view sideways", "limn draw: --view: 'sideways' is none of front|back|left|right|top|bottom|iso|AZ,EL");
    expect_usage_error(missing + "--eye 1,2", "limn draw: --eye: '1,2' is not x,y,z");
    expect_usage_error(missing + "--eye 1,2,nan", "limn draw: --eye: 'nan' is not a number");
    expect_usage_error(missing + "--crease-angle 200", "limn draw: --crease-angle: 200 is outside 0..180");
    expect_usage_error(missing + "--scale 2", "limn draw: --scale: '2' is not 1:N with N above 0");
    expect_usage_error(missing + "--eye 1,2,3 --view top", "limn draw: --eye and --view both place the camera; leave one out");
    expect_usage_error("draw " + torus() + " -o " + path("a.svg") + " --eye 1e300,0,0",
                       "limn draw: --eye: the eye is farther than 1e+15 from where it looks; move --eye or --look");
    expect_usage_error("draw " + torus() + " -o " + path("a.svg") + " --eye 1e-200,0,0 --look 0,0,0",
                       "limn draw: --eye: the eye is where it looks; move --eye or --look");
    EXPECT_EQ(limn(missing + "--lines conture").exit_code, 2);
    EXPECT_EQ(limn(missing + "--turntable 0").exit_code, 2);
    EXPECT_EQ(limn(missing + "--threads -1").exit_code, 2);
    EXPECT_EQ(files(), std::vector<std::string>{"torus.obj"});
}

TEST_F(Usage, EverySubcommandTakesTheCommonOptions)
{
    for (const std::string command : {"bench", "draw", "info", "sample"}) {
        const std::string help = limn(command + " --help").output;
        for (const char* option : {"-o,--output FILE", "--to FORMAT", "--threads N", "--device DEVICE", "--json", "--strict", "--quiet"})
            EXPECT_NE(help.find(option), std::string::npos) << command << " " << option;
    }
}

TEST_F(Usage, AGpuThatACommandDoesNotUseIsRefusedBeforeAnythingIsRead)
{
    for (const auto& [command, rest] : {std::pair<std::string, std::string>{"draw", "missing.obj -o " + path("a.svg")},
                                        {"info", "missing.obj"},
                                        {"sample", "torus -o " + path("a.ply")},
                                        {"bench", "lines"}}) {
        const ProgramResult result = limn(command + " " + rest + " --device gpu");
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_EQ(result.errors, "limn: --device gpu: 'limn " + command + "' computes on the CPU only; leave --device out, or say cpu\n");
    }
    EXPECT_EQ(files(), std::vector<std::string>{"torus.obj"});
    for (const std::string device : {"cpu", "auto"})
        EXPECT_EQ(limn("info " + torus() + " --device " + device).exit_code, 0);
    EXPECT_EQ(limn("info " + torus() + " --device abacus").exit_code, 2);
}

TEST_F(Usage, InfoWritesItsFactsToFiles)
{
    const ProgramResult text = limn("info " + torus() + " --quiet"), json = limn("info " + torus() + " --quiet --json");
    const ProgramResult files_only = limn("info " + torus() + " --quiet -o " + path("a.txt") + " -o " + path("a.json"));
    EXPECT_EQ(files_only.output + files_only.errors, "");
    EXPECT_EQ(read_text(folder_ / "a.txt"), text.output);
    EXPECT_EQ(nlohmann::json::parse(read_text(folder_ / "a.json"))["mesh"], nlohmann::json::parse(json.output)["mesh"]);
    EXPECT_EQ(limn("info " + torus() + " --quiet -o - --to txt").output, text.output);
    expect_usage_error("info " + torus() + " -o a.svg", "limn info: -o a.svg: 'svg' is not a format to write; known: txt, json");
}

TEST_F(Usage, JsonAndADrawingOnStandardOutputExcludeEachOther)
{
    expect_usage_error("draw " + torus() + " --json -o - --to svg", "limn draw: --json and -o - both want standard output");
    expect_usage_error("draw " + torus() + " -o -", "limn draw: -o -: standard output has no ending; say --to svg|pdf|png|dxf|json|ply");
    expect_usage_error("draw " + torus() + " -o - --to svg --turntable 3",
                       "limn draw: --turntable writes numbered files; -o - cannot hold them");
}

TEST_F(Usage, ARunThatWouldDoNothingSaysWhatIsMissing)
{
    EXPECT_EQ(limn("draw").exit_code, 2);
    EXPECT_EQ(limn("draw " + torus()).exit_code, 2);
    EXPECT_EQ(limn("sample").exit_code, 2);
    EXPECT_EQ(limn("info").exit_code, 2);
}

} // namespace
} // namespace limn::test
