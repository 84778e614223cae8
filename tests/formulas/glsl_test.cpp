// One text for two languages: what the library compiles as C++ must also be GLSL.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/support.h"

namespace limn {
namespace {

const std::string prelude = R"(#version 450
#define FORMULA
#define OUT(T) out T
#define INOUT(T) inout T
#define OUT_ARRAY(T, name, n) out T name[n]
)";

TEST(Formulas, AreValidGlsl)
{
    if (test::run_shell("command -v glslangValidator").exit_code != 0)
        GTEST_SKIP() << "glslangValidator is not installed";
    const test::TemporaryFolder folder;
    int checked = 0;
    for (const auto& entry : std::filesystem::directory_iterator(LIMN_FORMULAS)) {
        if (entry.path().extension() != ".glsl")
            continue;
        test::write_text(folder / "shader.frag", prelude + test::read_text(entry.path())
                                                     + "\nlayout(location = 0) out vec4 colour;\nvoid main() { colour = vec4(1.0f); }\n");
        const test::ProgramResult result = test::run_shell("glslangValidator '" + (folder / "shader.frag").string() + "'");
        EXPECT_EQ(result.exit_code, 0) << entry.path() << "\n" << result.output;
        ++checked;
    }
    EXPECT_GT(checked, 0);
}

} // namespace
} // namespace limn
