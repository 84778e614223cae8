#pragma once

#include "limn/gpu/program.h"
#include "limn/lines/image_lines.h"

namespace limn::gpu {

/// find_image_lines on the device: the same texts, the same pixels but where a number is within rounding of its limit.
class ImageLineFinder {
public:
    ImageLineFinder();
    /// @throws Error::Input for options out of their range, Error::Device where the fields do not fit.
    Image find(const LineFields& fields, const ImageLineOptions& options) const;

private:
    Program program_;
};

} // namespace limn::gpu
