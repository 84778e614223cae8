#include "limn/gpu/image_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <epoxy/gl.h>

#include "limn/gpu/context.h"

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

void ImageLineFinder::run(const DeviceFields& fields, const ImageLineOptions& options, const Buffer& found) const
{
    check(options);
    const Buffer* inputs[] = {&fields.intensity, &fields.window_depth, &fields.nearness, &fields.normals, &fields.ids, &found};
    for (unsigned binding = 0; binding < std::size(inputs); ++binding)
        inputs[binding]->bind_storage(binding);
    program_.set("size", fields.size);
    program_.set("method", int(options.method));
    program_.set("limit", limit_of(options));
    program_.set("least_cosine", std::cos(options.fold_degrees * std::numbers::pi_v<float> / 180));
    program_.set("relative", fields.orthographic ? 0.0f : 1.0f);
    program_.set("radius", options.radius);
    program_.set("reach", options.radius_scale * fields.pixels_per_radius);
    program_.set("darker", options.darker);
    program_.use();
    glDispatchCompute(unsigned(fields.size.x + 15) / 16, unsigned(fields.size.y + 15) / 16, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

Image ImageLineFinder::find(const DeviceFields& fields, const ImageLineOptions& options) const
{
    Image lines(fields.size, 1);
    const Buffer found(lines.samples.size() * sizeof(unsigned));
    run(fields, options, found);
    const std::vector<unsigned> pixels = found.read<unsigned>(lines.samples.size());
    check_errors("finding lines in a picture");
    std::copy(pixels.begin(), pixels.end(), lines.samples.begin());
    return lines;
}

Image ImageLineFinder::find(const LineFields& f, const ImageLineOptions& options) const
{
    return find(DeviceFields{f.size, f.orthographic, f.pixels_per_radius, Buffer(f.intensity), Buffer(f.window_depth), Buffer(f.nearness), Buffer(f.normals), Buffer(f.ids)}, options);
}

} // namespace limn::gpu
