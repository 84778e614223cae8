#include "limn/gpu/image_lines.h"

#include <cmath>
#include <numbers>

#include <epoxy/gl.h>

#include "limn/gpu/context.h"
#include "limn/gpu/resources.h"

namespace limn::gpu {
namespace {

float limit_of(const ImageLineOptions& options)
{
    switch (options.method) {
    case ImageMethod::threshold: return options.dark;
    case ImageMethod::depth_raw: return options.sobel;
    case ImageMethod::depth: return options.step;
    default: return options.contrast;
    }
}

} // namespace

ImageLineFinder::ImageLineFinder() : program_(load_program({"image_lines.comp"})) {}

Image ImageLineFinder::find(const LineFields& fields, const ImageLineOptions& options) const
{
    check(options);
    const std::size_t count = fields.intensity.size();
    const Buffer inputs[] = {Buffer(fields.intensity), Buffer(fields.window_depth), Buffer(fields.nearness), Buffer(fields.normals), Buffer(fields.ids)};
    for (unsigned binding = 0; binding < 5; ++binding)
        inputs[binding].bind_storage(binding);
    const Buffer found(count * sizeof(unsigned));
    found.bind_storage(5);
    program_.set("size", fields.size);
    program_.set("method", int(options.method));
    program_.set("limit", limit_of(options));
    program_.set("least_cosine", std::cos(options.fold_degrees * std::numbers::pi_v<float> / 180));
    program_.set("relative", fields.orthographic ? 0.0f : 1.0f);
    program_.set("radius", options.radius);
    program_.set("darker", options.darker);
    program_.use();
    glDispatchCompute(unsigned(fields.size.x + 15) / 16, unsigned(fields.size.y + 15) / 16, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const std::vector<unsigned> pixels = found.read<unsigned>(count);
    check_errors("finding lines in a picture");
    Image lines(fields.size, 1);
    for (std::size_t i = 0; i < count; ++i)
        lines.samples[i] = float(pixels[i]);
    return lines;
}

} // namespace limn::gpu
