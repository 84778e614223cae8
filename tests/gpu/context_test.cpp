#include <algorithm>

#include <epoxy/gl.h>

#include "gpu/gpu.h"
#include "limn/gpu/program.h"
#include "limn/gpu/quirks.h"
#include "limn/gpu/resources.h"
#include "support/support.h"

namespace limn::test {
namespace {

class GpuContext : public Gpu {};

TEST_F(GpuContext, IsOpenGL45Core)
{
    GLint major = 0, minor = 0, profile = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_GE(10 * major + minor, 45);
    EXPECT_EQ(profile & GL_CONTEXT_CORE_PROFILE_BIT, GL_CONTEXT_CORE_PROFILE_BIT);
    EXPECT_FALSE(context->info().renderer.empty());
    EXPECT_GE(context->info().max_texture_size, 16384) << "OpenGL 4.5 promises that";
    RecordProperty("driver", context->info().renderer + ", " + context->info().version);
}

TEST_F(GpuContext, ReportsWhatTheDriverFindsWrong)
{
    int problems = 0;
    context->on_problem([&](const std::string&) { ++problems; });
    glBindTexture(GL_TEXTURE_2D, 12345678);
    EXPECT_EQ(problems, 1);
    EXPECT_THROW(gpu::check_errors("binding nothing"), Error::Device);
    EXPECT_NO_THROW(gpu::check_errors("doing nothing"));
}

TEST_F(GpuContext, KnowsTheFaultsOfMesasSoftwareRenderer)
{
    const gpu::Quirks quirks = gpu::find_quirks();
    RecordProperty("small_tessellated_draws", quirks.small_tessellated_draws);
    RecordProperty("needs_depth", quirks.needs_depth);
    if (context->info().version.find("Mesa 22.3") != std::string::npos && context->info().software) {
        EXPECT_TRUE(quirks.small_tessellated_draws);
        EXPECT_TRUE(quirks.needs_depth);
    }
}

TEST_F(GpuContext, TellsWhatIsWrongWithAShader)
{
    const auto message = [](const std::vector<gpu::ShaderText>& shaders) -> std::string {
        try {
            gpu::Program program(shaders);
        } catch (const Error::Device& error) {
            return error.what();
        }
        return "";
    };
    context->on_problem({}); // the driver repeats the compiler's complaint
    const std::string typo = message({{gpu::Stage::compute, "typo.comp", "layout(local_size_x = 1) in;\nvoid main() { flaot x; }\n"}});
    EXPECT_NE(typo.find("typo.comp"), std::string::npos) << typo;
    EXPECT_NE(typo.find("2"), std::string::npos) << "the line: " << typo;
    const std::string lost = message({{gpu::Stage::compute, "lost.comp", "#include \"limn/formulas/cheese.glsl\"\nvoid main() {}\n"}});
    EXPECT_NE(lost.find("limn/formulas/cheese.glsl"), std::string::npos) << lost;
    EXPECT_THROW(gpu::load_program({"cheese.vert"}), Error::Device);
}

TEST_F(GpuContext, IncludesEachFileOnceAndKeepsLineNumbers)
{
    const std::string text = gpu::expand_shader("x.comp", "#include \"limn/formulas/shading.glsl\"\n#include \"limn/formulas/shading.glsl\"\nvoid main() {}\n");
    const std::size_t first = text.find("FORMULA float toon_tone(");
    EXPECT_NE(first, std::string::npos);
    EXPECT_EQ(text.find("FORMULA float toon_tone(", first + 1), std::string::npos);
    EXPECT_NE(text.find("#line 3\nvoid main"), std::string::npos);
    EXPECT_EQ(text.find("#pragma once"), std::string::npos);
}

TEST_F(GpuContext, SaysWhatThereIsNoRoomFor)
{
    context->on_problem({}); // the driver says so too
    const auto message = [](const auto& make) -> std::string {
        try {
            make();
        } catch (const Error::Device& error) {
            return error.what();
        }
        return "";
    };
    const std::string buffer = message([] { gpu::Buffer(std::size_t(1) << 50); });
    EXPECT_NE(buffer.find(std::to_string(std::size_t(1) << 50)), std::string::npos) << buffer;
    const int edge = 4 * context->info().max_texture_size;
    const std::string picture = message([&] { gpu::Framebuffer({edge, edge}, {gpu::Format::rgba32f}); });
    EXPECT_NE(picture.find(std::to_string(edge)), std::string::npos) << picture;
    EXPECT_NO_THROW(gpu::Framebuffer({16, 16}, {gpu::Format::rgba32f})) << "afterwards all is as before";
    gpu::check_errors("testing");
}

TEST_F(GpuContext, BuffersKeepWhatIsWritten)
{
    const std::vector<float> data = {1, 2, 3, 4, 5};
    const gpu::Buffer buffer(data);
    EXPECT_EQ(buffer.read<float>(5), data);
    const float seven = 7;
    buffer.write(2 * sizeof(float), sizeof(float), &seven);
    EXPECT_EQ(buffer.read<float>(2, 2), (std::vector<float>{7, 4}));
    buffer.clear();
    EXPECT_EQ(buffer.read<float>(5), std::vector<float>(5, 0));
}

TEST_F(GpuContext, PicturesKeepTheirFormatsApart)
{
    const gpu::Framebuffer picture({3, 2}, {gpu::Format::rgba32f, gpu::Format::r32ui});
    picture.clear(0, vec4(1, 2, 3, 4));
    picture.clear(1, 77u);
    picture.clear_depth(0.25f);
    EXPECT_EQ(picture.read_floats(0), std::vector<vec4>(6, vec4(1, 2, 3, 4)));
    EXPECT_EQ(picture.read_unsigned(1), std::vector<unsigned>(6, 77u));
    EXPECT_EQ(picture.read_depth(), std::vector<float>(6, 0.25f));
}

TEST_F(GpuContext, RefusesPicturesThatDoNotFit)
{
    context->on_problem({});
    const int more = 2 * context->info().max_texture_size;
    EXPECT_THROW(gpu::Framebuffer({more, more}, {gpu::Format::rgba32f}), Error::Device);
    while (glGetError() != GL_NO_ERROR) {
    }
}

TEST_F(GpuContext, TimesWhatTheDeviceDoes)
{
    const gpu::Timer timer;
    const gpu::Framebuffer picture({512, 512}, {gpu::Format::rgba32f});
    timer.start();
    picture.clear(0, vec4(0));
    timer.stop();
    EXPECT_GE(timer.milliseconds(), 0);
    EXPECT_LT(timer.milliseconds(), 1e4);
}

TEST(GpuContextWithoutDriver, SaysSoInOneLine)
{
    const ProgramResult result = run_shell("__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent '" LIMN_GPU_PROBE "'");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_NE(result.output.find("OpenGL 4.5"), std::string::npos) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
}

TEST(GpuContextWithoutDriver, RefusesAnOldOne) // softpipe has OpenGL 3.3 only
{
    const ProgramResult result = run_shell("GALLIUM_DRIVER=softpipe LIBGL_ALWAYS_SOFTWARE=1 '" LIMN_GPU_PROBE "'");
    if (result.exit_code == 0)
        GTEST_SKIP() << "this driver ignores GALLIUM_DRIVER: " << result.output;
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_NE(result.output.find("OpenGL 4.5"), std::string::npos) << result.output;
}

} // namespace
} // namespace limn::test
