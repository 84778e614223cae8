// Prints from G-code on the command line (the procedural structures specification, 7.6).

#include "command/command.h"
#include "limn/pattern/vase_gcode.h"

namespace limn::test {
namespace {

class PrintCommand : public WithTorus {
protected:
    PrintCommand() { write_text(folder_ / "vase.gcode", vase_gcode({.height = 6, .moves = 3000})); }
    std::string vase() const { return path("vase.gcode"); }
    void expect_error(const std::string& arguments, int code, const std::string& message) const
    {
        const ProgramResult result = limn(arguments);
        EXPECT_EQ(result.exit_code, code) << arguments;
        EXPECT_NE(result.errors.find(message), std::string::npos) << result.errors;
        EXPECT_EQ(line_count(result.errors), 1) << result.errors;
        EXPECT_EQ(result.output, "");
        EXPECT_FALSE(exists("x.png"));
    }
};

TEST_F(PrintCommand, InfoTellsWhatTheFileHolds)
{
    const ProgramResult text = limn("info " + vase());
    EXPECT_EQ(text.exit_code, 0) << text.errors;
    EXPECT_NE(text.output.find("layers          30, 0.2 mm high\n"), std::string::npos) << text.output;
    EXPECT_NE(text.output.find("  outer wall    "), std::string::npos);
    EXPECT_NE(text.output.find("slicer          PrusaSlicer 2.5.0"), std::string::npos);
    const auto json = nlohmann::json::parse(limn("info --json " + vase()).output);
    EXPECT_EQ(json["print"]["layers"], 30);
    EXPECT_NEAR(double(json["print"]["bounds"]["high"][2]), 6, 1e-5);
    EXPECT_GT(double(json["print"]["filament"]["volume"]), 100);
    EXPECT_GT(double(json["print"]["seconds"]["at_full_speed"]), 60);
}

TEST_F(PrintCommand, SampleWritesTheVaseInEachDialect)
{
    for (const std::string slicer : {"prusaslicer", "cura", "orcaslicer"}) {
        const ProgramResult made =
            limn("sample vase --moves 2000 --layer-height 0.5 --slicer " + slicer + " -o " + path(slicer + ".gcode"));
        EXPECT_EQ(made.exit_code, 0) << made.errors;
        EXPECT_EQ(nlohmann::json::parse(limn("info --json " + path(slicer + ".gcode")).output)["print"]["layers"], 120);
    }
    EXPECT_EQ(limn("sample vase -o " + path("vase.ply")).exit_code, 2);
    EXPECT_NE(limn("sample torus --moves 2000 -o " + path("t.ply")).errors.find("--moves: 'torus' is no print; a vase is"),
              std::string::npos);
}

TEST_F(PrintCommand, RenderDrawsItAndSaysWhatItDrew)
{
    const ProgramResult drawn = limn("render " + vase() + " -o " + path("x.png") +
                                     " --size 96x72 --color feature --layers 1..20 --travel --filament petg-black --json");
    EXPECT_EQ(drawn.exit_code, 0) << drawn.errors;
    EXPECT_TRUE(exists("x.png"));
    EXPECT_NE(drawn.errors.find("layers 1 to 20 of 30"), std::string::npos) << drawn.errors;
    const auto json = nlohmann::json::parse(drawn.output);
    EXPECT_EQ(json["print"]["layers"], 30);
    EXPECT_LT(json["print"]["shown"], json["print"]["moves"]);
    EXPECT_EQ(json["views"].size(), 1u);
    const ProgramResult turned =
        limn("render " + vase() + " -o " + path("turn.png") + " --size 48x36 --turntable 3 --shadow ray --shadow-samples 4");
    EXPECT_EQ(turned.exit_code, 0) << turned.errors;
    EXPECT_TRUE(exists("turn-002.png"));
    EXPECT_EQ(limn("render " + vase() + " -o " + path("sheet.png") + " --size 96x72 --view front --view top --color speed").exit_code, 0);
    EXPECT_EQ(
        run_shell("cat " + vase() + " | " LIMN_COMMAND " render - --from gcode -o - --to png --size 48x36 | head -c 4").output.substr(1),
        "PNG");
}

TEST_F(PrintCommand, HelpTellsOfEveryOption)
{
    const std::string render = limn("render --help").output, sample = limn("sample --help").output;
    for (const std::string name : {"--color", "--layers", "--travel", "--bead-detail", "--filament-diameter"})
        EXPECT_NE(render.find(name), std::string::npos) << name;
    for (const std::string name : {"--slicer", "--moves", "--layer-height"})
        EXPECT_NE(sample.find(name), std::string::npos) << name;
    EXPECT_NE(limn("bench nothing").errors.find("print"), std::string::npos);
}

TEST_F(PrintCommand, BenchMeasuresReadingAndDrawing)
{
    const ProgramResult result = limn("bench print --sizes 2k --runs 1 --quiet --json");
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const auto rows = nlohmann::json::parse(result.output)["prints"];
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_TRUE(rows[0].contains("million lines/s"));
}

TEST_F(PrintCommand, WhatCannotBeDrawnIsOneLine)
{
    const std::string out = " -o " + path("x.png");
    write_text(folder_ / "bad.gcode", "G90\nM83\nG1 X1 Y2 Z.2 F600\nG1 X1..5 E1\n");
    expect_error("render " + path("bad.gcode") + out, 1, "limn: " + path("bad.gcode") + ": line 4: '.5' is no word of a move");
    expect_error("info " + path("bad.gcode"), 1, "line 4");
    write_text(folder_ / "cut.gcode", vase_gcode({.height = 2, .moves = 1000, .slicer = SlicerDialect::cura}).substr(0, 20000));
    expect_error("render " + path("cut.gcode") + out, 1, path("cut.gcode") + ": line ");
    expect_error("render " + path("none.gcode") + out, 1, "none.gcode: cannot be opened");
    expect_error("render " + vase() + " " + torus() + out, 2, "a print from G-code is drawn alone; give one file");
    expect_error("render " + vase() + out + " --layers 31..", 2, "--layers: the print has 30 layers, and none from 31 on");
    expect_error("render " + vase() + out + " --layers 5..2", 2, "--layers: 5..2 ends before it begins");
    expect_error("render " + vase() + out + " --layers x", 2, "--layers: 'x' is not A..B");
    expect_error("render " + vase() + out + " --lines contour", 2, "--lines: G-code is drawn bead by bead; that option is for meshes");
    expect_error("render " + vase() + out + " --device gpu", 2, "--device gpu: beads are drawn on the CPU so far");
    expect_error("draw " + vase() + " -o " + path("x.png"), 1, "vase.gcode: is G-code and holds no mesh; 'limn render' draws it, alone");
    expect_error("render " + torus() + out + " --color feature", 2, "--color is of G-code, and no file is");
}

TEST_F(PrintCommand, NotesAreWarningsUnlessStrict)
{
    write_text(folder_ / "note.gcode",
               "; generated by PrusaSlicer 2.5.0 on 2024-01-01\nM83\n;LAYER_CHANGE\n;HEIGHT:0.2\nG1 Z.2 F600\nG1 X10 E1\n");
    const ProgramResult told = limn("render " + path("note.gcode") + " --size 32x24 -o " + path("n.png"));
    EXPECT_EQ(told.exit_code, 0);
    EXPECT_NE(told.errors.find("it may be cut short"), std::string::npos) << told.errors;
    expect_error("render --strict " + path("note.gcode") + " -o " + path("x.png"), 1, "(--strict)");
    expect_error("info --strict " + path("note.gcode"), 1, "(--strict)");
}

} // namespace
} // namespace limn::test
