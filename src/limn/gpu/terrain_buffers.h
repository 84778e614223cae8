#pragma once

#include "limn/camera/camera.h"
#include "limn/gpu/program.h"
#include "limn/gpu/resources.h"
#include "limn/terrain/nested_errors.h"

namespace limn::gpu {

/// A height map on the device, with what is known of the surroundings of its lattice's points. Needs a Context.
class TerrainBuffers {
public:
    /// @param errors  of `lattice` with ranges, or none: then nothing is culled
    /// @throws Error::Device where the map does not fit, Error::Input for errors of another lattice or without ranges, or a lattice of more points
    /// along a side than 16 bits can tell
    TerrainBuffers(const HeightMap& map, const Lattice& lattice, const NestedErrors* errors = nullptr);

    const Lattice& lattice() const { return lattice_; }
    bool has_ranges() const { return has_ranges_; }
    /// At bindings 5 (heights) and 6 (ranges), as terrain_seen.glsl has them.
    void bind() const;
    const Buffer& heights() const { return heights_; } ///< floats, row by row
    const Buffer& bounds() const { return bounds_; }   ///< per lattice point error, low, high, 0; empty where there are no errors
    /// What terrain_eye.glsl asks for, but for the camera.
    void set_map(const Program& program) const;
    /// The camera of terrain_eye.glsl. Places are rounded relative to the eye, by less than the `margin` that shaders get, which is 2e-6 of the way
    /// from the eye around the terrain.
    /// @param nearest  metres of depth
    /// @param cull  only where there are ranges
    void set_view(const Program& program, const Camera& camera, double nearest, bool cull) const;
    /// Depths between which all of it is; the nearer one above 0 in perspective.
    vec2 depth_range(const Camera& camera) const;

private:
    Lattice lattice_;
    dvec2 spacing_;
    dvec3 centre_, size_; ///< of the box around the terrain
    bool has_ranges_;
    Buffer heights_, ranges_, bounds_;
};

} // namespace limn::gpu
