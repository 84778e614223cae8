#pragma once

#include "limn/gpu/program.h"
#include "limn/gpu/resources.h"
#include "limn/lines/image_lines.h"

namespace limn::gpu {

/// LineFields on the device.
struct DeviceFields {
    ivec2 size = ivec2(0);
    bool orthographic = false;
    float pixels_per_radius = 0;
    Buffer intensity, window_depth, nearness, normals, ids;
};

/// find_image_lines on the device: the same texts, the same pixels but where a number is within rounding of its limit.
class ImageLineFinder {
public:
    ImageLineFinder();
    /// @throws Error::Input for options out of their range, Error::Device where the fields do not fit.
    Image find(const LineFields& fields, const ImageLineOptions& options) const;
    Image find(const DeviceFields& fields, const ImageLineOptions& options) const;
    /// Only gives the work to the device: one unsigned a pixel into `found`, 1 on lines.
    void run(const DeviceFields& fields, const ImageLineOptions& options, const Buffer& found) const;

private:
    Program program_;
};

} // namespace limn::gpu
