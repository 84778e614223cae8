// One text for two languages: what the library compiles as C++ must also be GLSL.
#include <gtest/gtest.h>

#include <filesystem>

#include "limn/gpu/program.h"
#include "support/support.h"

namespace limn {
namespace {

/// What files without an include guard ask of the shader that includes them (see image_lines.glsl).
const std::string picture = R"(float pixel(const ivec2 p) { return 0.0f; }
float window_depth(const ivec2 p) { return 0.0f; }
float nearness(const ivec2 p) { return 0.0f; }
vec3 normal_at(const ivec2 p) { return vec3(0.0f); }
uint id_at(const ivec2 p) { return 0u; }
uint vector_at(const ivec2 p) { return 0u; }
uint last_of_run(const uint i) { return i; }
float layer_top(const int k) { return float(k); }
float ground_value(const ivec2 p) { return 1.0f; }
)";

/// The text that a driver would get, with what the file includes.
std::string whole_shader(const std::filesystem::path& file)
{
    const std::string name = file.filename().string();
    const bool guarded = test::read_text(file).find("#pragma once") != std::string::npos;
    const std::string before = guarded ? "" : "#include \"limn/formulas/sobel.glsl\"\n#include \"limn/formulas/print_layers.glsl\"\n#include \"limn/formulas/pattern_picture.glsl\"\n" + picture;
    return gpu::expand_shader(name, before + "#include \"limn/formulas/" + name + "\"\nlayout(location = 0) out vec4 colour;\nvoid main() { colour = vec4(1.0f); }\n");
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
