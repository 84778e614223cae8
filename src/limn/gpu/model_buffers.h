#pragma once

#include "limn/gpu/resources.h"
#include "limn/lines/line_model.h"

namespace limn::gpu {

/// A model's geometry on the device, as lit.vert reads it.
struct ModelBuffers {
    Buffer positions; ///< vec4; w: index of the object
    Buffer normals;   ///< vec4; zero where the model has none
    Buffer faces;     ///< three corners each, the index buffer of `array`
    VertexArray array;

    /// Where shaders find them.
    enum Binding : unsigned { positions_at, normals_at, faces_at, first_free };

    /// @throws Error::Device where the model does not fit.
    explicit ModelBuffers(const LineModel& model);
    void bind() const;
    void draw() const;         ///< every face, with the program in use
    void draw_corners() const; ///< the same, where the program looks up the corners in `faces` itself
    std::size_t face_count() const { return faces.bytes() / sizeof(uvec3); }
};

} // namespace limn::gpu
