#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "limn/geometry/mesh.h"
#include "limn/shadow/csm_header.h"
#include "limn/shadow/look_up.h"
#include "limn/shadow/stored_bricks.h"
#include "limn/shadow/stored_segments.h"

namespace limn {

/// The depth maps of a rigid object from every direction of a grid, compressed, as they stand in a `.csm` file (docs/csm-format.md): either mapped
/// from one or just baked. A value that is cheap to copy; copies share the bytes, and any number of threads may look up.
class ShadowMaps {
public:
    /// @param bytes  a whole file @param owner  keeps them where they are @param name  in messages
    /// @throws Error::Read naming `name` and the fault
    ShadowMaps(std::string_view bytes, std::shared_ptr<const void> owner, const std::string& name);

    const ShadowMapsInfo& info() const { return info_; }
    /// For a LookUp in them.
    MapLayout layout() const { return {info_.grid, info_.order, info_.size}; }
    /// Between the first and second surface of a texel (row by row, along the frame's `up`) in the map of a rank, from 0 nearest to the eye to 1;
    /// no_surface where the map has none. A depth source.
    float depth(std::size_t texel, std::uint32_t rank) const
    {
        return bricks() ? bricks()->depth(texel, rank) : segments()->depth(texel, rank);
    }
    /// The same of many (read_depths.h).
    void depths(std::span<const MapPlace> places, float* depths) const
    {
        if (bricks())
            bricks()->depths(places, depths);
        else
            read_depths(*segments(), places, depths);
    }
    /// The file.
    std::string_view bytes() const { return bytes_; }
    /// The depth source itself: that of the codec, null for another one.
    const StoredSegments* segments() const { return std::get_if<StoredSegments>(&depths_); }
    const StoredBricks* bricks() const { return std::get_if<StoredBricks>(&depths_); }

private:
    std::string_view bytes_;
    std::shared_ptr<const void> owner_;
    ShadowMapsInfo info_;
    std::variant<StoredSegments, StoredBricks> depths_;
};

/// Maps a file; nothing is unpacked.
/// @throws Error::Read for a file that is missing, none of these, of another version, truncated or damaged
ShadowMaps read_csm(const std::filesystem::path& file);

/// Writes beside the file and renames. @throws Error::Write
void write_csm(const ShadowMaps& maps, const std::filesystem::path& file);

/// @throws Error::Read where the maps are not those of the mesh. @param name  of the file, in the message
void check_shape(const ShadowMaps& maps, const Mesh& mesh, const std::string& name);

} // namespace limn
