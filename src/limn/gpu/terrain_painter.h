#pragma once

#include <optional>
#include <vector>

#include "limn/camera/camera.h"
#include "limn/gpu/program.h"
#include "limn/gpu/resources.h"
#include "limn/gpu/tile_textures.h"
#include "limn/terrain/height_map.h"

namespace limn::gpu {

/// A mesh of a terrain for a window: near its middle, places in floats lose nothing that can be seen.
struct TerrainModel {
    dvec3 middle = dvec3(0);
    std::vector<vec4> vertices; ///< metres from the middle; w: 0 lowest to 1 highest, for the colour
    std::vector<uvec3> triangles;
    std::size_t met = 0; ///< how many of the triangles keep the bound: the first ones
};

/// How a terrain is painted in a window.
struct TerrainPaint {
    vec3 to_sun = vec3(0, 0, 1); ///< unit
    std::optional<vec3> plain;   ///< one colour of the ground instead of those by height
    bool marks = true;           ///< triangles that may break the bound are marked
    bool mesh_lines = false;     ///< edges of triangles are drawn over it
    vec3 background = vec3(1);   ///< encoded (sRGB)

    bool operator==(const TerrainPaint&) const = default;
};

/// Paints terrain as paint_terrain() does, as quickly as a window wants it. Needs a Context.
class TerrainPainter {
public:
    /// How far apart the points of the normals are that it looks for, in pixels; shading_tiles() has to be asked for the same.
    static constexpr double pixels_between_normals = 0.75;

    /// @param frame  the map, with or without heights
    TerrainPainter(const HeightMap& frame, const PyramidLayout& layout);
    /// Takes a model in place of the one before. @throws Error::Device where the device has no room
    void take(const TerrainModel& model);
    /// Takes light that follows the one before, of at least the whole coarsest level. @throws Error::Device where the device has no room
    void take(const TileLight& light) { normals_.take(light); }
    /// @param target  of one colour, rgba8; what was in it is gone
    /// @param nearest  metres of depth: what is nearer to the eye is cut off
    void draw(const Framebuffer& target, const Camera& camera, const TerrainPaint& paint, double nearest = 0.01) const;
    /// How deep the ground is at a pixel of the last picture, y down, or none where there is none. Waits for the device.
    std::optional<double> depth_at(const Framebuffer& target, const Camera& camera, const ivec2& pixel, double nearest = 0.01) const;

private:
    double farthest(const Camera& camera) const;

    dvec2 spacing_;
    int rows_;
    Program program_, lines_;
    TileTextures normals_;
    Buffer vertices_, faces_;
    VertexArray array_;
    dvec3 middle_ = dvec3(0);
    double reach_ = 0; ///< metres from the middle to the furthest vertex
    std::size_t triangles_ = 0, met_ = 0;
};

} // namespace limn::gpu
