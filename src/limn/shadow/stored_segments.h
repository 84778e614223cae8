#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "limn/shadow/pixel_codec.h"

namespace limn {

/// The seed's lists of segments as they lie in a file (docs/csm-format.md): looked up where they are. A depth source.
class StoredSegments {
public:
    StoredSegments() = default;
    /// @param bytes   begin at a multiple of 4 and outlive this
    /// @param texels  of a map @param maps  in the file
    /// @throws Error::Read naming `name` where the lists are none of so many texels and maps
    StoredSegments(std::string_view bytes, std::size_t texels, std::uint32_t maps, const std::string& name);

    std::span<const DepthSegment> list(std::size_t texel) const { return {segments_ + first_[texel], segments_ + first_[texel + 1]}; }
    /// Between the first and second surface of the texel in the map of that rank; no_surface where there is none.
    float depth(std::size_t texel, std::uint32_t rank) const { return segment_of(list(texel), rank).depth; }
    std::size_t count() const { return count_; } ///< of segments

private:
    const std::uint32_t* first_ = nullptr;
    const DepthSegment* segments_ = nullptr;
    std::size_t count_ = 0;
};

/// The bytes that a StoredSegments reads. @throws Error::Input for more segments than the format can hold, 2^32 - 1
std::string stored_bytes(const SegmentLists& lists);

} // namespace limn
