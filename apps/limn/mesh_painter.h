#pragma once

#include <span>
#include <vector>

#include "limn/camera/camera.h"
#include "limn/geometry/bounds.h"
#include "limn/gpu/program.h"
#include "limn/gpu/resources.h"

/// Draws triangles with a normal at each corner into a picture of its own on the device, for measuring. Needs a gpu::Context.
class MeshPainter {
public:
    /// @throws limn::Error::Device
    explicit MeshPainter(limn::ivec2 size);
    /// Triangles that stay the same from pose to pose.
    void keep_triangles(std::span<const limn::uvec3> triangles);
    /// Gives the device another pose: a position per vertex, a normal per corner. As floats.
    void upload(std::span<const limn::dvec3> positions, std::span<const limn::dvec3> normals);
    void upload(std::span<const limn::dvec3> positions, std::span<const limn::vec3> normals);
    void draw(const limn::Camera& camera, const limn::Bounds& bounds) const;

private:
    template <class V> void upload_any(std::span<const limn::dvec3> positions, std::span<const V> normals);

    limn::gpu::Program program_;
    limn::gpu::Framebuffer picture_;
    limn::gpu::VertexArray array_;
    limn::gpu::Buffer positions_, normals_, triangles_;
    std::size_t corners_ = 0;
    std::vector<limn::vec4> floats_;
};
