#include "limn/gpu/image_lines.h"

#include <algorithm>

#include <fmt/format.h>

#include "gpu/gpu.h"
#include "limn/gpu/field_view.h"
#include "support/staged_shape.h"

namespace limn::test {
namespace {

class GpuImageLines : public Gpu {};

struct Setting {
    ImageMethod method;
    float radius_scale;
};
constexpr Setting all_settings[] = {{ImageMethod::threshold, 0}, {ImageMethod::depth_raw, 0},         {ImageMethod::depth, 0},    {ImageMethod::valley_printed, 0},
                                    {ImageMethod::valley, 0},    {ImageMethod::valley_printed, 0.04f}, {ImageMethod::valley, 0.04f}};

LineFields fields_of(const StagedShape& stage, const Camera& camera)
{
    return line_fields(trace_gbuffer(stage.seen(), camera), camera, stage.seen(), stage.model.scale);
}

std::size_t differing(const Image& a, const Image& b)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.samples.size(); ++i)
        count += a.samples[i] != b.samples[i];
    return count;
}

// The texts are shared and the inputs are the same numbers: only what lies within rounding of a limit may differ.
TEST_F(GpuImageLines, FindThePixelsThatTheProcessorFinds)
{
    const gpu::ImageLineFinder finder;
    for (const bool orthographic : {false, true})
        for (const char* name : {"blob", "rings", "bumpy-torus"}) {
            const StagedShape stage(name, 40000);
            const LineFields fields = fields_of(stage, stage.camera({301, 203}, orthographic));
            for (const Setting& setting : all_settings) {
                const ImageMethod method = setting.method;
                ImageLineOptions options;
                options.method = method;
                options.radius_scale = setting.radius_scale;
                const Image processor = find_image_lines(fields, options), device = finder.find(fields, options);
                const std::size_t differ = differing(processor, device), lines = std::size_t(std::count(processor.samples.begin(), processor.samples.end(), 1.0f));
                EXPECT_GT(lines, 100u) << name << " method " << int(method);
                EXPECT_LE(differ, processor.samples.size() / 10000) << name << " method " << int(method);
            }
        }
}

// The fields are drawn on the device too: now the two may see other faces along edges.
TEST_F(GpuImageLines, AreThoseOfTheProcessorWhenTheDeviceDrawsTheModelToo)
{
    const gpu::ImageLineFinder finder;
    for (const bool orthographic : {false, true})
        for (const char* name : {"blob", "rings"}) {
            const StagedShape stage(name, 40000);
            const Camera camera = stage.camera({301, 203}, orthographic);
            const LineFields fields = fields_of(stage, camera);
            gpu::FieldRenderer renderer(stage.model);
            for (const Setting& setting : all_settings) {
                const ImageMethod method = setting.method;
                ImageLineOptions options;
                options.method = method;
                options.radius_scale = setting.radius_scale;
                const Image device = gpu::draw_image_lines(renderer, finder, camera, options);
                const std::size_t differ = differing(device, find_image_lines(fields, options));
                fmt::print("[ fields   ] {}{}, method {}: {} of {} pixels differ\n", name, orthographic ? ", orthographic" : "", int(method), differ, device.samples.size());
                EXPECT_LE(differ, device.samples.size() / 1000) << name << " method " << int(method);
            }
        }
}

TEST_F(GpuImageLines, LargePicturesArePutTogetherFromTiles)
{
    const gpu::ImageLineFinder finder;
    const StagedShape stage("blob", 20000);
    gpu::FieldRenderer renderer(stage.model);
    const Camera camera = stage.camera({230, 170});
    for (const Setting& setting : all_settings) {
        const ImageMethod method = setting.method;
        ImageLineOptions options;
        options.method = method;
        options.radius_scale = setting.radius_scale;
        options.radius = 9;
        const Image whole = gpu::draw_image_lines(renderer, finder, camera, options), tiled = gpu::draw_image_lines(renderer, finder, camera, options, 64);
        EXPECT_LE(differing(whole, tiled), whole.samples.size() / 2000) << int(method);
    }
}

} // namespace
} // namespace limn::test
