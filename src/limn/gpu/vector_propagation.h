#pragma once

#include "limn/gpu/program.h"
#include "limn/gpu/resources.h"
#include "limn/subdivision/vector_propagation.h"

namespace limn::gpu {

/// propagate_vectors and dilated on the device: the same text, whole numbers, so the same result.
class VectorPropagator {
public:
    VectorPropagator();
    /// @throws Error::Input as the functions of the processor and for a picture without pixels, Error::Device where the device has no room.
    VectorField run(std::span<const std::uint8_t> marked, ivec2 size, const PropagationOptions& options = {}) const;
    Image dilated(const Image& picture, const PropagationOptions& options) const;

private:
    /// The vectors after the passes. @param passes  that changed something
    Buffer propagate(std::span<const std::uint8_t> marked, ivec2 size, const PropagationOptions& options, int& passes) const;

    Program propagate_, look_up_;
};

} // namespace limn::gpu
