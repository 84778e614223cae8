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

/// What files without an include guard ask of the shader that includes them (see image_lines.glsl).
const std::string picture = R"(float pixel(const ivec2 p) { return 0.0f; }
float window_depth(const ivec2 p) { return 0.0f; }
float nearness(const ivec2 p) { return 0.0f; }
vec3 normal_at(const ivec2 p) { return vec3(0.0f); }
uint id_at(const ivec2 p) { return 0u; }
)";

std::string whole_shader(const std::filesystem::path& file)
{
    const std::string text = test::read_text(file);
    const bool guarded = text.find("#pragma once") != std::string::npos;
    const std::string before = guarded ? "" : test::read_text(file.parent_path() / "sobel.glsl") + picture;
    return prelude + before + text + "\nlayout(location = 0) out vec4 colour;\nvoid main() { colour = vec4(1.0f); }\n";
}

TEST(Formulas, AreValidGlsl)
{
    if (test::run_shell("command -v glslangValidator").exit_code != 0)
        GTEST_SKIP() << "glslangValidator is not installed";
    const test::TemporaryFolder folder;
    int checked = 0;
    for (const auto& entry : std::filesystem::directory_iterator(LIMN_FORMULAS)) {
        if (entry.path().extension() != ".glsl")
            continue;
        test::write_text(folder / "shader.frag", whole_shader(entry.path()));
        const test::ProgramResult result = test::run_shell("glslangValidator '" + (folder / "shader.frag").string() + "'");
        EXPECT_EQ(result.exit_code, 0) << entry.path() << "\n" << result.output;
        ++checked;
    }
    EXPECT_GT(checked, 0);
}

} // namespace
} // namespace limn
