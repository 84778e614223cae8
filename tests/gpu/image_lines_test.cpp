#include "limn/gpu/image_lines.h"

#include "gpu/gpu.h"
#include "limn/lines/draw.h"
#include "limn/lines/regions.h"
#include "limn/surface/shapes.h"

namespace limn::test {
namespace {

class GpuImageLines : public Gpu {};

LineFields fields_of(const std::string& name, bool orthographic)
{
    const Shape shape = make_shape({.name = name, .triangles = 40000});
    const PlacedSurface placed = {&shape.mesh, &shape.exact};
    const LineModel model = build_line_model({&placed, 1});
    const RayScene rays = build_ray_scene(model);
    const SeenScene scene = seen_scene(model, rays);
    const Camera camera = Camera::framing(shape.mesh.bounds(), {.view = "35,25", .up_axis = 'z', .size = {301, 203}, .orthographic = orthographic});
    return line_fields(trace_gbuffer(scene, camera), camera, scene, model.scale);
}

// The texts are shared and the inputs are the same numbers: only what lies within rounding of a limit may differ.
TEST_F(GpuImageLines, FindThePixelsThatTheProcessorFinds)
{
    const gpu::ImageLineFinder finder;
    for (const bool orthographic : {false, true})
        for (const char* name : {"blob", "rings", "bumpy-torus"}) {
            const LineFields fields = fields_of(name, orthographic);
            for (const ImageMethod method : {ImageMethod::threshold, ImageMethod::depth_raw, ImageMethod::depth, ImageMethod::valley_printed, ImageMethod::valley}) {
                ImageLineOptions options;
                options.method = method;
                const Image processor = find_image_lines(fields, options), device = finder.find(fields, options);
                std::size_t differ = 0, lines = 0;
                for (std::size_t i = 0; i < processor.samples.size(); ++i) {
                    differ += processor.samples[i] != device.samples[i];
                    lines += processor.samples[i] == 1;
                }
                EXPECT_GT(lines, 100u) << name << " method " << int(method);
                EXPECT_LE(differ, processor.samples.size() / 10000) << name << " method " << int(method);
            }
        }
}

} // namespace
} // namespace limn::test
