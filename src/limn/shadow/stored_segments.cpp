#include "limn/shadow/stored_segments.h"

#include <limits>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {

StoredSegments::StoredSegments(std::string_view bytes, std::size_t texels, std::uint32_t maps, const std::string& name)
{
    const auto fail = [&](const std::string& what) { throw Error::Read(fmt::format("{}: its lists of segments are damaged: {}", name, what)); };
    const std::size_t table = (texels + 1) * sizeof(std::uint32_t);
    if (bytes.size() < table || (bytes.size() - table) % sizeof(DepthSegment) != 0)
        fail(fmt::format("{} bytes for {} texels", bytes.size(), texels));
    first_ = reinterpret_cast<const std::uint32_t*>(bytes.data());
    segments_ = reinterpret_cast<const DepthSegment*>(bytes.data() + table);
    count_ = (bytes.size() - table) / sizeof(DepthSegment);
    if (first_[0] != 0 || first_[texels] != count_)
        fail(fmt::format("{} segments, and lists of {}", count_, first_[texels]));
    for (std::size_t texel = 0; texel < texels; ++texel)
        if (first_[texel] >= first_[texel + 1] || first_[texel + 1] > count_ || segments_[first_[texel + 1] - 1].last != maps - 1)
            fail(fmt::format("that of texel {}", texel));
}

std::string stored_bytes(const SegmentLists& lists)
{
    if (lists.segments.size() > std::numeric_limits<std::uint32_t>::max())
        throw Error::Input(fmt::format("{} segments are more than a file of them holds; bake fewer maps, smaller ones, or with another codec", lists.segments.size()));
    std::string bytes;
    bytes.reserve(lists.bytes());
    for (const std::size_t first : lists.first) {
        const auto place = std::uint32_t(first);
        bytes.append(reinterpret_cast<const char*>(&place), sizeof place);
    }
    bytes.append(reinterpret_cast<const char*>(lists.segments.data()), lists.segments.size() * sizeof(DepthSegment));
    return bytes;
}

} // namespace limn
