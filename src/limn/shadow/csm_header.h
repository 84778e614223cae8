#pragma once

// The first bytes of a `.csm` file (docs/csm-format.md).

#include <cstdint>
#include <string>
#include <string_view>

#include "limn/geometry/bounding_sphere.h"
#include "limn/shadow/depth_layers.h"
#include "limn/shadow/direction_grid.h"
#include "limn/shadow/map_order.h"

namespace limn {

/// How the depths of a file are stored; the numbers stand in files.
enum class ShadowCodec : std::uint32_t {
    segments = 1, ///< the seed's: lists of runs of eight bytes (pixel_codec.h)
    bricks = 2,   ///< trees over neighbouring texels of neighbouring maps (brick_encoder.h)
};

/// What the maps of an object are, all but their depths.
struct ShadowMapsInfo {
    DirectionGrid grid;
    MapOrder order = MapOrder::theta_linear; ///< of ranks
    int size = 128;                          ///< texels along a side of a map
    ShadowCodec codec = ShadowCodec::bricks;
    float margin = 0;                      ///< that depths keep from both surfaces, as a part of the way between them
    OpenBack back = OpenBack::sphere;
    BoundingSphere sphere;                 ///< of the object, in its own space: the unit sphere of the maps
    std::uint64_t shape = 0;               ///< shape_hash() of the object

    std::size_t texels() const { return std::size_t(size) * std::size_t(size); }
    /// Two floats for each texel of each map.
    std::uint64_t uncompressed_bytes() const { return std::uint64_t(texels()) * grid.count() * 2 * sizeof(float); }
};

/// The most that files hold.
inline constexpr int largest_map = 4096, most_cells = 4096;
inline constexpr std::uint32_t most_maps = 1 << 20;

inline constexpr std::size_t csm_header_bytes = 128;

/// A whole file: header and depths. @param depths  as the codec stores them
std::string encode_csm(const ShadowMapsInfo& info, std::string_view depths);

/// What a file's header tells. Checks length and checksums, so that a byte that is another one is noticed.
/// @param bytes  the whole file
/// @throws Error::Read naming `name` and the fault: no such file, another version, truncated, damaged
ShadowMapsInfo decode_csm(std::string_view bytes, const std::string& name);

} // namespace limn
