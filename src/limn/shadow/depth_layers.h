#pragma once

#include <limits>
#include <vector>

#include "limn/shadow/candidate_triangles.h"
#include "limn/shadow/direction_grid.h"
#include "limn/shadow/shadow_caster.h"

namespace limn {

inline constexpr float no_surface = std::numeric_limits<float>::infinity();

/// What an object is between in each texel of a map, row by row along the frame's `up`: where a line through the texel's middle towards the
/// sphere meets it first and second, as depths from 0 (nearest to the eye) to 1. Both are no_surface where it meets nothing.
struct DepthLayers {
    int size = 0; ///< texels along a side
    std::vector<float> near, far;
};

/// What stands for the second surface where there is none: the object is open.
enum class OpenBack {
    sphere,   ///< the line's way out of the sphere
    constant, ///< open_thickness behind the first
};
inline constexpr float open_thickness = 0.01f;
inline constexpr float same_surface = 1e-6f; ///< two surfaces of an object that are nearer to each other are one

/// Puts in second surfaces where there are none.
class BackCloser {
public:
    /// @param size  texels along a side of the maps
    BackCloser(int size, OpenBack back);
    void close(DepthLayers& layers) const;

private:
    OpenBack back_;
    std::vector<float> sphere_exit_; ///< by texel
};

/// Draws maps of one object; keeps its memory from map to map.
/// A texel's middle on an edge belongs to one of the edge's triangles, so that no surface counts twice (coordinates are rounded to 2^-14 of a
/// texel for this).
class DepthPainter {
public:
    /// @param caster  has to outlive the painter @param size  texels along a side, 1 to 4096
    DepthPainter(const ShadowCaster& caster, int size, OpenBack back = OpenBack::sphere);
    /// @param layers  overwritten
    void paint(const MapFrame& frame, DepthLayers& layers);

private:
    void project(const MapFrame& frame);
    void paint(const uvec3& triangle, DepthLayers& layers) const;

    const ShadowCaster& caster_;
    int size_;
    BackCloser closer_;
    std::vector<MapVertex> vertices_;
    std::vector<std::uint32_t> candidates_; ///< triangles that may cover the middle of a texel
};

} // namespace limn
